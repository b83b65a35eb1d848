"""The custom controllers that there are at the moment: looked for by the service, told to its workers."""

import asyncio
import hashlib
import logging
import re
import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, TypeVar

from backend.custom_controllers.controller_process import ControllerProcess
from backend.custom_controllers.description import Description, described, proxy_class
from sim_core import STRATEGIES, Controller, RidelabError, controller_files
from sim_core.controller_files import INSTALLED, ControllerFileError, Signature
from sim_core.errors import RefusedError

logger = logging.getLogger(__name__)

T = TypeVar("T")
LOADING = 5.0  # a file may take to be loaded [s]
TRY_AGAIN = 60.0  # after a file could not be loaded for a reason that may pass: a disk, a package, time [s]
PROCESSES = 2  # that a worker keeps, for the files driven last
AT_ONCE = 4  # files described at once
WAIT = 10.0  # a request waits so long for files that have changed; one that never ends holds nobody up for longer [s]


@dataclass(frozen=True, slots=True, kw_only=True)
class ControllerSource:
    """The controllers of one source.

    Attributes:
        source: One of `sim_core.controller_files.sources`.
        signature: By which its next change is noticed; None where it cannot be read.
        descriptions: Of its controllers; of a broken file those it had, or one that stands for it.
        fault: Why none of them can be driven; None where they can.
        limit: A run may take so long [s].
        failed_at: When it could not be loaded, for a reason that may pass, by the monotonic clock [s]; None else.
    """

    source: str
    signature: Signature | None
    descriptions: tuple[Description, ...]
    fault: str | None
    limit: float
    failed_at: float | None = field(default=None, compare=False)

    @property
    def name(self) -> str:
        """The file's name, or that of a package's entry point."""
        return self.source if self.source.startswith(INSTALLED) else Path(self.source).name


_sources: tuple[ControllerSource, ...] = ()
_checked: tuple[ControllerSource, ...] = ()  # the same; the second of one id has a fault and no controller
_of: dict[str, tuple[ControllerSource, Description]] = {}  # by a controller's id
_controllers: dict[str, type[Controller]] = {}
_processes: OrderedDict[str, tuple[str, ControllerProcess]] = OrderedDict()  # with digest, by source; last used last
_describing: set[ControllerProcess] = set()
_refreshing = threading.Lock()


def controller_sources() -> tuple[ControllerSource, ...]:
    """Return what there is, as it is told to workers."""
    return _sources


def set_sources(sources: tuple[ControllerSource, ...]) -> None:
    """Have these as what there is."""
    global _sources, _checked, _of, _controllers
    controller_files.set_controller_source(lambda: _controllers)  # this process loads no file itself
    same, _sources = sources == _sources, sources
    if same:
        return
    _checked = _each_id_once(sources)
    _of = {each.id: (source, each) for source in _checked for each in source.descriptions}
    _controllers = {name: proxy_class(each) for name, (_, each) in _of.items()}


def descriptions() -> list[Description]:
    """Return the descriptions of all custom controllers that can be used."""
    return [each for _, each in _of.values()]


def is_custom(name: str) -> bool:
    """Check whether it is the id of a custom controller."""
    return name in _of


def origin(name: str) -> tuple[ControllerSource, Description] | None:
    """Return where a controller comes from; None for one of ours."""
    return _of.get(name)


def source(name: str) -> dict[str, str] | None:
    """Return the file of a custom controller and its digest; None of one of ours, and where it is gone."""
    if name not in _of:
        return None
    controller_source, description = _of[name]
    return {"file": controller_source.name, "digest": description.digest}


def faults() -> dict[str, str]:
    """Return by file name why it cannot be used."""
    return {each.name: each.fault for each in _checked if each.fault is not None}


def refresh(limit: float) -> None:
    """Look again, and describe what has changed; takes about a second for a changed file.

    Args:
        limit: A run of a controller may take so long [s].
    """
    with _refreshing:
        before = {each.source: each for each in _sources}

        def look(source: str) -> ControllerSource:
            last = before.get(source)
            if last is not None and _current(last) and not _failed_long_ago(last):
                return replace(last, limit=limit)
            return _look(source, last, limit)

        with ThreadPoolExecutor(AT_ONCE) as pool:
            looks = tuple(pool.map(look, controller_files.sources()))
        faults_before = {each.source: each.fault for each in _checked}
        set_sources(looks)
        for each in _checked:
            if each.fault not in {None, faults_before.get(each.source)}:
                logger.warning("A controller file cannot be used: %s", each.fault)


def run_in_sandbox_process(name: str, function: Callable[..., T], *args: Any) -> T:
    """Call `function(*args)`, which drives that strategy: of a custom one in the process that has its file.

    Raises:
        ControllerCodeError: The strategy's code failed, as it would on every machine.
        ControllerFileError: It failed otherwise, ended its process or did not end.
        RidelabError: As the function raises.
    """
    if name not in _of:
        return function(*args)
    source, description = _of[name]
    if source.fault is not None:
        raise ControllerFileError(source.fault)
    digest, process = _processes.pop(source.source, ("", None))
    if process is not None and digest != description.digest:
        process.close()
    if process is None or digest != description.digest:
        process = _loaded(source, description)
    try:
        return process.call(function, *args, limit=source.limit)
    finally:
        if process.alive:
            _processes[source.source] = description.digest, process
        while len(_processes) > PROCESSES:
            _processes.popitem(last=False)[1][1].close()


def close() -> None:
    """End every process that has somebody's file."""
    for process in (*_describing, *(each for _, each in _processes.values())):
        process.close()


def _loaded(source: ControllerSource, description: Description) -> ControllerProcess:
    """Return a process that has loaded the file, which has to be as it was described."""
    process = ControllerProcess(_here(source.source))
    loaded = process.call(_descriptions, limit=LOADING)
    if description.digest not in {each.digest for each in loaded if each.id == description.id}:
        process.close()
        raise ControllerFileError(f"{source.name}: it was saved meanwhile, or is another file here: run it again")
    return process


def _here(source: str) -> str:
    """Return the same source on this machine, whose folders may be others."""
    name = Path(source).name
    return next((each for each in controller_files.sources() if Path(each).name == name), source)


def _descriptions() -> tuple[Description, ...]:
    """Return what this process's file has."""
    return tuple(map(described, controller_files.named_controllers().values()))


def _look(source: str, last: ControllerSource | None, limit: float) -> ControllerSource:
    before = () if last is None else last.descriptions
    signature = _signature(source, before)
    failed_at = None
    process = ControllerProcess(source)
    _describing.add(process)
    try:
        descriptions, fault = process.call(_descriptions, limit=LOADING), None
        after = _signature(source, descriptions)
        # Saved while it was loaded: the next look is at the new text.
        signature = after if signature is None or after is None or signature[0] == after[0] else signature
    except RidelabError as error:
        fault = error.message
        if not isinstance(error, RefusedError):
            failed_at = time.monotonic()
        digest = hashlib.sha256(repr((fault, signature)).encode()).hexdigest()  # no result of the one before
        descriptions = tuple(replace(each, digest=digest) for each in before or [_unknown(source, digest)])
    finally:
        _describing.discard(process)
        process.close()
    return ControllerSource(
        source=source,
        signature=signature,
        descriptions=descriptions,
        fault=fault,
        limit=limit,
        failed_at=failed_at,
    )


def _current(last: ControllerSource) -> bool:
    return _signature(last.source, last.descriptions) == last.signature


def _failed_long_ago(last: ControllerSource) -> bool:
    return last.failed_at is not None and time.monotonic() >= last.failed_at + TRY_AGAIN


def _signature(source: str, descriptions: tuple[Description, ...]) -> Signature | None:
    path = descriptions[0].file if descriptions else Path(source)
    try:
        return controller_files.signature(path, {name for each in descriptions for name in each.files})
    except ControllerFileError:
        return None


def _unknown(source: str, digest: str) -> Description:
    """Return what stands for a file that never could be loaded, so that its fault is told where strategies are."""
    name = re.sub("[^a-z0-9_]", "_", Path(source).stem.lower())
    return Description(
        id=name if name[:1].isalpha() else f"file_{name}",
        label=Path(source).name,
        text="Its file cannot be used.",
        fixed={},
        declared={},
        options={},
        file=Path(source),
        digest=digest,
    )


def _each_id_once(sources: Iterable[ControllerSource]) -> tuple[ControllerSource, ...]:
    """Return the sources, of which one without an id of its own for each controller has a fault in its place."""
    taken: dict[str, str] = dict.fromkeys(STRATEGIES, "Ridelab")
    unique = []
    for each in sources:
        twice = [name for name in (one.id for one in each.descriptions) if name in taken]
        if twice:
            fault = each.fault or f"{each.name}: {taken[twice[0]]} has a controller of the id {twice[0]} too"
            each = replace(each, descriptions=(), fault=fault)
        taken |= {one.id: each.name for one in each.descriptions}
        unique.append(each)
    return tuple(unique)


class Watch:
    """Notices files that have come, gone or changed.

    Args:
        limit: A run of a controller may take so long [s].
    """

    def __init__(self, limit: float) -> None:
        self._limit = limit
        set_sources(controller_sources())  # from here on this process loads no file itself
        self._look: asyncio.Task[None] | None = None

    async def refresh_if_changed(self) -> None:
        """Know what there is now, unless that takes long; nobody waits for another try of a file that was slow."""
        for _ in range(2):  # a look that began before the change does not have it
            same = [each.source for each in _sources] == controller_files.sources() and all(map(_current, _sources))
            if same and not any(map(_failed_long_ago, _sources)):
                return
            if self._look is None or self._look.done():
                self._look = asyncio.create_task(asyncio.to_thread(refresh, self._limit))
            if same:
                return
            await asyncio.wait({self._look}, timeout=WAIT)

    async def close(self) -> None:
        """Call a look off."""
        if self._look is not None and not self._look.done():
            close()
            await asyncio.wait({self._look})
