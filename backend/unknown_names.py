"""Names a request has that nothing has: which one, where, and what it may have meant. No web here.

What somebody typed is repeated only where it looks like a name, so that an error never carries anything else.
"""

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel

_SANE = re.compile(r"[A-Za-z0-9_.]{1,80}")

Path = Sequence[str | int]


def is_name(text: str | int) -> bool:
    """Whether it looks like one: letters, digits, `_` and `.`, at most 80."""
    return _SANE.fullmatch(str(text)) is not None


def shown_path(path: Path) -> list[str | int]:
    """A path into a request for an error: up to the first step that is no plain name."""
    return list(itertools.takewhile(lambda step: isinstance(step, int) or is_name(step), path))


def unknown(what: str, name: str | int, known: Sequence[str]) -> str:
    """Such as `Unknown field hight, perhaps height; there are shape, height, width`."""
    said = f"Unknown {what} {name}" if is_name(name) else f"Unknown {what}"
    near = get_close_matches(str(name), known) if is_name(name) else []
    perhaps = f", perhaps {' or '.join(near)}" if near else ""
    return f"{said}{perhaps}; there are {', '.join(known) or 'none'}"


def in_body(model: Any, path: Path) -> tuple[list[str | int], list[str]]:
    """Where a validation error is in the body that was sent, and the names an object there may have.

    Args:
        model: What the body is read as.
        path: The error's, which also names the members of unions that were tried.
    """
    shown: list[str | int] = []
    here = list(_choices(model))
    for step in path:
        below = [choice for each in here for choice in _below(each, step)]
        if below:
            shown.append(step)
            here = below
        else:
            here = [each for each in here if step in _tags(each)] or here
    return shown, list(dict.fromkeys(name for each in here for name in _fields(each)))


def _choices(annotation: Any) -> Iterator[Any]:
    """What it may be, without what only annotates."""
    if get_origin(annotation) is Annotated:
        yield from _choices(get_args(annotation)[0])
    elif get_origin(annotation) in (Union, UnionType):
        for each in get_args(annotation):
            yield from _choices(each)
    else:
        yield annotation


def _below(annotation: Any, step: str | int) -> Iterator[Any]:
    origin, arguments = get_origin(annotation), get_args(annotation)
    if isinstance(step, str) and step in (fields := _fields(annotation)):
        yield from _choices(fields[step])
    elif isinstance(step, str) and origin is dict:
        yield from _choices(arguments[1])
    elif isinstance(step, int) and origin is list:
        yield from _choices(arguments[0])
    elif isinstance(step, int) and origin is tuple and step < len(arguments):
        yield from _choices(arguments[step])


def _fields(annotation: Any) -> Mapping[str, Any]:
    """By the name in JSON what each field is."""
    if not (isinstance(annotation, type) and issubclass(annotation, BaseModel)):
        return {}
    return {info.alias or name: info.annotation for name, info in annotation.model_fields.items()}


def _tags(annotation: Any) -> set[Any]:
    """What pydantic calls this member of a union: its name, or a value of what discriminates."""
    values = {value for each in _fields(annotation).values() for value in get_args(each)}
    return {getattr(annotation, "__name__", None), *(value for value in values if isinstance(value, str))}
