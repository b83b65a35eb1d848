"""The controllers of one's own that there are at the moment: looked for by the service, told to its workers."""

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

from backend.custom_controllers.description import Description, described, stand_in
from backend.custom_controllers.host import Host
from sim_core import STRATEGIES, Controller, RidelabError, controller_files
from sim_core.controller_files import INSTALLED, ControllerFileError, Signature
from sim_core.errors import RefusedError

logger = logging.getLogger(__name__)

T = TypeVar("T")
LOADING = 5.0  # a file may take to be loaded [s]
TRY_AGAIN = 60.0  # after a file could not be loaded for a reason that may pass: a disk, a package, time; at first [s]
HOSTS = 2  # that a worker keeps, for the files driven last
AT_ONCE = 4  # files described at once


@dataclass(frozen=True, slots=True, kw_only=True)
class ControllerSource:
    """What one source has.

    Attributes:
        source: One of `sim_core.controller_files.sources`.
        signature: By which its next change is noticed; None where it cannot be read.
        descriptions: Of its controllers; of a broken file those it had, or one that stands for it.
        fault: Why none of them can be driven; None where they can.
        limit: A run may take so long [s].
        tries: How often in a row its file could not be loaded for a reason that may pass.
        tried_at: When it was last loaded, by the monotonic clock [s].
    """

    source: str
    signature: Signature | None
    descriptions: tuple[Description, ...]
    fault: str | None
    limit: float
    tries: int = field(default=0, compare=False)
    tried_at: float = field(default=0.0, compare=False)

    @property
    def name(self) -> str:
        """The file's name, or that of a package's entry point."""
        return self.source if self.source.startswith(INSTALLED) else Path(self.source).name


_sources: tuple[ControllerSource, ...] = ()
_checked: tuple[ControllerSource, ...] = ()  # the same; the second of one id has a fault and no controller
_of: dict[str, tuple[ControllerSource, Description]] = {}  # by a controller's id
_controllers: dict[str, type[Controller]] = {}
_hosts: OrderedDict[str, tuple[str, Host]] = OrderedDict()  # digest and host, by source; the last used is last
_describing: set[Host] = set()
_refreshing = threading.Lock()


def controller_sources() -> tuple[ControllerSource, ...]:
    """What there is, as it is told to workers."""
    return _sources


def adopt(sources: tuple[ControllerSource, ...]) -> None:
    """Take this as what there is."""
    global _sources, _checked, _of, _controllers
    controller_files.set_controller_source(lambda: _controllers)  # this process loads no file itself
    same, _sources = sources == _sources, sources
    if same:
        return
    _checked = _each_id_once(sources)
    _of = {each.id: (source, each) for source in _checked for each in source.descriptions}
    _controllers = {name: stand_in(each) for name, (_, each) in _of.items()}


def descriptions() -> list[Description]:
    """Of all controllers of one's own that can be used."""
    return [each for _, each in _of.values()]


def is_own(name: str) -> bool:
    """Whether it is the id of a controller of one's own."""
    return name in _of


def origin(name: str) -> tuple[ControllerSource, Description] | None:
    """Where a controller comes from; None for one of ours."""
    return _of.get(name)


def source(name: str) -> dict[str, str] | None:
    """The file of a controller of one's own and its digest; None of one of ours, and where it is gone."""
    if name not in _of:
        return None
    controller_source, description = _of[name]
    return {"file": controller_source.name, "digest": description.digest}


def faults() -> dict[str, str]:
    """By file name why it cannot be used."""
    return {each.name: each.fault for each in _checked if each.fault is not None}


def stale() -> bool:
    """Whether a file has come, gone or changed since `refresh`."""
    return [each.source for each in _sources] != controller_files.sources() or not all(map(_current, _sources))


def refresh(limit: float) -> None:
    """Look again, and describe what has changed; takes about a second for a changed file.

    Args:
        limit: A run of a controller may take so long [s].
    """
    with _refreshing:
        before = {each.source: each for each in _sources}

        def look(source: str) -> ControllerSource:
            last = before.get(source)
            if last is not None and _current(last):
                return replace(last, limit=limit)
            return _look(source, last, limit)

        with ThreadPoolExecutor(AT_ONCE) as pool:
            _take(pool.map(look, controller_files.sources()))


def retry_due() -> bool:
    """Check whether a file that could not be loaded is due for another try; each pause is twice the one before."""
    return any(map(_due, _sources))


def try_again(limit: float) -> None:
    """Describe the files that are due for another try, whatever `refresh` does meanwhile.

    Args:
        limit: A run of a controller may take so long [s].
    """
    due = list(filter(_due, _sources))
    with ThreadPoolExecutor(AT_ONCE) as pool:
        looks = list(pool.map(lambda each: _look(each.source, each, limit), due))
    with _refreshing:
        again = {last.source: look for last, look in zip(due, looks, strict=True) if last in _sources}
        _take(again.get(each.source, each) for each in _sources)


def isolated(name: str, function: Callable[..., T], *args: Any) -> T:
    """`function(*args)`, which drives the strategy of that id: of one's own in the process that has its file.

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
    digest, host = _hosts.pop(source.source, ("", None))
    if host is not None and digest != description.digest:
        host.close()
    if host is None or digest != description.digest:
        host = _loaded(source, description)
    try:
        return host.call(function, *args, limit=source.limit)
    finally:
        if host.alive:
            _hosts[source.source] = description.digest, host
        while len(_hosts) > HOSTS:
            _hosts.popitem(last=False)[1][1].close()


def close() -> None:
    """End every process that has somebody's file."""
    for host in (*_describing, *(each for _, each in _hosts.values())):
        host.close()


def _loaded(source: ControllerSource, description: Description) -> Host:
    """A host that has loaded the file, which has to be as it was described."""
    host = Host(_here(source.source))
    loaded = host.call(_descriptions, limit=LOADING)
    if description.digest not in {each.digest for each in loaded if each.id == description.id}:
        host.close()
        raise ControllerFileError(f"{source.name}: it was saved meanwhile, or is another file here: run it again")
    return host


def _here(source: str) -> str:
    """The same source on this machine, whose folders may be others."""
    name = Path(source).name
    return next((each for each in controller_files.sources() if Path(each).name == name), source)


def _descriptions() -> tuple[Description, ...]:
    """In a host: what its file has."""
    return tuple(map(described, controller_files.named_controllers().values()))


def _take(sources: Iterable[ControllerSource]) -> None:
    before = {each.source: each.fault for each in _checked}
    adopt(tuple(sources))
    for each in _checked:
        if each.fault not in {None, before.get(each.source)}:
            logger.warning("A controller file cannot be used: %s", each.fault)


def _look(source: str, last: ControllerSource | None, limit: float) -> ControllerSource:
    before = () if last is None else last.descriptions
    signature = _signature(source, before)
    tries = 0
    host = Host(source)
    _describing.add(host)
    try:
        descriptions, fault = host.call(_descriptions, limit=LOADING), None
        after = _signature(source, descriptions)
        # Saved while it was loaded: the next look is at the new text.
        signature = after if signature is None or after is None or signature[0] == after[0] else signature
    except RidelabError as error:
        fault = error.message
        if not isinstance(error, RefusedError):
            tries = 1 + (last.tries if last is not None and last.signature == signature else 0)
        digest = hashlib.sha256(repr((fault, signature)).encode()).hexdigest()  # it has no result of the law before
        descriptions = tuple(replace(each, digest=digest) for each in before or [_unknown(source, digest)])
    finally:
        _describing.discard(host)
        host.close()
    return ControllerSource(
        source=source,
        signature=signature,
        descriptions=descriptions,
        fault=fault,
        limit=limit,
        tries=tries,
        tried_at=time.monotonic(),
    )


def _current(last: ControllerSource) -> bool:
    return _signature(last.source, last.descriptions) == last.signature


def _due(last: ControllerSource) -> bool:
    pause = TRY_AGAIN * 2 ** (last.tries - 1)
    return last.tries > 0 and time.monotonic() >= last.tried_at + pause


def _signature(source: str, descriptions: tuple[Description, ...]) -> Signature | None:
    path = descriptions[0].file if descriptions else Path(source)
    try:
        return controller_files.signature(path, {name for each in descriptions for name in each.files})
    except ControllerFileError:
        return None


def _unknown(source: str, digest: str) -> Description:
    """What stands for a file that never could be loaded, so that its fault is told where strategies are."""
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
    """The sources, of which one without an id of its own for each controller has a fault in its place."""
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
