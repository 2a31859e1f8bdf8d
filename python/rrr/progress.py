"""What long work says while it goes on."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Progress = Callable[[str], object]


@contextmanager
def heard(progress: bool | Progress) -> Iterator[Progress | None]:
    """Who hears which step is under way: a function that is given, a line of tqdm, or nobody.

    True means tqdm where it is installed. The line is taken away at the end.
    """
    if callable(progress):
        yield progress
        return
    line = _line() if progress else None
    try:
        yield line.set_description_str if line is not None else None
    finally:
        if line is not None:
            line.close()


def _line() -> Any | None:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm(bar_format="{desc} [{elapsed}]", leave=False)
