"""Unknown names in a request: which one, where, and which known names are similar. Nothing of HTTP.

What was sent is repeated only where it looks like a name, so that an error never carries anything else.
"""

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel

_NAME = re.compile(r"[A-Za-z0-9_.]{1,80}")

Path = Sequence[str | int]


def is_name(text: str | int) -> bool:
    """Whether it looks like a name: letters, digits, `_` and `.`, at most 80."""
    return _NAME.fullmatch(str(text)) is not None


def shown_path(path: Path) -> list[str | int]:
    """A path into a request for an error: up to the first step that is no plain name."""
    return list(itertools.takewhile(lambda step: isinstance(step, int) or is_name(step), path))


def pointer(path: Path) -> str:
    """JSON pointer (RFC 6901) into the request body."""
    return "".join("/" + str(step).replace("~", "~0").replace("/", "~1") for step in path)


def unknown_name(what: str, name: str | int, known: Sequence[str]) -> str:
    """Such as `Unknown field hight, perhaps height; there are shape, height, width`."""
    message = f"Unknown {what} {name}" if is_name(name) else f"Unknown {what}"
    similar = get_close_matches(str(name), known) if is_name(name) else []
    perhaps = f", perhaps {' or '.join(similar)}" if similar else ""
    return f"{message}{perhaps}; there are {', '.join(known) or 'none'}"


def locate_in_body(model: Any, path: Path) -> tuple[list[str | int], list[str]]:
    """Where a validation error is in the body that was sent, and the names an object there may have.

    Args:
        model: What the body is read as.
        path: The error's, which also names the members of unions that were tried.
    """
    shown: list[str | int] = []
    models = list(_union_members(model))
    for step in path:
        members = [member for each in models for member in _members_at(each, step)]
        if members:
            shown.append(step)
            models = members
        else:  # the step names a member of a union
            models = [each for each in models if step in _union_tags(each)] or models
    return shown, list(dict.fromkeys(name for each in models for name in _fields(each)))


def _union_members(annotation: Any) -> Iterator[Any]:
    """The members of a union, or the annotation itself; without `Annotated`."""
    if get_origin(annotation) is Annotated:
        yield from _union_members(get_args(annotation)[0])
    elif get_origin(annotation) in (Union, UnionType):
        for each in get_args(annotation):
            yield from _union_members(each)
    else:
        yield annotation


def _members_at(annotation: Any, step: str | int) -> Iterator[Any]:
    """What a value of that annotation may hold at a key or an index."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if isinstance(step, str) and step in (fields := _fields(annotation)):
        yield from _union_members(fields[step])
    elif isinstance(step, str) and origin is dict:
        yield from _union_members(arguments[1])
    elif isinstance(step, int) and origin is list:
        yield from _union_members(arguments[0])
    elif isinstance(step, int) and origin is tuple and step < len(arguments):
        yield from _union_members(arguments[step])


def _fields(annotation: Any) -> Mapping[str, Any]:
    """Annotation of each field of a model, by its name in JSON."""
    if not (isinstance(annotation, type) and issubclass(annotation, BaseModel)):
        return {}
    return {info.alias or name: info.annotation for name, info in annotation.model_fields.items()}


def _union_tags(annotation: Any) -> set[Any]:
    """What pydantic calls this member of a union: its name, or a value of what discriminates."""
    values = {value for each in _fields(annotation).values() for value in get_args(each)}
    return {getattr(annotation, "__name__", None), *(value for value in values if isinstance(value, str))}
