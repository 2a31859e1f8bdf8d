"""Folders and URLs of fsspec."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rrr._rrr import Error
from rrr.fleet.needs import needed


def filesystem(place: str) -> tuple[Any, str]:
    """The file system of a folder, file or URL, and the path there, without a slash at its end.

    Raises `rrr.Error` where the protocol is not known or its package is not installed.
    """
    core = needed("fsspec").core
    try:
        fs, path = core.url_to_fs(place)
    except (ImportError, ValueError) as error:
        raise Error(f"{place}: {error}\nhint: for s3:// install s3fs, for gs:// gcsfs") from error
    return fs, path.rstrip("/")


def is_local(fs: Any) -> bool:
    """Whether files of it are files of this machine."""
    return isinstance(fs, needed("fsspec.implementations.local").LocalFileSystem)


@contextmanager
def used(place: str, hint: str) -> Iterator[None]:
    """Whatever a file system or a reader raises becomes an `rrr.Error` that names the place.

    Stores of objects raise errors of their own kinds.
    """
    try:
        yield
    except Error:
        raise
    except Exception as error:
        words = str(error) or "no words"
        raise Error(f"{place}: {words} ({type(error).__name__})\nhint: {hint}") from error
