"""Gets each strategy's result from memory, the store, an equal computation in progress, or a worker."""

import asyncio
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from backend import digest
from backend.compute.flights import Flights
from backend.compute.workers import Workers
from backend.cost.estimate import estimate
from backend.http.admission import Admission
from backend.metrics import CACHE, count_runs
from backend.roads.service import Roads
from backend.runs import work
from backend.runs.memory import Memory
from backend.runs.work import ComputedResult
from backend.store import Store, StoredResult
from sim_core.scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """A strategy's result, and whether it was stored (or being computed) before this request."""

    outcome: ComputedResult
    cached: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class _Request:
    """Who asks, for how many samples of the time histories (None for none), and each strategy's estimated cost [s]."""

    client: str
    points: int | None
    costs: Mapping[str, float]


class Results:
    """Finds or computes results; its methods belong to the event loop."""

    def __init__(self, *, store: Store, workers: Workers, memory: Memory, admission: Admission, roads: Roads) -> None:
        self._store = store
        self._workers = workers
        self._memory = memory
        self._admission = admission
        self._roads = roads
        self._flights: Flights[tuple[str, int | None], dict[str, ComputedResult]] = Flights()

    async def get(
        self, scenario: Scenario, names: Sequence[str], client: str, *, points: int | None
    ) -> dict[str, Result]:
        """Each strategy's result, with about `points` samples of its time histories or (None) without them.

        Without them the store may have it; with them only memory or a worker.
        """
        (results,) = await self.on_roads([scenario], names, client, points=points)
        return results

    async def on_roads(
        self, roads: Sequence[Scenario], names: Sequence[str], client: str, *, points: int | None
    ) -> list[dict[str, Result]]:
        """Each strategy's result on each of several roads, which differ in their seed alone; idle workers share them.

        Raises:
            InvalidError: What is missing would be driven on a measured road that is not there, or too short.
            TemporaryError: Too much is being computed.
        """
        keys = [{name: digest.result_key(road, name) for name in names} for road in roads]
        stored: Mapping[str, StoredResult] = {}
        if points is None:
            unknown = [key for each in keys for key in each.values() if self._memory.get(key, None) is None]
            stored = await self._store.read(self._store.runs.load_results, unknown) if unknown else {}
        results = [self._cached(each, stored, points) for each in keys]
        missing = [
            {name: key for name, key in each.items() if name not in cached}
            for each, cached in zip(keys, results, strict=True)
        ]
        costly = [name for each in missing for name in each]
        CACHE.labels("hit").inc(sum(map(len, results)))
        CACHE.labels("miss").inc(len(costly))
        if costly:
            roads = [await self._roads.on(road) for road in roads]
            costs = {name: estimate(roads[0], name) for name in set(costly)}  # which no seed changes
            request = _Request(client=client, points=points, costs=costs)
            with self._admission.computing(client, sum(costs[name] for name in costly)):
                computed = await self._compute_roads(roads, missing, request)
            results = [cached | new for cached, new in zip(results, computed, strict=True)]
        return [{name: each[name] for name in names} for each in results]

    def _cached(
        self, keys: Mapping[str, str], stored: Mapping[str, StoredResult], points: int | None
    ) -> dict[str, Result]:
        """The results of one road that are cached or stored."""
        outcomes = {
            name: _outcome(stored[key]) if key in stored else self._memory.get(key, points)
            for name, key in keys.items()
        }
        return {name: Result(outcome=each, cached=True) for name, each in outcomes.items() if each is not None}

    async def _compute_roads(
        self, roads: Sequence[Scenario], missing: Sequence[Mapping[str, str]], request: _Request
    ) -> list[dict[str, Result]]:
        """At most as many roads at once as there are workers, so that the client's other requests come in between."""
        slots = asyncio.Semaphore(self._workers.count)

        async def one(road: Scenario, keys: Mapping[str, str]) -> dict[str, Result]:
            async with slots:
                cached = self._cached(keys, {}, request.points)  # by now another request may have computed it
                rest = {name: key for name, key in keys.items() if name not in cached}
                return cached | (await self._compute(road, rest, request) if rest else {})

        tasks = [asyncio.create_task(one(road, names)) for road, names in zip(roads, missing, strict=True)]
        try:
            return await asyncio.gather(*tasks)
        finally:
            for task in tasks:
                task.cancel()

    async def _compute(self, scenario: Scenario, missing: Mapping[str, str], request: _Request) -> dict[str, Result]:
        """Join computations in progress; one worker computes the rest, so that shared work is done once."""
        points = request.points

        def running_task(key: str) -> asyncio.Task[dict[str, ComputedResult]] | None:
            return self._flights.find(lambda flight: flight[0] == key and points in (None, flight[1]))

        tasks = {name: task for name, key in missing.items() if (task := running_task(key))}
        joined = set(tasks)
        fresh = {name: key for name, key in missing.items() if name not in joined}
        if fresh:
            computing = self._fly(scenario, fresh, request)
            tasks |= dict.fromkeys(fresh, self._flights.begin([(key, points) for key in fresh.values()], computing))
        landed = await self._flights.wait(set(tasks.values()))
        return {name: Result(outcome=landed[task][name], cached=name in joined) for name, task in tasks.items()}

    async def _fly(self, scenario: Scenario, fresh: Mapping[str, str], request: _Request) -> dict[str, ComputedResult]:
        cost = sum(request.costs[name] for name in fresh)
        outcomes = await self._workers.call(
            work.run, scenario, list(fresh), request.points, client=request.client, cost=cost
        )
        for outcome in outcomes.values():
            fallbacks = outcome.summary.get("events", {}).get("qp_fallbacks", 0)
            count_runs("interactive", outcome.status, fallbacks=fallbacks)
        for name, key in fresh.items():  # those without series too: until they are committed nothing else has them
            if outcomes[name].cacheable:
                self._memory.put(key, outcomes[name])
        return outcomes


def _outcome(item: StoredResult) -> ComputedResult:
    return ComputedResult(status=item.status, summary=item.summary, compute_ms=item.compute_ms)
