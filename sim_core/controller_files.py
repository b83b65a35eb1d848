"""Controllers from files of one's own: loaded, named by what stands in the files, and loaded again when those change.

`RIDELAB_CONTROLLERS` names files and folders, separated like PATH; a folder stands for the Python files in it. Loading
a file runs it: it is code that whoever names it trusts.
"""

import hashlib
import inspect
import os
import sys
import traceback
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from sim_core.control.controller import Controller
from sim_core.errors import RidelabError

VARIABLE = "RIDELAB_CONTROLLERS"
_PREFIX = "ridelab_controllers_"  # of the modules' names: no package has it

_Signature = tuple[tuple[int, int], ...]  # of each file: when it was last written [ns], and its size [bytes]


class ControllerFileError(RidelabError):
    """A controller file cannot be used; the message has its name and, where there is one, the line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Loaded:
    signature: _Signature
    controllers: dict[str, type[Controller]]


_loaded: dict[Path, _Loaded] = {}


def load_controllers(file: str | Path) -> dict[str, type[Controller]]:
    """The controllers of a Python file, by id; it is run once, and again when it has changed.

    A class that an import brought in does not count, nor does one without an id, which others derive from. A
    controller that reads further files, such as weights, names them in `files`: with its own file they make
    `file_digest`, by which stored results know it.

    Args:
        file: Its path.

    Raises:
        ControllerFileError: It cannot be read or run, has no controller, or two of one id.

    Example:
        >>> from pathlib import Path
        >>> from tempfile import TemporaryDirectory
        >>> from sim_core import Scenario, load_controllers, simulate
        >>> text = '''
        ... import sim_core
        ... class Nothing(sim_core.Controller):
        ...     "Gives no force."
        ...     id, label = "nothing", "Nothing"
        ...     def force(self, seen):
        ...         return 0.0, 0.0
        ... '''
        >>> with TemporaryDirectory() as folder:
        ...     file = Path(folder) / "nothing.py"
        ...     _ = file.write_text(text)
        ...     own = load_controllers(file)
        >>> list(own), simulate(Scenario(), own["nothing"]).events["limited_steps"]
        (['nothing'], 0)
    """
    path = Path(file).absolute()
    known = _loaded.get(path)
    if known is None or known.signature != _signature(path, known.controllers):
        controllers = _run(path)
        known = _loaded[path] = _Loaded(signature=_signature(path, controllers), controllers=controllers)
    return dict(known.controllers)


def named_controllers() -> dict[str, type[Controller]]:
    """The controllers of all files that `RIDELAB_CONTROLLERS` names, by id.

    Raises:
        ControllerFileError: One of them cannot be used, or two have a controller of one id.
    """
    controllers: dict[str, type[Controller]] = {}
    for file in _named_files():
        for name, controller in load_controllers(file).items():
            if name in controllers:
                other = inspect.getfile(controllers[name])
                raise ControllerFileError(f"{file}: {other} has a controller of the id {name} too")
            controllers[name] = controller
    return controllers


def _named_files() -> Iterator[Path]:
    for text in filter(None, os.environ.get(VARIABLE, "").split(os.pathsep)):
        path = Path(text).expanduser()
        if path.is_dir():
            yield from sorted(each for each in path.glob("*.py") if not each.name.startswith("_"))
        else:
            yield path


def _signature(path: Path, controllers: dict[str, type[Controller]]) -> _Signature:
    try:
        return tuple((each.st_mtime_ns, each.st_size) for each in map(Path.stat, _files(path, controllers)))
    except OSError as error:
        raise _unreadable(path, error) from None


def _files(path: Path, controllers: dict[str, type[Controller]]) -> list[Path]:
    """The file, and those that its controllers read."""
    names = {name for each in controllers.values() for name in each.files}
    return [path, *(path.parent / name for name in sorted(names))]


def _run(path: Path) -> dict[str, type[Controller]]:
    try:
        source = path.read_bytes()
    except OSError as error:
        raise _unreadable(path, error) from None
    module = ModuleType(f"{_PREFIX}{hashlib.sha256(os.fsencode(path) + source).hexdigest()[:16]}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module  # where `inspect` and the types of options look for it
    try:
        exec(compile(source, str(path), "exec"), vars(module))  # noqa: S102 - it is what was asked for
    except (Exception, SystemExit) as error:
        raise ControllerFileError(said_by(error, path)) from error
    controllers = _controllers(path, module)
    try:
        contents = [each.read_bytes() for each in _files(path, controllers)[1:]]
    except OSError as error:
        raise _unreadable(path, error) from None
    digests = [hashlib.sha256(content).digest() for content in (source, *contents)]
    for controller in controllers.values():
        controller.file_digest = hashlib.sha256(b"".join(digests)).hexdigest()
    return controllers


def _controllers(path: Path, module: ModuleType) -> dict[str, type[Controller]]:
    controllers: dict[str, type[Controller]] = {}
    for value in vars(module).values():
        if not (isinstance(value, type) and issubclass(value, Controller)) or value.__module__ != module.__name__:
            continue
        name: object = value.id  # a visitor's class may hold anything
        if not name:
            continue
        if not isinstance(name, str):
            raise ControllerFileError(f"{path}: the id of {value.__name__} is no text")
        if controllers.get(name, value) is not value:
            raise ControllerFileError(f"{path}: two controllers have the id {name}")
        controllers[name] = value
    if not controllers:
        raise ControllerFileError(f"{path}: it has no class derived from sim_core.Controller with an id")
    return controllers


def said_by(error: BaseException, path: Path | str) -> str:
    """What an error of somebody's controller says, with the last line of their file that led to it."""
    kind, detail = type(error).__name__, str(error)
    if isinstance(error, SystemExit):
        kind, detail = "It ends the program", "leave out sys.exit"
    lines = [each.lineno for each in traceback.extract_tb(error.__traceback__) if each.filename == str(path)]
    if isinstance(error, SyntaxError) and error.filename == str(path):
        lines, detail = [error.lineno], error.msg
    place = f"{path}, line {lines[-1]}" if lines else str(path)
    return f"{place}: {kind}{f': {detail}' if detail else ''}"


def _unreadable(path: Path, error: OSError) -> ControllerFileError:
    return ControllerFileError(f"{error.filename or path}: it cannot be read: {error.strerror}")
