"""The reference of a library, written from its docstrings: docs/reference/library.md and client.md."""

import inspect
import re
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import ridelab
import sim_core

_SECTION = re.compile(r"^(Args|Attributes|Returns|Raises|Yields|Example|Examples|Note):$")
_ENTRY = re.compile(r"^(\*{0,2}[\w.]+): (.*)$")


def library() -> str:
    """The core's page."""
    lesson = "[Ten cells](../tutorials/ten-cells.md) lead through it; all starts with a `Scenario` and `simulate`."
    return _page(sim_core, "The library `sim_core`", f"`pip install ./sim_core`. {lesson}")


def client() -> str:
    """The client's page."""
    lesson = (
        "[A sweep from a script](../tutorials/sweep-from-a-script.md) leads through it; all starts with a `Ridelab`."
    )
    return _page(ridelab, "The client `ridelab`", f"`pip install ./client`. {lesson}", first="Ridelab")


def _page(package: ModuleType, title: str, introduction: str, first: str = "") -> str:
    lines = [f"# {title}", "", introduction, "Written from its docstrings; a test keeps this page equal to them.", ""]
    for name in sorted(package.__all__, key=lambda name: name != first):  # the others stay in their order
        public = getattr(package, name)
        if not (inspect.isclass(public) or inspect.isfunction(public)):
            continue  # constants and types
        lines += [f"## {name}", "", f"`{name}{_signature(public)}`", "", *_text(public), ""]
        for method, function in _methods(public, package):
            lines += [f"### {name}.{method}", "", f"`{method}{_signature(function)}`", "", *_text(function), ""]
    return "\n".join(lines).rstrip() + "\n"


def _methods(public: Any, package: ModuleType) -> Iterator[tuple[str, Any]]:
    """Methods and properties that a class documents, in their order, then those of bases that have no entry."""
    if not inspect.isclass(public) or "model_fields" in dir(public):  # what pydantic adds is not ours
        return
    bases = [each for each in public.__mro__[1:] if each.__module__.startswith(f"{package.__name__}.")]
    documented_here = (public, *(each for each in bases if each.__name__ not in package.__all__))
    for name in dict.fromkeys(name for each in documented_here for name in vars(each)):
        member = inspect.getattr_static(public, name)
        function = getattr(member, "__func__", getattr(member, "fget", None) or member)
        if not name.startswith("_") and inspect.isfunction(function) and function.__doc__:
            yield name, member if isinstance(member, property) else function


def _signature(public: Any) -> str:
    """Names and defaults; types are in the code and in what an editor shows."""
    if isinstance(public, property) or (inspect.isclass(public) and "model_fields" in dir(public)):
        return ""
    try:
        signature = inspect.signature(public)
    except ValueError:
        return "()"
    bare = [each.replace(annotation=each.empty) for name, each in signature.parameters.items() if name != "self"]
    text = str(signature.replace(parameters=bare, return_annotation=signature.empty))
    return re.sub(r"<function (\w+) at 0x\w+>", r"\1", text)  # a default that is a function


def _text(public: Any) -> Iterator[str]:
    """A Google docstring as Markdown: entries as a list, examples as code."""
    section = ""
    for line in inspect.cleandoc(public.__doc__ or "").splitlines():
        if match := _SECTION.match(line):
            if section.startswith("Example"):
                yield "```"
            section = match[1]
            yield from ("", f"**{section}**", "", *(["```pycon"] if section.startswith("Example") else []))
        elif section.startswith("Example"):
            yield line.removeprefix("    ")
        elif section and (entry := _ENTRY.match(line.removeprefix("    "))):
            yield f"- `{entry[1]}`: {entry[2]}"
        else:
            yield f"  {line.strip()}" if section and line.startswith("     ") else line.strip()
    if section.startswith("Example"):
        yield "```"
