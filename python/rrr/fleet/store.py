"""OUTPUT: a folder or URL of Parquet, one small file a row, packed once a night is over."""

from __future__ import annotations

import contextlib
import datetime
import io
import uuid
from collections.abc import Iterable
from functools import lru_cache
from typing import Any

from rrr.fleet.needs import needed
from rrr.fleet.places import filesystem, used
from rrr.fleet.row import Row, schema

OBJECT_STORES = {"s3", "s3a", "gs", "gcs", "abfs", "abfss", "az", "adl", "memory"}
"""Where a file appears whole or not at all by itself."""
AT_A_TIME = 1000
"""Files that are asked for together."""


class Store:
    """The rows of a fleet: `rows/KEY.parquet` of open nights, `nights/NIGHT.parquet` of packed ones.

    `seen/STAMP` holds the key of files whose listing has that stamp.
    """

    def __init__(self, place: str) -> None:
        self.place = place.rstrip("/")
        self.fs, self.root = filesystem(place)

    def has(self, key: str) -> bool:
        """Whether a row with this key is there."""
        return self.fs.exists(self._row(key)) or key in _packed_keys(self.place)

    def has_of(self, stamp: str | None) -> str | None:
        """The key of the row that is there of files with this stamp (`listing.stamp`)."""
        if stamp is None:
            return None
        try:
            key: str = self.fs.cat_file(f"{self.root}/seen/{stamp}").decode()
        except Exception:
            # Not there, or taken away by `pack` just now: the files are read.
            return None
        return key if self.has(key) else None

    def remember(self, stamp: str | None, key: str) -> None:
        """That files with this stamp have the row with this key; where that cannot be noted, they are read again."""
        if stamp is None:
            return
        with contextlib.suppress(Exception):
            self.write(f"seen/{stamp}", key.encode())

    def put(self, row: Row) -> None:
        """Stores a row, whole or not at all."""
        self.write(f"rows/{row['key']}.parquet", parquet([row], schema()))

    def remove(self, key: str) -> None:
        """Takes a row away, if it is there."""
        if self.fs.exists(self._row(key)):
            self.fs.rm_file(self._row(key))

    def table(self) -> Any:
        """All rows as a table of pyarrow, each key once."""
        tables = list(self._tables(self._files("rows") + self._files("nights")).values())
        pa = needed("pyarrow")
        if not tables:
            return schema().empty_table()
        return _each_key_once(pa.concat_tables(tables))

    def rows(self) -> list[Row]:
        """All rows."""
        rows: list[Row] = self.table().to_pylist()
        return rows

    def pack(self, before: datetime.date) -> int:
        """Puts the rows of each night before this one into one file, and takes their own away.

        How many. What was remembered of listings goes too: whatever is diagnosed again is read once. Stopped
        in between it leaves rows twice, which the next time puts right, and `table` reads once.
        """
        loose = self._tables(self._files("rows"))
        nights = {path: table["night"][0].as_py() for path, table in loose.items()}
        for night in sorted({night for night in nights.values() if night < before}):
            self._pack_night(night, {p: loose[p] for p, of in nights.items() if of == night})
        if self.fs.isdir(f"{self.root}/seen"):
            # Another process may be noting a listing: what cannot be taken away stays.
            with contextlib.suppress(Exception):
                self.fs.rm(f"{self.root}/seen", recursive=True)
        return sum(night < before for night in nights.values())

    def write(self, name: str, content: bytes) -> None:
        """Writes a file below OUTPUT, whole or not at all.

        Raises `rrr.Error` where that is not possible.
        """
        path = f"{self.root}/{name}"
        with used(f"{self.place}/{name}", "OUTPUT is a folder or a URL of fsspec that can be written to"):
            self.fs.makedirs(path.rsplit("/", 1)[0], exist_ok=True)
            self._write(path, content)

    def _write(self, path: str, content: bytes) -> None:
        protocols = self.fs.protocol
        if OBJECT_STORES & ({protocols} if isinstance(protocols, str) else set(protocols)):
            self.fs.pipe_file(path, content)
            return
        folder, name = path.rsplit("/", 1)
        temporary = f"{folder}/.{name}.{uuid.uuid4().hex}.tmp"
        self.fs.pipe_file(temporary, content)
        self.fs.mv(temporary, path)

    def _pack_night(self, night: datetime.date, loose: dict[str, Any]) -> None:
        name = f"nights/{night}.parquet"
        earlier = [f"{self.root}/{name}"] if self.fs.exists(f"{self.root}/{name}") else []
        tables = [*self._tables(earlier).values(), *loose.values()]
        whole = _each_key_once(needed("pyarrow").concat_tables(tables))
        self.write(name, parquet(whole.to_pylist(), schema()))
        _packed_keys.cache_clear()
        self.fs.rm(list(loose))

    def _tables(self, paths: list[str]) -> dict[str, Any]:
        """The tables of files, of which a store of objects sends many at a time."""
        tables: dict[str, Any] = {}
        for first in range(0, len(paths), AT_A_TIME):
            with used(f"{self.place}", "rows are there, and can be read"):
                contents = self.fs.cat(paths[first : first + AT_A_TIME])
            tables |= {path: _table(path, content) for path, content in contents.items()}
        return tables

    def _row(self, key: str) -> str:
        return f"{self.root}/rows/{key}.parquet"

    def _files(self, folder: str) -> list[str]:
        self.fs.invalidate_cache()
        found: list[str] = self.fs.glob(f"{self.root}/{folder}/*.parquet")
        return [path for path in found if not path.rsplit("/", 1)[-1].startswith(".")]


def parquet(rows: Iterable[Row], columns: Any) -> bytes:
    """Rows as the bytes of a Parquet file."""
    pa, pq = needed("pyarrow"), needed("pyarrow.parquet")
    table = pa.Table.from_pylist(list(rows), schema=columns)
    buffer = pa.BufferOutputStream()
    pq.write_table(table, buffer, compression="zstd")
    content: bytes = buffer.getvalue().to_pybytes()
    return content


def _table(path: str, content: bytes) -> Any:
    with used(path, "below OUTPUT, rows/ and nights/ hold no files but those of the fleet"):
        table = needed("pyarrow.parquet").read_table(io.BytesIO(content))
        return table.select(schema().names).cast(schema())


def _keys(fs: Any, path: str) -> list[str]:
    read = needed("pyarrow.parquet").read_table
    with used(path, "below OUTPUT, nights/ holds no files but those of the fleet"):
        with fs.open(path, "rb") as file:
            keys: list[str] = read(file, columns=["key"])["key"].to_pylist()
    return keys


def _each_key_once(table: Any) -> Any:
    seen: set[str] = set()
    first = []
    for index, key in enumerate(table["key"].to_pylist()):
        if key not in seen:
            first.append(index)
            seen.add(key)
    return table.take(first)


@lru_cache
def _packed_keys(place: str) -> frozenset[str]:
    """Keys of packed rows, read once by each process."""
    store = Store(place)
    keys = [_keys(store.fs, path) for path in store._files("nights")]
    return frozenset(key for of_night in keys for key in of_night)
