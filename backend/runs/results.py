"""Where one strategy's result comes from: memory, the store, an equal computation under way, or a worker."""

import asyncio
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from backend import digest
from backend.compute.workers import Workers
from backend.http.admission import Admission
from backend.metrics import CACHE, count_run
from backend.runs import work
from backend.runs.memory import Memory
from backend.runs.work import Outcome
from backend.store import Store, StoredResult
from sim_core.scenario import Scenario

Flight = asyncio.Task[dict[str, Outcome]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """A strategy's result and whether it was there (or on its way) before it was asked for."""

    outcome: Outcome
    cached: bool


class Results:
    """Finds or computes results; its methods belong to the event loop."""

    def __init__(self, *, store: Store, workers: Workers, memory: Memory, admission: Admission) -> None:
        self._store = store
        self._workers = workers
        self._memory = memory
        self._admission = admission
        self._flights: dict[tuple[str, int | None], Flight] = {}
        self._waiting: Counter[Flight] = Counter()

    async def get(
        self, scenario: Scenario, names: Sequence[str], client: str, *, points: int | None
    ) -> dict[str, Found]:
        """Each strategy's result, with about `points` samples of its time histories or (None) without them.

        Without them the store may have it; with them only memory or a worker.
        """
        (found,) = await self.on_roads([scenario], names, client, points=points)
        return found

    async def on_roads(
        self, roads: Sequence[Scenario], names: Sequence[str], client: str, *, points: int | None
    ) -> list[dict[str, Found]]:
        """The same on each of several roads, which differ in their seed alone; idle workers share them."""
        keys = [{name: digest.result_key(road, name) for name in names} for road in roads]
        kept: Mapping[str, StoredResult] = {}
        if points is None:
            unknown = [key for each in keys for key in each.values() if self._memory.get(key, None) is None]
            kept = await self._store.read(self._store.runs.load_results, unknown) if unknown else {}
        found = [self._known(each, kept, points) for each in keys]
        missing = [
            {name: key for name, key in each.items() if name not in known}
            for each, known in zip(keys, found, strict=True)
        ]
        costly = [name for each in missing for name in each]
        CACHE.labels("hit").inc(sum(map(len, found)))
        CACHE.labels("miss").inc(len(costly))
        if costly:
            with self._admission.computing(client, roads[0], costly):
                made = await self._compute_roads(roads, missing, points)
            found = [known | new for known, new in zip(found, made, strict=True)]
        return [{name: each[name] for name in names} for each in found]

    def _known(self, keys: Mapping[str, str], kept: Mapping[str, StoredResult], points: int | None) -> dict[str, Found]:
        """What of one road the store has, or memory."""
        found = {name: _from_store(kept[key]) for name, key in keys.items() if key in kept}
        for name, key in keys.items():
            remembered = self._memory.get(key, points)
            if remembered is not None and name not in found:
                found[name] = Found(outcome=remembered, cached=True)
        return found

    async def _compute_roads(
        self, roads: Sequence[Scenario], missing: Sequence[Mapping[str, str]], points: int | None
    ) -> list[dict[str, Found]]:
        """At most as many roads at once as there are workers, so that other requests come in between."""
        places = asyncio.Semaphore(self._workers.count)

        async def one(road: Scenario, keys: Mapping[str, str]) -> dict[str, Found]:
            async with places:
                known = self._known(keys, {}, points)  # by now another request may have computed it
                rest = {name: key for name, key in keys.items() if name not in known}
                return known | (await self._compute(road, rest, points) if rest else {})

        tasks = [asyncio.create_task(one(road, names)) for road, names in zip(roads, missing, strict=True)]
        try:
            return await asyncio.gather(*tasks)
        finally:
            for task in tasks:
                task.cancel()

    async def _compute(self, scenario: Scenario, missing: Mapping[str, str], points: int | None) -> dict[str, Found]:
        """Join what is under way already; the rest goes to one worker, so that shared work is done once."""
        flights = {name: flight for name, key in missing.items() if (flight := self._flight(key, points))}
        joined = set(flights)
        fresh = {name: key for name, key in missing.items() if name not in joined}
        if fresh:
            task = asyncio.create_task(self._fly(scenario, fresh, points))
            self._flights |= {(key, points): task for key in fresh.values()}
            flights |= dict.fromkeys(fresh, task)
        waiting = set(flights.values())
        self._waiting.update(waiting)
        try:
            landed = {task: await asyncio.shield(task) for task in waiting}
        finally:
            self._leave(waiting)
        return {name: Found(outcome=landed[task][name], cached=name in joined) for name, task in flights.items()}

    def _flight(self, key: str, points: int | None) -> Flight | None:
        """The computation under way that will have it."""
        if points is not None:
            return self._flights.get((key, points))
        return next((flight for (result, _), flight in self._flights.items() if result == key), None)

    async def _fly(self, scenario: Scenario, fresh: Mapping[str, str], points: int | None) -> dict[str, Outcome]:
        this = asyncio.current_task()
        try:
            outcomes = await self._workers.call(work.run, scenario, list(fresh), points)
            for outcome in outcomes.values():
                count_run("interactive", outcome.status, outcome.summary)
            for name, key in fresh.items():  # those without series too: until they are committed nothing else has them
                if outcomes[name].lasting:
                    self._memory.put(key, outcomes[name])
            return outcomes
        finally:
            self._flights = {key: flight for key, flight in self._flights.items() if flight is not this}

    def _leave(self, flights: Iterable[Flight]) -> None:
        """One request less waits for these; a flight nobody waits for any more is called off."""
        for task in flights:
            self._waiting[task] -= 1
            if self._waiting[task]:
                continue
            del self._waiting[task]
            if not task.done():
                self._flights = {key: flight for key, flight in self._flights.items() if flight is not task}
                task.cancel()


def _from_store(item: StoredResult) -> Found:
    outcome = Outcome(status=item.status, summary=item.summary, compute_ms=item.compute_ms)
    return Found(outcome=outcome, cached=True)
