"""Tables as the text of a TOML file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def toml_text(content: Mapping[str, Any]) -> str:
    """The text of nested tables: numbers, words, lists of numbers, tables and lists of tables."""
    return "\n".join(_lines(content, "")) + "\n"


def _lines(table: Mapping[str, Any], path: str) -> list[str]:
    lines = [f"{key} = {_value(v)}" for key, v in table.items() if not _is_nested(v)]
    for key, value in table.items():
        name = f"{path}{key}"
        if isinstance(value, Mapping):
            lines += [f"[{name}]", *_lines(value, name + ".")]
        elif _is_nested(value):
            for entry in value:
                lines += [f"[[{name}]]", *_lines(entry, name + ".")]
    return lines


def _is_nested(value: Any) -> bool:
    is_tables = isinstance(value, list) and all(isinstance(entry, Mapping) for entry in value)
    return isinstance(value, Mapping) or is_tables


def _value(value: Any) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return repr(value)
