"""Translates pydantic's errors: the field of the request, and for an unknown name those that exist."""

from collections.abc import Iterator, Mapping
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel

from backend.unknown_names import Path, is_name, pointer, shown_path, unknown_name
from sim_core.scenario import dotted

_LISTS_OF_NAMES = ["strategies"], ["signals"]  # of requests


def to_field_error(item: Mapping[str, Any], model: Any) -> dict[str, str]:
    """Return the field that one of pydantic's errors is about and its message, without the value sent.

    Args:
        item: The error.
        model: What the body is read as.
    """
    where, *path = item["loc"] or ("body",)
    context = item.get("ctx") or {}
    message = str(item["msg"])
    if where != "body":
        return {"parameter": str(path[-1]) if path else "", "pointer": "", "message": message}
    if item["type"] == "extra_forbidden":
        path, names = locate_in_body(model, path[:-1])
        path.append(item["loc"][-1])
        message = unknown_name("field", item["loc"][-1], names)
    elif item["type"] == "unknown_key":
        path.append(context["key"])
        message = unknown_name(context["what"], context["key"], context["allowed"])
    elif item["type"] == "inconsistent":
        path += [*filter(None, context["field"].split(".")), *([key] if (key := context.get("key")) else [])]
    elif item["type"] in {"list_type", "tuple_type"}:
        sent, message = item["input"], "This has to be a list"
        if path in _LISTS_OF_NAMES and isinstance(sent, str) and is_name(sent):
            message += f': write ["{sent}"]'
    elif item["type"] == "too_short" and context.get("min_length") == 1:
        message = "There has to be at least one"
    elif item["type"] == "model_attributes_type" or (not path and item["type"] != "missing"):
        message = "This has to be a JSON object"
    else:
        message = dotted.explain(item, _unit(path))
    return {"pointer": pointer(shown_path(path)), "message": message}


def _unit(path: Path) -> str:
    """Return the unit of the scenario's field at a path into the body; `1` where it is no field or has none."""
    field = dotted.scenario_fields().get(".".join(map(str, path[1:]))) if path[:1] == ["scenario"] else None
    return "1" if field is None else field.unit


def locate_in_body(model: Any, path: Path) -> tuple[list[str | int], list[str]]:
    """Return the path of a validation error in the body, and the names that an object there may have.

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
    """Yield the members of a union, or the annotation itself; without `Annotated`."""
    if get_origin(annotation) is Annotated:
        yield from _union_members(get_args(annotation)[0])
    elif get_origin(annotation) in (Union, UnionType):
        for each in get_args(annotation):
            yield from _union_members(each)
    else:
        yield annotation


def _members_at(annotation: Any, step: str | int) -> Iterator[Any]:
    """Yield what a value of that annotation may hold at a key or an index."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if isinstance(step, str) and step in (fields := _fields(annotation)):
        yield from _union_members(fields[step])
    elif isinstance(step, str) and origin is dict:
        yield from _union_members(arguments[1])
    elif (isinstance(step, int) and origin is list) or (
        isinstance(step, int) and origin is tuple and arguments[-1] is ...
    ):
        yield from _union_members(arguments[0])
    elif isinstance(step, int) and origin is tuple and step < len(arguments):
        yield from _union_members(arguments[step])


def _fields(annotation: Any) -> Mapping[str, Any]:
    """Annotation of each field of a model, by its name in JSON."""
    if not (isinstance(annotation, type) and issubclass(annotation, BaseModel)):
        return {}
    return {info.alias or name: info.annotation for name, info in annotation.model_fields.items()}


def _union_tags(annotation: Any) -> set[Any]:
    """Return what pydantic calls this member of a union: its name, or a value of what discriminates."""
    values = {value for each in _fields(annotation).values() for value in get_args(each)}
    return {getattr(annotation, "__name__", None), *(value for value in values if isinstance(value, str))}
