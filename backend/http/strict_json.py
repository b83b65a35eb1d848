"""Strict JSON: refuses what two parsers could read differently, or could fail on.

The standard library's parser reads it, whose hooks see a key that is there twice; then orjson has to take it too, which
refuses numbers that no double holds and halves of surrogate pairs.
"""

import json
from typing import Any, NoReturn

import orjson

LARGEST_EXACT, LARGEST_INTEGER = 2**53, 2**63  # up to which a double holds every integer; and a database's integers
MAX_DEPTH = 32
MAX_MEMBERS = 256  # of one object; no schema here has more names to choose from
MAX_VALUES = 250_000  # of one body; a list of 100,000 runs fits into the longest body only with fewer


class StrictJSONError(ValueError):
    """The body is not JSON as this service reads it; `status` is the HTTP status that says so."""

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.message = message


def parse(body: bytes, *, max_values: int = MAX_VALUES) -> Any:
    """The value of a JSON document.

    Args:
        body: At most a few megabytes.
        max_values: How many values and members it may hold.

    Raises:
        StrictJSONError: 400 for what is not UTF-8, not JSON or nested too deep; 413 for too many values; 422 for
            duplicate keys, NaN, Infinity, objects of more than 256 members, numbers no double holds and halves of
            surrogate pairs.
    """
    # Before anything is built: these count too much where texts hold such characters, never too little.
    opened = body.count(b"[") + body.count(b"{")
    if opened + body.count(b",") > max_values:
        raise StrictJSONError(413, f"The body may hold {max_values} values")
    try:
        value = json.loads(
            body.decode("utf-8"),
            object_pairs_hook=_members,
            parse_constant=_refuse_constant,
            parse_float=_number,
            parse_int=_integer,
        )
    except StrictJSONError:
        raise
    except (UnicodeDecodeError, RecursionError):
        raise StrictJSONError(400, "The body is not valid UTF-8, or nested too deep") from None
    except json.JSONDecodeError as error:
        message = f"The body is not valid JSON (line {error.lineno}, column {error.colno})"
        raise StrictJSONError(400, message) from None
    except ValueError:  # of int: thousands of digits
        raise StrictJSONError(422, "A number is larger than any double") from None
    try:
        orjson.loads(body)
    except orjson.JSONDecodeError:
        message = "A number is larger than any double, or a text holds half of a surrogate pair, which is no character"
        raise StrictJSONError(422, message) from None
    if opened > MAX_DEPTH and _is_deeper(value, MAX_DEPTH):
        raise StrictJSONError(400, f"The body is nested deeper than {MAX_DEPTH}")
    return value


def _is_deeper(value: Any, limit: int) -> bool:
    level = [value] if isinstance(value, dict | list) else []
    for _ in range(limit):
        inner = (each.values() if isinstance(each, dict) else each for each in level)
        level = [each for values in inner for each in values if isinstance(each, dict | list)]
    return bool(level)


def _members(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    if len(pairs) > MAX_MEMBERS:
        raise StrictJSONError(422, f"An object may have {MAX_MEMBERS} members")
    members = dict(pairs)
    if len(members) < len(pairs):
        raise StrictJSONError(422, "An object has the same key twice")
    return members


def _number(text: str) -> float | int:
    """Return 2 for `2.0`: JSON knows one kind of number, and many programs write integers so."""
    number = float(text)
    return int(number) if number.is_integer() and abs(number) < LARGEST_EXACT else number


def _integer(text: str) -> float | int:
    number = int(text)
    return number if -LARGEST_INTEGER <= number < 2 * LARGEST_INTEGER else float(text)


def _refuse_constant(_: str) -> NoReturn:
    raise StrictJSONError(422, "NaN and Infinity are not numbers in JSON")
