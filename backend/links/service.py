"""Share links: an unguessable slug that opens a run or a batch as it was computed, in the view it was shared in."""

import asyncio
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from backend import digest
from backend.batches.kind import SWEEP
from backend.batches.models import Batch
from backend.compute.workers import Workers
from backend.cost.estimate import estimate
from backend.errors import InvalidError, NotFoundError
from backend.gate import PIN_WEIGHT, Gate
from backend.json_types import JsonObject
from backend.links import preview
from backend.links.models import SLUG_PATTERN, LinkRequest, LinkView
from backend.links.preview import Preview
from backend.recordings.service import Recordings
from backend.requirements import Requirement
from backend.roads.service import MeasuredRoads
from backend.runs import pins
from backend.runs.answers import as_plain, run_answer
from backend.runs.histories import changed_controllers
from backend.runs.service import Runs, upgraded_scenario
from backend.store import Store, StoredJob, StoredLink, StoredRun
from backend.unknown_names import unknown_name
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import STRATEGIES, strategies

_REQUIREMENTS = "requirements"  # their place in a stored view


@dataclass(frozen=True, slots=True, kw_only=True)
class _SharedRun:
    """A run to be kept by a link, and by strategy the result keys of the time histories to pin."""

    stored: StoredRun
    missing: Mapping[str, str]


@dataclass(eq=False, kw_only=True)
class Links:
    """The one service of links."""

    store: Store
    workers: Workers
    runs: Runs
    gate: Gate
    roads: MeasuredRoads
    recordings: Recordings

    async def create(self, request: LinkRequest, client: str, owner: str | None) -> tuple[str, bool]:
        """Make a link to a run or a batch; return its slug, and whether it stores time histories too.

        Each run that the view compares a run with gets a link of its own, which keeps it in the same way.

        Raises:
            InvalidError: There is no such run or batch, or no such field or strategy of it.
            TemporaryError: Too many new links, or too much is being computed.
        """
        slug, view = digest.random_id(), request.view.model_dump(mode="json", exclude_unset=True)
        if request.requirements:
            view[_REQUIREMENTS] = [each.model_dump(mode="json", exclude_none=True) for each in request.requirements]
        if request.run_id is None:
            link = StoredLink(slug=slug, kind="batch", target=str(request.batch_id), view=view, owner=owner)
            await self._share_batch(link, request.view, client)
            return slug, False
        places = {"run_id": request.run_id} | {
            f"view/pins/{number}/run": pin.run for number, pin in enumerate(request.view.pins or [])
        }
        shared = [await self._shared(run_id, place, client) for place, run_id in places.items()]
        _check_names(request.view, {name for each in shared for name in each.stored.by_strategy})
        missing = {key for each in shared for key in each.missing.values()}
        self.gate.links.take(client, len(shared) + PIN_WEIGHT * len(missing))
        series = [await self._pin(each, client) for each in shared]
        link = StoredLink(slug=slug, kind="run", target=request.run_id, view=view, owner=owner)
        for each, pinned in zip(shared[1:], series[1:], strict=True):
            beside = replace(link, slug=digest.random_id(), target=each.stored.id, view={}, pin_of=slug)
            await self._save_run(beside, each.stored, pinned, client)
        await self._save_run(link, shared[0].stored, series[0], client)
        return slug, bool(shared[0].stored.shown) and set(shared[0].missing.values()) <= series[0].keys()

    async def page(self, owner: str | None, limit: int, cursor: str | None) -> tuple[list[JsonObject], str | None]:
        """Return the newest links, of an owner or (None) of all, and the cursor of the next page."""
        rows, following = await self.store.read(self.store.links.page, owner, limit, cursor)
        return [{**row._mapping, "batch_id": row.job_id} for row in rows], following

    async def revoke(self, slug: str, owner: str | None) -> None:
        """Take a link back; see `LinkStore.revoke`."""
        await self.store.write(self.store.links.revoke, slug, owner)

    async def _shared(self, run_id: str, place: str, client: str) -> _SharedRun:
        """Return the run, and which of its time histories no link has pinned yet."""
        try:
            stored = await self.runs.stored(run_id, client)
        except NotFoundError:
            raise _unknown(place, "There is no run of this id") from None
        keys = {item.strategy: item.key for item in stored.shown}
        if not keys.keys() <= STRATEGIES.keys():
            keys = {name: keys[name] for name in keys.keys() - changed_controllers(stored)}
        present = await self.store.read(self.store.links.pinned, keys.values())
        return _SharedRun(stored=stored, missing={name: key for name, key in keys.items() if key not in present})

    async def _share_batch(self, link: StoredLink, view: LinkView, client: str) -> None:
        stored = await self.store.read(self.store.jobs.load, link.target)
        if stored is None or stored.kind != SWEEP.name:
            raise _unknown("batch_id", "There is no batch of this id")
        if view.x not in (None, *stored.request["fields"]):
            raise _unknown("view/x", f"This batch sweeps {', '.join(stored.request['fields'])}")
        _check_names(view, stored.request["strategies"])
        self.gate.links.take(client)
        if not await self.store.write(self.store.links.save, link, {}):
            raise _unknown("batch_id", "There is no batch of this id")

    async def get(self, slug: str, client: str) -> JsonObject:
        """Return the answer about a link, of the shape of `Link` but for its `url`.

        Raises:
            NotFoundError: There is none.
            RevokedError: It was taken back.
            RoadGoneError, TemporaryError: Its run has to be computed again, see `Runs.stored`.
        """
        link = await self._load(slug)
        if link.kind == "batch":
            job = await self._job(link)
            return _opened(link, job, job.request["scenario"], batch=_batch(job).model_dump())
        stored = await self._run(link)
        if stored.expired:
            again = await self.runs.stored(stored.id, client)
            stored = replace(again, schema_version=stored.schema_version)
            link = await self._load(slug)  # now it knows that something was damaged
        # Not of a strategy that failed when it was shared, and that another core version has computed since.
        shared = [item for item in stored.shown if item.core_version in (None, stored.core_version)]
        keys = {item.key for item in shared}
        pinned = await self.store.read(self.store.links.pinned, keys)
        return _opened(
            link,
            stored,
            stored.scenario,
            series_pinned=bool(keys) and keys <= pinned,
            run=await asyncio.to_thread(_judged_run, stored, link),
        )

    async def preview(self, slug: str) -> Preview:
        """Return the link's preview in a chat program.

        Raises:
            NotFoundError: There is none.
            RevokedError: It was taken back.
        """
        link = await self._load(slug)
        if link.kind == "batch":
            batch = await self._job(link)
            return preview.of_batch(_batch(batch).model_dump(), batch.finished_at or batch.created_at)
        run = await self._run(link)
        if run.expired:  # its numbers are computed for whoever opens the link, not for a preview
            answer = {"core_version": run.core_version, "scenario": run.scenario, "strategies": {}}
        else:
            answer = await asyncio.to_thread(lambda: as_plain(run_answer(run)))
        return preview.of_run(answer, link.view, run.created_at)

    async def _pin(self, shared: _SharedRun, client: str) -> dict[str, bytes]:
        """By result key the time histories to pin; empty where another core version computed them, or they are long."""
        stored, missing = shared.stored, shared.missing
        if not missing or stored.core_version != CORE_VERSION:
            return {}
        scenario = Scenario.model_validate(stored.scenario)
        if scenario.road.profile is not None or any(map(recording_id, missing)):
            scenario = await self.recordings.on(await self.roads.on(scenario), missing)
        cost = sum(estimate(scenario, name) for name in missing)
        with self.gate.computing(client, cost):
            series = await self.workers.call(pins.make, scenario, list(missing), client=client, cost=cost)
        return {missing[name]: content for name, content in series.items()}

    async def _save_run(self, link: StoredLink, run: StoredRun, series: Mapping[str, bytes], client: str) -> None:
        """Save a link to a run; results that were removed since the run was read are computed again first."""
        while not await self.store.write(self.store.links.save, link, series, run.failed_now):
            run = await self.runs.stored(run.id, client)

    async def _load(self, slug: str) -> StoredLink:
        link = await self.store.read(self.store.links.load, slug) if re.fullmatch(SLUG_PATTERN, slug) else None
        if link is None:
            raise NotFoundError("There is no link of this slug.")
        return link

    async def _run(self, link: StoredLink) -> StoredRun:
        stored = await self.runs.load(link.target)
        if stored is None:
            raise RuntimeError("A link's run is not there, though nothing removes runs")
        return stored

    async def _job(self, link: StoredLink) -> StoredJob:
        stored = await self.store.read(self.store.jobs.load, link.target)
        if stored is None:
            raise RuntimeError("A link's batch is not there, though nothing removes it")
        scenario = upgraded_scenario(stored.request["scenario"], stored.schema_version)
        return replace(stored, request={**stored.request, "scenario": scenario})


def _batch(job: StoredJob) -> Batch:
    """Return a batch whose scenario is today's already."""
    return Batch.from_stored(replace(job, schema_version=SCHEMA_VERSION), 0, resumable=False)


def _check_names(view: LinkView, stored: Iterable[str]) -> None:
    """Refuse a strategy that the result does not have and that there is not now either."""
    named = {"baseline": view.baseline, "strategy": view.strategy, "against": view.against}
    if view.instant is not None:
        named["instant/strategy"] = view.instant.strategy
    for part, names in (("strategies", view.strategies), ("hidden", view.hidden)):
        named |= {f"{part}/{number}": name for number, name in enumerate(names or ())}
    allowed = list(dict.fromkeys([*strategies(), *sorted(stored)]))
    for place, name in named.items():
        if name is not None and name not in ("none", *allowed):
            raise _unknown(f"view/{place}", unknown_name("strategy", name, allowed))


def _judged_run(stored: StoredRun, link: StoredLink) -> JsonObject:
    """Return the answer about a link's run: what its view shows is compared, and held to the link's requirements."""
    requirements = [Requirement.model_validate(each) for each in link.view.get(_REQUIREMENTS, [])]
    shown = link.view.get("strategies") or list(stored.by_strategy)
    return run_answer(
        stored,
        requirements=requirements,
        baseline=link.view.get("baseline"),
        compared=set(shown) - set(link.view.get("hidden") or ()),
    )


def _opened(link: StoredLink, shown: StoredRun | StoredJob, scenario: JsonObject, **content: Any) -> JsonObject:
    finished_at = shown.finished_at if isinstance(shown, StoredJob) else None
    return {
        "slug": link.slug,
        "created_at": link.created_at,
        "kind": link.kind,
        "core_version": shown.core_version,
        "computed_at": finished_at or shown.created_at,
        "current_core_version": CORE_VERSION,
        "schema_version": shown.schema_version,
        "scenario": scenario,
        # As it was sent, perhaps with names of an older version.
        "view": {name: value for name, value in link.view.items() if name != _REQUIREMENTS},
        "run": None,
        "batch": None,
        "series_pinned": False,
        "damaged_at": link.damaged_at,
        **({_REQUIREMENTS: link.view[_REQUIREMENTS]} if _REQUIREMENTS in link.view else {}),
        **content,
    }


def _unknown(field: str, message: str) -> InvalidError:
    return InvalidError(f"{message}.", kind="unknown", pointer=f"/{field}")
