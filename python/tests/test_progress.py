"""Who hears what long work does: a function, tqdm where it is there, nobody."""

import sys

import pytest

from rrr.progress import heard


def test_tqdm_shows_the_step_that_is_under_way(capsys: pytest.CaptureFixture[str]) -> None:
    with heard(True) as hears:
        assert hears is not None
        hears("searching")
    words = capsys.readouterr().err
    assert "searching" in words
    # The line is taken away at the end.
    assert words.split("\r")[-1].strip() == ""


def test_without_tqdm_nothing_is_shown(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with heard(True) as hears:
        assert hears is None
    assert capsys.readouterr() == ("", "")


def test_a_function_hears_and_silence_is_silent() -> None:
    steps: list[str] = []
    with heard(steps.append) as hears:
        assert hears is not None
        hears("reading")
    with heard(False) as hears:
        assert hears is None
    assert steps == ["reading"]
