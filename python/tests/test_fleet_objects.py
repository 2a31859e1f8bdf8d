"""Stores of objects by their own protocols: S3 and GCS, served on this machine."""

import datetime
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fsspec
import numpy as np
import pytest
from turntables import Ills, write

from rrr.fleet import Options, Store, diagnose_robot, robots_of, unit

NIGHT = datetime.date(2026, 11, 22)
SERVERS = {
    "s3": ("s3fs", "moto", "moto.server"),
    "gs": ("gcsfs", "gcp_storage_emulator", "gcp_storage_emulator"),
}
"""By protocol: the package of fsspec, the package that serves it, the module that is run."""


def free_port() -> int:
    """A port that nobody listens at."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port: int = found.getsockname()[1]
    return port


def arguments(protocol: str, port: int) -> list[str]:
    """What the server is told."""
    if protocol == "s3":
        return ["-H", "127.0.0.1", "-p", str(port)]
    return ["start", "--host=127.0.0.1", f"--port={port}", "--in-memory"]


def environment(protocol: str, port: int) -> dict[str, str]:
    """What tells the packages of fsspec where the server is."""
    address = f"http://127.0.0.1:{port}"
    if protocol == "s3":
        keys = {"AWS_ACCESS_KEY_ID": "test", "AWS_SECRET_ACCESS_KEY": "test"}
        return keys | {"AWS_ENDPOINT_URL": address, "AWS_DEFAULT_REGION": "us-east-1"}
    return {"STORAGE_EMULATOR_HOST": address}


@pytest.fixture(params=sorted(SERVERS))
def lake(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[str, Any]]:
    """The URL of an empty bucket, and its file system."""
    protocol: str = request.param
    package, server, module = SERVERS[protocol]
    pytest.importorskip(package)
    pytest.importorskip(server)
    port = free_port()
    for name, value in environment(protocol, port).items():
        monkeypatch.setenv(name, value)
    command = [sys.executable, "-m", module, *arguments(protocol, port)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        wait_for(port)
        fs = fsspec.filesystem(protocol, skip_instance_cache=True)
        fs.mkdir("lake")
        yield f"{protocol}://lake", fs
    finally:
        process.terminate()
        process.wait()


def wait_for(port: int) -> None:
    """Until somebody listens."""
    for _ in range(300):
        with socket.socket() as found:
            if found.connect_ex(("127.0.0.1", port)) == 0:
                return
        time.sleep(0.1)
    pytest.fail("the server of objects does not begin")


def test_robots_and_rows_are_objects(
    lake: tuple[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    url, fs = lake
    write(tmp_path / "in", Ills(np.array([0.05]), np.zeros(1)), ["A"], seed=2)
    fs.put(str(tmp_path / "in"), "lake/", recursive=True)
    far, near = robots_of(f"{url}/in")[0], robots_of(str(tmp_path / "in"))[0]
    done = diagnose_robot(far, f"{url}/out", NIGHT, Options())
    beside = diagnose_robot(near, str(tmp_path / "out"), NIGHT, Options())
    assert (done.state, done.key) == ("diagnosed", beside.key)
    store = Store(f"{url}/out")
    assert store.rows()[0]["causes"] == Store(str(tmp_path / "out")).rows()[0]["causes"]
    monkeypatch.setattr(unit, "fetched", None)
    assert diagnose_robot(far, f"{url}/out", NIGHT, Options()).state == "there"
    before = store.rows()
    assert store.pack(before=NIGHT + datetime.timedelta(1)) == 1
    assert store.rows() == before and os.listdir(tmp_path / "out" / "rows")
