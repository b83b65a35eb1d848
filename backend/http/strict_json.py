"""Strict JSON: what two parsers could read differently, or could choke on, is refused.

The standard library's parser is used because it offers the hooks. What a body costs is bounded before it is parsed,
by counts and regular expressions that look at each byte once; a hook is given only where the body needs it.
"""

import json
import re
from typing import Any, NoReturn

MAX_DEPTH = 32
MAX_INTEGER_DIGITS = 308  # more do not fit a double
MAX_MEMBERS = 256  # of one object; no schema here has more names to choose from
MAX_VALUES = 250_000  # of one body; a list of 100,000 runs fits into the longest body only with fewer

ALL_DIGITS_ALIKE = bytes.maketrans(b"012345678", b"9" * 9)
LONG_INTEGER = b"9" * (MAX_INTEGER_DIGITS + 1)
TEXT = re.compile(rb'"(?:[^"\\]++|\\.)*+"', re.DOTALL)
ALL_BUT_BRACKETS = bytes(set(range(256)) - set(b"[]{}"))
SURROGATE = re.compile(rb"\\u[dD][89a-fA-F]")
# Every escape sequence there is, of surrogates only whole pairs.
WHOLE = re.compile(
    r"""(?: [^\\]++
          | \\ (?: [^u]
                 | u (?: [0-9a-ce-fA-CE-F]... | [dD][0-7].. | [dD][89abAB]..\\u[dD][c-fC-F].. ) ) )*+""",
    re.VERBOSE | re.DOTALL,
)


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
        StrictJSONError: 400 for what is not UTF-8, not JSON or nested deeper than 32; 413 for too many values; 422
            for duplicate keys, NaN, Infinity, objects of more than 256 members, integers no double holds and halves
            of surrogate pairs.
    """
    try:
        text = body.decode("utf-8")
    except UnicodeDecodeError:
        raise StrictJSONError(400, "The body is not valid UTF-8") from None
    # Before anything is built: these count too much where texts hold such characters, never too little.
    if _openings(body) > MAX_DEPTH and _depth_exceeded(body):
        raise _too_deep()
    if body.count(b",") + _openings(body) > max_values:
        raise StrictJSONError(413, f"The body may hold {max_values} values")
    try:
        value = json.loads(
            text,
            object_pairs_hook=_object,
            parse_constant=_constant,
            parse_int=_integer if LONG_INTEGER in body.translate(ALL_DIGITS_ALIKE) else None,
        )
    except StrictJSONError:
        raise
    except RecursionError:
        raise _too_deep() from None
    except ValueError as error:
        place = f" (line {error.lineno}, column {error.colno})" if isinstance(error, json.JSONDecodeError) else ""
        raise StrictJSONError(400, f"The body is not valid JSON{place}") from None
    if SURROGATE.search(body) and not WHOLE.fullmatch(text):
        raise StrictJSONError(422, "A text holds half of a surrogate pair, which is no character")
    return value


def _openings(body: bytes) -> int:
    return body.count(b"[") + body.count(b"{")


def _depth_exceeded(body: bytes) -> bool:
    """Whether more than 32 brackets are open at once: as many rounds of taking out empty pairs leave some.

    Brackets that do not match are left too.
    """
    brackets = TEXT.sub(b"", body).translate(None, ALL_BUT_BRACKETS)
    for _ in range(MAX_DEPTH):
        before, brackets = len(brackets), brackets.replace(b"[]", b"").replace(b"{}", b"")
        if len(brackets) == before:
            break
    return bool(brackets)


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    if len(pairs) > MAX_MEMBERS:
        raise StrictJSONError(422, f"An object may have {MAX_MEMBERS} members")
    members = dict(pairs)
    if len(members) < len(pairs):
        raise StrictJSONError(422, "An object has the same key twice")
    return members


def _constant(_: str) -> NoReturn:
    raise StrictJSONError(422, "NaN and Infinity are not numbers in JSON")


def _integer(text: str) -> int:
    if len(text.lstrip("-")) > MAX_INTEGER_DIGITS:
        raise StrictJSONError(422, f"An integer has more than {MAX_INTEGER_DIGITS} digits")
    return int(text)


def _too_deep() -> StrictJSONError:
    return StrictJSONError(400, f"The body is nested deeper than {MAX_DEPTH}, or its brackets do not match")
