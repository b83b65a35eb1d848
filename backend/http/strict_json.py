"""Strict JSON: refuses what two parsers could read differently, or could fail on.

orjson reads it, which refuses numbers that no double holds and halves of surrogate pairs. Where that may differ from
what is wanted, the standard library's parser reads it again, six times as slow: its hooks see a key that is there
twice and whole numbers written with a fraction, and its errors say where they are.
"""

import json
from itertools import chain
from typing import Any, NoReturn

import orjson

from backend import digest
from backend.http.problems import RequestError

LARGEST_EXACT, LARGEST_INTEGER = 2**53, 2**63  # up to which a double holds every integer; and a database's integers
MAX_DEPTH = 32
MAX_MEMBERS = 256  # of one object; no schema here has more names to choose from
MAX_VALUES = 250_000  # of one body; a list of 100,000 runs fits into the longest body only with fewer


def parse(body: bytes, *, max_values: int = MAX_VALUES) -> Any:
    """Return the value of a JSON document.

    Args:
        body: At most a few megabytes.
        max_values: How many values and members it may hold.

    Raises:
        RequestError: 400 for what is not UTF-8, not JSON or nested too deep; 413 for too many values; 422 for
            duplicate keys, NaN, Infinity, objects of more than 256 members, numbers no double holds and halves of
            surrogate pairs.
    """
    # Before anything is built: these count too much where texts hold such characters, never too little.
    opened = body.count(b"[") + body.count(b"{")
    if opened + body.count(b",") > max_values:
        raise _refusal(413, f"The body may hold {max_values} values")
    try:
        value = orjson.loads(body)
    except orjson.JSONDecodeError:
        _parse_slowly(body)
        message = "A number is larger than any double, or a text holds half of a surrogate pair, which is no character"
        raise _refusal(422, message) from None
    _check_shape(value)
    written = orjson.dumps(value)
    # Of two equal keys one is lost, and with it a colon: without escapes what is left is written as it came.
    no_key_is_lost = b"\\" not in body and written.count(b":") == body.count(b":")
    return value if no_key_is_lost and not digest.has_whole_floats(written) else _parse_slowly(body)


def _refusal(status: int, message: str) -> RequestError:
    return RequestError("strict-json", message, status=status, errors=[{"pointer": "", "message": message}])


def _parse_slowly(body: bytes) -> Any:
    """Return the value, or raise RequestError with what is wrong and where."""
    try:
        return json.loads(
            body.decode("utf-8"),
            object_pairs_hook=_members,
            parse_constant=_refuse_constant,
            parse_float=_number,
            parse_int=_integer,
        )
    except (UnicodeDecodeError, RecursionError):
        raise _refusal(400, "The body is not valid UTF-8, or nested too deep") from None
    except json.JSONDecodeError as error:
        message = f"The body is not valid JSON (line {error.lineno}, column {error.colno})"
        raise _refusal(400, message) from None
    except ValueError:  # of int: thousands of digits
        raise _refusal(422, "A number is larger than any double") from None


def _check_shape(value: Any) -> None:
    """Raise RequestError where something has too many members, or is nested too deep."""
    level: list[dict[str, Any] | list[Any]] = [[value]]
    for _ in range(MAX_DEPTH + 1):
        if max(map(len, level), default=0) > MAX_MEMBERS:
            _check_members(level)
        values = chain.from_iterable(each if isinstance(each, list) else each.values() for each in level)
        level = [each for each in values if type(each) in (dict, list)]
    if level:
        raise _refusal(400, f"The body is nested deeper than {MAX_DEPTH}")


def _check_members(level: list[dict[str, Any] | list[Any]]) -> None:
    if any(isinstance(each, dict) and len(each) > MAX_MEMBERS for each in level):
        raise _refusal(422, f"An object may have {MAX_MEMBERS} members")


def _members(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        raise _refusal(422, "An object has the same key twice")
    return members


def _number(text: str) -> float | int:
    """Return 2 for `2.0`: JSON knows one kind of number, and many programs write integers so."""
    number = float(text)
    return int(number) if number.is_integer() and abs(number) < LARGEST_EXACT else number


def _integer(text: str) -> float | int:
    number = int(text)
    return number if -LARGEST_INTEGER <= number < 2 * LARGEST_INTEGER else float(text)


def _refuse_constant(_: str) -> NoReturn:
    raise _refusal(422, "NaN and Infinity are not numbers in JSON")
