"""The meanings of SCENARIO and RESULT on the command line: a file, a preset, an id, an address."""

import json
import re
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from ridelab.cli.reporting import InputError
from ridelab.cli.service import Services
from ridelab.client import Ridelab
from ridelab.errors import RidelabAPIError
from ridelab.fields import similar
from ridelab.http import without_login
from ridelab.jobs import Batch, Job
from ridelab.results import LinkedResult, RunResult

_ID = re.compile(r"[A-Za-z0-9_-]{22}")
_FILTER = {"kind", "acceleration_noise", "deflection_noise", "pitch_rate_noise"}  # what core 0.3.0 says of a filter
_PAGES = {"r": "get_run", "b": "get_batch", "s": "open_link"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A scenario, and the stored result that it belongs to if there is one."""

    name: str
    scenario: dict[str, Any]  # perhaps in part; what is left out takes the paper's value
    run: RunResult | None = None
    batch: Batch | None = None
    slug: str | None = None  # of the shared link that led to it
    ridelab: Ridelab | None = None  # the service that has it; None for files and presets

    @property
    def strategies(self) -> list[str]:
        """The strategies of the stored result; none where there is only a scenario."""
        if self.run is not None:
            return list(self.run.strategies)
        return [] if self.batch is None else list(self.batch.answer["strategies"])


def find(target: str, services: Services) -> Target:
    """Look up a target."""
    if target == "-":
        return _document(sys.stdin.buffer.read(), "standard input", services)
    if target.startswith(("http://", "https://")):
        return _address(target, services)
    if Path(target).is_file():
        return _document(Path(target).read_bytes(), target, services)
    if _ID.fullmatch(target):
        ridelab = services.at()
        result = _first(target, "run, batch or link", ridelab.get_run, ridelab.get_batch, ridelab.open_link)
        return _target(result, ridelab)
    presets = services.names.presets
    if target in presets:
        return Target(name=target, scenario=presets[target])
    raise InputError(
        f"{without_login(target)}: neither a file, nor a preset ({', '.join(presets)}), nor an id, nor an address"
        f"{similar(target, presets)}"
    )


def job_of(job_id: str, services: Services) -> Job:
    """The batch or the tuning of an id."""
    ridelab = services.at()
    job: Job = _first(job_id, "batch or tuning", ridelab.get_batch, ridelab.get_tuning)
    return job


def parsed(text: str) -> Any:
    """Return what JSON says; a key that stands twice in an object is a mistake, and so is NaN.

    Raises:
        ValueError: It is none.
    """
    return json.loads(text, object_pairs_hook=_once, parse_constant=_no_number)


def document(content: bytes, name: str) -> Any:
    """Return the JSON of a file, refused by its name."""
    try:
        return parsed(content.decode())
    except UnicodeDecodeError:
        raise InputError(f"{name}: this is not valid UTF-8") from None
    except (ValueError, RecursionError) as error:
        raise InputError(f"{name}: this is not valid JSON: {error}") from None


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        raise ValueError(f"the same key twice, one of {', '.join(members)}")
    return members


def _no_number(text: str) -> float:
    raise ValueError(f"{text} is no number")


def _document(content: bytes, name: str, services: Services) -> Target:
    """A scenario, also as the page's library exports it, or a saved run."""
    value = document(content, name)
    if not isinstance(value, dict):
        raise InputError(f"{name}: this has to be a JSON object, a scenario or a saved run")
    if "strategies" not in value and isinstance(value.get("scenario"), dict):
        return Target(name=name, scenario=_of_library(value, name, services))
    if "strategies" not in value:
        return Target(name=name, scenario=_upgraded(value, 1) if _is_written_out(value) else value)
    try:
        run = RunResult.of({**value, "scenario": _upgraded(value["scenario"], 1)})
        complete = all(outcome.figures() for outcome in run if outcome.status == "ok")
        whole = isinstance(value["scenario"], dict) and complete
    except (KeyError, TypeError, AttributeError):
        whole = False
    if not whole:
        raise InputError(f"{name}: this is not a whole run as ridelab run --json prints it")
    return Target(name=name, scenario=run.scenario, run=run)


def _of_library(value: dict[str, Any], name: str, services: Services) -> dict[str, Any]:
    """The scenario of a library's file; the service gets its measured road."""
    scenario: dict[str, Any] = value["scenario"]
    version, road = value.get("schema_version", 1), value.get("measured_road")
    newest = services.quick.get("/schema")["schema_version"]
    if type(version) is not int or version < 1:
        raise InputError(f"{name}: schema_version has to be a whole number from 1 on")
    if version > newest:
        older = f"this service reads up to {newest}: update Ridelab"
        raise InputError(f"{name}: its schema version is {version}, and {older}")
    if isinstance(road, str):
        profile, part = services.at().upload_road(road.encode())["id"], scenario.get("road", {})
        if not isinstance(part, dict):
            raise InputError(f"{name}: road has to be a JSON object")
        scenario = {**scenario, "road": {**part, "profile": profile}}
    return _upgraded(scenario, version)


def _is_written_out(scenario: dict[str, Any]) -> bool:
    """Check whether a program wrote it, with every field there was: a person writes what differs from the paper."""
    estimation = scenario.get("estimation")
    return isinstance(estimation, dict) and estimation.keys() >= _FILTER


def _upgraded(scenario: dict[str, Any], version: int) -> dict[str, Any]:
    """A stored scenario as today's: the steps of sim_core/scenario/versions.py."""
    estimation = scenario.get("estimation", {})
    if version > 1 or not isinstance(estimation, dict):
        return scenario
    return {**scenario, "estimation": {"knows_preview": False, **estimation}}


def _address(address: str, services: Services) -> Target:
    wrong = InputError(f"{without_login(address)}: the address of a result ends with /r/ID or /s/ID")
    try:
        parts = urlsplit(address)
    except ValueError:  # brackets that do not match
        raise wrong from None
    before, _, rest = parts.path.rpartition("/")
    prefix, _, page = before.rpartition("/")
    if page not in _PAGES or not rest:
        raise wrong
    ridelab = services.at(f"{parts.scheme}://{parts.netloc}{prefix}")
    return _target(getattr(ridelab, _PAGES[page])(rest), ridelab)


def _target(result: RunResult | Batch | LinkedResult, ridelab: Ridelab) -> Target:
    if isinstance(result, LinkedResult):
        of: dict[str, Any] = {"run": result.run, "batch": result.batch, "slug": result.slug}
        return Target(name=f"link {result.slug}", scenario=result.scenario, ridelab=ridelab, **of)
    if isinstance(result, RunResult):
        return Target(name=f"run {result.id}", scenario=result.scenario, run=result, ridelab=ridelab)
    return Target(name=f"batch {result.id}", scenario=result.answer["scenario"], batch=result, ridelab=ridelab)


def _first(name: str, what: str, *lookups: Callable[[str], Any]) -> Any:
    """The answer of the first lookup that knows the id: ids of all kinds look alike."""
    for lookup in lookups:
        try:
            return lookup(name)
        except RidelabAPIError as error:
            if error.status != 404:
                raise
    raise InputError(f"{without_login(name)}: the service has no {what} of this id")
