"""Controllers from files of one's own: loaded, named by what stands in the files, and loaded again when those change.

`RIDELAB_CONTROLLERS` names files and folders, separated like PATH; a folder stands for the files in it that `LOADERS`
can load. A package names its own by the entry-point group `ridelab.controllers`. Loading a file runs it: it is code
that whoever names it trusts.
"""

import hashlib
import inspect
import json
import os
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from types import ModuleType

from sim_core.control.controller import Controller
from sim_core.errors import ForceError, RefusedError, RidelabError
from sim_core.fmi.controller import controllers_of_fmu

VARIABLE = "RIDELAB_CONTROLLERS"
GROUP = "ridelab.controllers"
INSTALLED = "entry point "  # how the source of a package's controllers begins
_PREFIX = "ridelab_controllers_"  # of the modules' names: no package has it

Controllers = dict[str, type[Controller]]  # by id
Signature = tuple[tuple[int, int], ...]  # of each file: when it was last written [ns], and its size [bytes]


class ControllerFileError(RidelabError):
    """A controller file cannot be used; the message has its name and, where there is one, the line."""


class ControllerCodeError(ControllerFileError, RefusedError):
    """A controller file's own code is to blame: it fails alike on every machine."""


# Errors of a controller's own code that it raises alike on every machine. Others can have passed by the next try: one
# of a file or a network (OSError), of memory, of an import, of a thread that cannot be started (RuntimeError).
CODE_ERRORS = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    NameError,
    NotImplementedError,
    RefusedError,
    SyntaxError,
    TypeError,
    ValueError,
)
# These are ValueErrors, but of what is decoded: a file that is damaged on one machine.
_DECODING_ERRORS = (UnicodeError, json.JSONDecodeError)


_loaded: dict[Path, tuple[Signature, Controllers]] = {}


def load_controllers(file: str | Path) -> Controllers:
    """Return the controllers of a file, by id; it is run once, and again when it has changed.

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
    before, controllers = _loaded.get(path, (None, {}))
    if before != signature(path, files_of(controllers)):
        controllers = run_anew(path)
        _loaded[path] = signature(path, files_of(controllers)), controllers
    return dict(controllers)


def run_anew(path: Path) -> Controllers:
    """Return the controllers of a file that is run again although it has not changed; raise ControllerFileError."""
    source = _read(path)
    return _with_digest(path, LOADERS.get(path.suffix, _run)(path, source), source)


def named_controllers() -> Controllers:
    """Return the controllers of everything in `sources`, by id.

    Raises:
        ControllerFileError: One of the files cannot be used, or two have a controller of one id.
    """
    return _find()


def set_controller_source(find: Callable[[], Controllers]) -> None:
    """Have `named_controllers` answer otherwise in this process: the service runs nobody's file in its own."""
    global _find
    _find = find


def load_all() -> Controllers:
    """Return the controllers of everything in `sources`, loaded in this process; raises ControllerFileError."""
    controllers: Controllers = {}
    for source in sources():
        for name, controller in load(source).items():
            if name in controllers:
                other = inspect.getfile(controllers[name])
                raise ControllerCodeError(f"{source}: {other} has a controller of the id {name} too")
            controllers[name] = controller
    return controllers


_find = load_all


def source_of(controller: type[Controller]) -> dict[str, str] | None:
    """Return the name of a controller's file and its digest; None of one that no file was loaded for."""
    if controller.file_digest is None:
        return None
    return {"file": Path(inspect.getfile(controller)).name, "digest": controller.file_digest}


def sources() -> list[str]:
    """Return where controllers come from: paths of files, and `entry point NAME` of an installed package's."""
    return [*map(str, _named_files()), *(f"{INSTALLED}{name}" for name in _installed())]


def load(source: str) -> Controllers:
    """Return the controllers of one of `sources`, by id.

    Raises:
        ControllerFileError: It cannot be used.
    """
    if not source.startswith(INSTALLED):
        return load_controllers(source)
    try:
        loaded = _installed()[source.removeprefix(INSTALLED)].load()
    except KeyError:
        raise ControllerFileError(f"{source}: no installed package has it") from None
    except (Exception, SystemExit) as error:
        raise file_error(error, source) from error
    if isinstance(loaded, ModuleType):
        path = Path(str(loaded.__file__))
        return _with_digest(path, _controllers(path, loaded), _read(path))
    if not (isinstance(loaded, type) and issubclass(loaded, Controller) and loaded.id):
        raise ControllerCodeError(f"{source}: it names no module and no class derived from sim_core.Controller")
    path = Path(inspect.getfile(loaded))
    return _with_digest(path, {loaded.id: loaded}, _read(path))


@cache
def _installed() -> Mapping[str, EntryPoint]:
    return {each.name: each for each in entry_points(group=GROUP)}


def _named_files() -> Iterator[Path]:
    for text in filter(None, os.environ.get(VARIABLE, "").split(os.pathsep)):
        path = Path(text).expanduser().absolute()
        if path.is_dir():
            yield from sorted(
                each for each in path.iterdir() if each.suffix in LOADERS and not each.name.startswith(("_", "."))
            )
        else:
            yield path


def signature(path: Path, files: Iterable[str]) -> Signature:
    """Return by what a change of a file, or of those that its controllers read, is noticed.

    Raises:
        ControllerFileError: One of them cannot be read.
    """
    try:
        return tuple((each.st_mtime_ns, each.st_size) for each in map(Path.stat, _files(path, files)))
    except OSError as error:
        raise _unreadable(path, error) from None


def files_of(controllers: Controllers) -> set[str]:
    """Return what those controllers read beside their own file."""
    return {name for each in controllers.values() for name in each.files}


def _files(path: Path, names: Iterable[str]) -> list[Path]:
    return [path, *(path.parent / name for name in sorted(names))]


def _run(path: Path, source: bytes) -> Controllers:
    """Return the controllers of a Python file, which is run."""
    module = ModuleType(f"{_PREFIX}{hashlib.sha256(os.fsencode(path) + source).hexdigest()[:16]}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module  # where `inspect` and the types of options look for it
    try:
        exec(compile(source, str(path), "exec"), vars(module))  # noqa: S102 - it is what was asked for
    except (Exception, SystemExit) as error:
        raise file_error(error, path) from error
    return _controllers(path, module)


def _fmu(path: Path, content: bytes) -> Controllers:
    try:
        return controllers_of_fmu(path, content)
    except RidelabError as error:
        kind = ControllerCodeError if isinstance(error, RefusedError) else ControllerFileError
        raise kind(f"{path}: {error.message}") from None


# What loads a file of some bytes, by its suffix: a further kind of controller needs a function that gives its classes.
LOADERS: dict[str, Callable[[Path, bytes], Controllers]] = {".py": _run, ".fmu": _fmu}


def _with_digest(path: Path, controllers: Controllers, source: bytes) -> Controllers:
    """Return the same controllers, which know the digest of their file and of those that they read."""
    contents = [source, *map(_read, _files(path, files_of(controllers))[1:])]
    digests = b"".join(hashlib.sha256(content).digest() for content in contents)
    for controller in controllers.values():
        controller.file_digest = hashlib.sha256(digests).hexdigest()
    return controllers


def _controllers(path: Path, module: ModuleType) -> Controllers:
    controllers: Controllers = {}
    for value in vars(module).values():
        if not (isinstance(value, type) and issubclass(value, Controller)) or value.__module__ != module.__name__:
            continue
        name: object = value.id  # a visitor's class may hold anything
        if not name:
            continue
        if not isinstance(name, str):
            raise ControllerCodeError(f"{path}: the id of {value.__name__} is no text")
        if controllers.get(name, value) is not value:
            raise ControllerCodeError(f"{path}: two controllers have the id {name}")
        controllers[name] = value
    if not controllers:
        raise ControllerCodeError(f"{path}: it has no class derived from sim_core.Controller with an id")
    return controllers


def file_error(error: BaseException, path: Path | str) -> ControllerFileError:
    """Return what to raise for an error of somebody's controller: a `ControllerCodeError` if its code is to blame.

    An error that another one led to counts as that one: what `open` raised does not become the code's own by being
    raised again as a ValueError.
    """
    causes = [error]
    while (earlier := causes[-1].__cause__ or causes[-1].__context__) is not None:
        causes.append(earlier)
    return (ControllerCodeError if all(map(_is_of_code, causes)) else ControllerFileError)(format_error(error, path))


def _is_of_code(error: BaseException) -> bool:
    """Check whether code raises an error alike on every machine: not for what it lacks in a file or in `os.environ`."""
    frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
    of_environment = isinstance(error, KeyError) and frames[-1:] and frames[-1].f_globals is vars(os)
    return isinstance(error, CODE_ERRORS) and not (of_environment or isinstance(error, _DECODING_ERRORS))


def format_error(error: BaseException, path: Path | str) -> str:
    """Return what an error of somebody's controller says, with the last line of their file that led to it."""
    if isinstance(error, ForceError):
        return f"{path}{'' if error.line is None else f', line {error.line}'}: {error.message}"
    kind, detail = type(error).__name__, str(error)
    if isinstance(error, SystemExit):
        kind, detail = "It ends the program", "leave out sys.exit"
    lines = [each.lineno for each in traceback.extract_tb(error.__traceback__) if each.filename == str(path)]
    if isinstance(error, SyntaxError) and error.filename == str(path):
        lines, detail = [error.lineno], error.msg
    place = f"{path}, line {lines[-1]}" if lines else str(path)
    hint = " (it changes what it was given: copy it first)" if "read-only" in detail else ""
    return f"{place}: {kind}{f': {detail}' if detail else ''}{hint}"


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise _unreadable(path, error) from None


def _unreadable(path: Path, error: OSError) -> ControllerFileError:
    return ControllerFileError(f"{error.filename or path}: it cannot be read: {error.strerror}")
