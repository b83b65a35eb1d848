"""Sentences under review: tests/data/wording/NAME.json has what is said to what is asked; UPDATE_DOCS=1 writes it."""

import json
import os
from pathlib import Path
from typing import Any

from pydantic import ValidationError

FOLDER = Path(__file__).parent / "data" / "wording"


def asked_in(name: str) -> list[Any]:
    """Return all that is asked in a file, in its order."""
    return [each["asked"] for each in _entries(name)]


def check(name: str, asked: Any, said: Any) -> None:
    """Compare what is said with the file, or write it there."""
    entries = _entries(name)
    (entry,) = (each for each in entries if _line(each["asked"]) == _line(asked))  # not a number equals nothing
    if os.environ.get("UPDATE_DOCS"):
        entry["said"] = said
        lines = [f'{{"asked": {_line(each["asked"])},\n "said": {_line(each["said"])}}}' for each in entries]
        _file(name).write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")
    assert said == entry["said"]


def errors_in(refused: ValidationError) -> list[list[str]]:
    """Return of each error its place, with the field where several do not fit together, and its message."""
    said = []
    for error in refused.errors():
        place, field = ".".join(map(str, error["loc"])), error.get("ctx", {}).get("field")
        said.append([f"{place} {field or ''}".strip(), error["msg"]])
    return said


def _entries(name: str) -> list[dict[str, Any]]:
    entries: list[dict[str, Any]] = json.loads(_file(name).read_text(encoding="utf-8"))
    return entries


def _file(name: str) -> Path:
    return FOLDER / f"{name}.json"


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)
