"""Files of measurements that have to be asked about: by an option, or in a terminal."""

import copy
import json
import re
import shlex
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.reporting import InputError
from ridelab.errors import RidelabAPIError

_HELP = (
    "What the file's table is, where it does not say it: JSON, or a file with it. Asked in a terminal, which prints it "
    "for the next time."
)
Table = Annotated[str | None, options.option("JSON|FILE", _HELP, "--table")]
# What a column is taken as that is named as the one without which there is nothing to read.
_MAIN = {"road": "height", "drive": "body_acceleration"}


def sent(send: Callable[[Mapping[str, Any] | None], dict[str, Any]], table: str | None, name: str) -> dict[str, Any]:
    """Return the answer to a file that is sent, with what `--table` says or, in a terminal, is answered.

    Raises:
        InputError: `--table` is none, or there is nobody to ask.
    """
    given = _parsed(table)
    was_asked = False
    while True:
        try:
            answer = send(given)
        except RidelabAPIError as error:
            if error.table is None:
                raise
            if not (sys.stdin.isatty() and sys.stderr.isatty()):
                raise InputError(
                    *_questions(error.table), f"{name}: answer by {_option(_guessed(error.table))}"
                ) from None
            given, was_asked = _asked(error.table, given or {}, name), True
        else:
            if was_asked:
                typer.echo(f"Next time: {_option(given or {})}", err=True)
            return answer


def _parsed(table: str | None) -> dict[str, Any] | None:
    if table is None:
        return None
    try:
        value = json.loads(Path(table).read_text(encoding="utf-8") if not table.lstrip().startswith("{") else table)
    except (OSError, ValueError):
        raise InputError("--table: this is neither JSON nor a file with it") from None
    if not isinstance(value, dict):
        raise InputError("--table: this has to be a JSON object")
    return value


def _option(table: Mapping[str, Any]) -> str:
    return f"--table {shlex.quote(json.dumps(table, ensure_ascii=False))}"


def _questions(table: Mapping[str, Any]) -> list[str]:
    return [_with_choices(question) for question in table["questions"]]


def _with_choices(question: Mapping[str, Any]) -> str:
    return f"{question['text']}{' (' + ', '.join(question['choices']) + ')' if question['choices'] else ''}"


def _guessed(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return the answers that are guessed."""
    answers: dict[str, Any] = {}
    for question in table["questions"]:
        _put(answers, table, question["field"], question["guess"] if question["guess"] is not None else "…")
    return answers


def _asked(table: Mapping[str, Any], given: Mapping[str, Any], name: str) -> dict[str, Any]:
    """Return what is given with the answers of whoever sits before the terminal."""
    typer.echo(f"{name}: its first rows are", err=True)
    for row in [[column["title"] for column in table["columns"]], *table["preview"][:3]]:
        typer.echo("  " + "  ".join(row), err=True)
    answers = copy.deepcopy(dict(given))
    for question in table["questions"]:
        answer = typer.prompt(_with_choices(question), default=question["guess"], err=True)
        _put(answers, table, question["field"], answer)
    return answers


def _put(answers: dict[str, Any], table: Mapping[str, Any], field: str, answer: Any) -> None:
    """Put one answer at its place; columns by their titles."""
    match = re.fullmatch(r"/columns(?:/(\d+)/(\w+))?", field)
    if match is None:
        *parents, last = field.strip("/").split("/")
        for parent in parents:
            answers = answers.setdefault(parent, {})
        answers[last] = _number(answer) if last in ("rate", "spacing", "bridge", "to", "from") else answer
        return
    columns = answers.setdefault("columns", [])
    place, key = match.groups()
    if place is None:
        place, key, answer = _place_of(table, str(answer)), "means", _MAIN[table["kind"]]
    elif key == "means" and str(answer).isdecimal():  # which one of two
        place, answer = str(int(answer) - 1), table["columns"][int(place)]["means"]
    column = table["columns"][int(place)]
    entry = next((each for each in columns if each["title"] == column["title"]), None)
    if entry is None:
        entry = {name: column[name] for name in ("title", "means", "unit")}
        columns.append(entry)
    entry[key] = answer


def _place_of(table: Mapping[str, Any], title: str) -> str:
    return str(next((n for n, column in enumerate(table["columns"]) if column["title"] == title), 0))


def _number(answer: Any) -> Any:
    try:
        return float(answer)
    except ValueError:
        return answer
