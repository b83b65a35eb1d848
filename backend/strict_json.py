"""Strict JSON: what two parsers could read differently, or could choke on, is refused.

The standard library's parser is used because it offers the hooks; bodies are at most 1 MiB.
"""

import json
from typing import Any, NoReturn

MAX_DEPTH = 32
MAX_INTEGER_DIGITS = 308  # more do not fit a double


class StrictJSONError(ValueError):
    """The body is not JSON as this service reads it; `status` is the HTTP status that says so."""

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.message = message


def parse(body: bytes) -> Any:
    """The value of a JSON document.

    Raises:
        StrictJSONError: 400 for what is not UTF-8, not JSON or nested deeper than 32; 422 for duplicate keys,
            NaN, Infinity, integers no double holds and halves of surrogate pairs.
    """
    try:
        text = body.decode("utf-8")
    except UnicodeDecodeError:
        raise StrictJSONError(400, "The body is not valid UTF-8") from None
    try:
        value = json.loads(text, object_pairs_hook=_object, parse_constant=_constant, parse_int=_integer)
    except StrictJSONError:
        raise
    except RecursionError:
        raise _too_deep() from None
    except ValueError as error:
        place = f" (line {error.lineno}, column {error.colno})" if isinstance(error, json.JSONDecodeError) else ""
        raise StrictJSONError(400, f"The body is not valid JSON{place}") from None
    _check(value)
    return value


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
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
    return StrictJSONError(400, f"The body is nested deeper than {MAX_DEPTH}")


def _check(value: Any) -> None:
    """Depth and text of a parsed value, level by level without recursion."""
    level, depth = [value], 0
    while level:
        containers = [item for item in level if isinstance(item, dict | list)]
        depth += bool(containers)
        if depth > MAX_DEPTH:
            raise _too_deep()
        for text in (item for item in level if isinstance(item, str)):
            _check_text(text)
        level = []
        for container in containers:
            if isinstance(container, dict):
                level.extend(container.keys())
                level.extend(container.values())
            else:
                level.extend(container)


def _check_text(text: str) -> None:
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        raise StrictJSONError(422, "A text holds half of a surrogate pair, which is no character") from None
