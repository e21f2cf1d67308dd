"""A problem as nested dictionaries becomes the text of a problem file; what it means is the reader's business."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np


def written(problem: Mapping[str, Any]) -> str:
    """The text: plain values first, then tables and lists of tables, every entry of them on a line of its own."""
    plain = {key: value for key, value in problem.items() if not (_is_table(value) or _is_list_of_tables(value))}
    lines = _entries(plain, "")
    for key, value in problem.items():
        if _is_table(value):
            lines += ["", f"[{_text(key)}]", *_entries(value, key)]
        elif _is_list_of_tables(value):
            for at, item in enumerate(value):
                lines += ["", f"[[{_text(key)}]]", *_entries(item, f"{key}[{at}]")]
    return "\n".join(lines) + "\n"


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(map(_is_table, value))


def _entries(table: Mapping[str, Any], place: str) -> list[str]:
    return [f"{_text(key)} = {_value(value, f'{place}.{key}' if place else key)}" for key, value in table.items()]


def _text(text: str) -> str:
    if not isinstance(text, str):
        raise TypeError(f"{text!r} is no text, and cannot be a key of a problem")
    # JSON's escapes are TOML's, but for DEL, which TOML wants escaped.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any, place: str) -> str:
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        # Python writes inf, nan and exponents as TOML does.
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(_entries(value, place)) + " }" if value else "{}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(_value(item, f"{place}[{at}]") for at, item in enumerate(value)) + "]"
    raise TypeError(f"{place} is {value!r}; a problem holds numbers, texts, truth values, lists and dictionaries")
