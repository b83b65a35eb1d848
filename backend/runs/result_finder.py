"""Gets each strategy's result from memory, the store, an equal computation in progress, or a worker."""

import asyncio
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from backend import digest
from backend.compute.shared_computations import SharedComputations
from backend.compute.workers import Workers
from backend.cost.estimate import costs_of
from backend.gate import Gate
from backend.metrics import CACHE, count_runs
from backend.outcome import Outcome, Sampling
from backend.recordings.service import Recordings
from backend.roads.service import MeasuredRoads
from backend.runs.compute_run import compute_run
from backend.runs.result_cache import ResultCache
from backend.store import Store
from sim_core.scenario import Scenario
from sim_core.strategies import STRATEGIES, resolve_speed_plan

Outcomes = dict[str, Outcome]  # by strategy


@dataclass(frozen=True, slots=True, kw_only=True)
class _Request:
    """Who asks, for which samples of the time histories (None for none), each strategy's estimated cost [s], roads."""

    client: str
    sampling: Sampling | None
    costs: Mapping[str, float]
    roads: int


@dataclass(eq=False, kw_only=True)
class ResultFinder:
    """Finds or computes results."""

    store: Store
    workers: Workers
    memory: ResultCache
    gate: Gate
    roads: MeasuredRoads
    recordings: Recordings
    _in_progress: SharedComputations[tuple[str, Sampling | None], Outcomes] = field(
        init=False, default_factory=SharedComputations
    )

    async def get(
        self,
        scenario: Scenario,
        names: Sequence[str],
        client: str,
        *,
        sampling: Sampling | None,
        costs: Mapping[str, float] | None = None,
    ) -> Outcomes:
        """Each strategy's result, with those samples of its time histories or (None) without them.

        Without them the store may have it; with them only memory or a worker. `costs` are as for `on_roads`.
        """
        (outcomes,) = await self.on_roads([scenario], names, client, sampling=sampling, costs=costs)
        return outcomes

    async def on_roads(
        self,
        roads: Sequence[Scenario],
        names: Sequence[str],
        client: str,
        *,
        sampling: Sampling | None,
        costs: Mapping[str, float] | None = None,
    ) -> list[Outcomes]:
        """Each strategy's result on each of several roads, which differ in their seed alone; idle workers share them.

        `costs` has each strategy's `estimate` on one of them, where that was made already.

        Raises:
            InvalidError: What is missing would be driven on a measured road that is not there, or too short, or is a
                recording that is not there.
            TemporaryError: Too much is being computed.
        """
        keys = digest.result_keys(roads, names)
        stored: Outcomes = {}
        if sampling is None:
            unknown = [key for each in keys for key in each.values() if self.memory.get(key, None) is None]
            stored = await self.store.read(self.store.runs.load_results, unknown) if unknown else {}
        available = [self._found(each, stored, sampling) for each in keys]
        missing = [
            {name: key for name, key in each.items() if name not in there}
            for each, there in zip(keys, available, strict=True)
        ]
        costly = [name for each in missing for name in each]
        CACHE.labels("hit").inc(sum(map(len, available)))
        CACHE.labels("miss").inc(len(costly))
        if costly:
            roads = [await self.recordings.on(await self.roads.on(road), costly) for road in roads]
            costs = costs or costs_of(roads[0], set(costly))  # which no seed changes
            request = _Request(client=client, sampling=sampling, costs=costs, roads=len(roads))
            with self.gate.computing(client, sum(costs[name] for name in costly)):
                computed = await self._compute_roads(roads, missing, request)
            available = [there | new for there, new in zip(available, computed, strict=True)]
        return [{name: each[name] for name in names} for each in available]

    def _found(self, keys: Mapping[str, str], stored: Outcomes, sampling: Sampling | None) -> Outcomes:
        """The results of one road that are in memory or (by key) stored."""
        outcomes = {name: stored.get(key) or self.memory.get(key, sampling) for name, key in keys.items()}
        return {name: outcome for name, outcome in outcomes.items() if outcome is not None}

    async def _compute_roads(
        self, roads: Sequence[Scenario], missing: Sequence[Mapping[str, str]], request: _Request
    ) -> list[Outcomes]:
        """At most as many roads at once as there are workers, so that the client's other requests come in between."""
        slots = asyncio.Semaphore(self.workers.count)

        async def one(road: Scenario, keys: Mapping[str, str]) -> Outcomes:
            async with slots:
                available = self._found(keys, {}, request.sampling)  # by now another request may have computed it
                rest = {name: key for name, key in keys.items() if name not in available}
                return available | (await self._compute(road, rest, request) if rest else {})

        tasks = [asyncio.create_task(one(road, names)) for road, names in zip(roads, missing, strict=True)]
        try:
            return await asyncio.gather(*tasks)
        finally:
            for task in tasks:
                task.cancel()

    async def _compute(self, scenario: Scenario, missing: Mapping[str, str], request: _Request) -> Outcomes:
        """Join computations in progress; of the rest a worker computes those that share work, beside the others."""
        sampling = request.sampling

        def running_task(key: str) -> asyncio.Task[Outcomes] | None:
            return self._in_progress.find(lambda other: other[0] == key and sampling in (None, other[1]))

        tasks = {name: task for name, key in missing.items() if (task := running_task(key))}
        joined = set(tasks)
        fresh = {name: key for name, key in missing.items() if name not in joined}
        by_work: dict[tuple[str, ...], dict[str, str]] = {}
        for name, key in fresh.items():
            by_work.setdefault(shared_work(name, scenario, request.roads), {})[name] = key
        for each in by_work.values():
            computing = self._compute_fresh(scenario, each, request)
            tasks |= dict.fromkeys(each, self._in_progress.begin([(key, sampling) for key in each.values()], computing))
        outcomes = await self._in_progress.wait(set(tasks.values()))
        return {name: replace(outcomes[task][name], cached=name in joined) for name, task in tasks.items()}

    async def _compute_fresh(self, scenario: Scenario, fresh: Mapping[str, str], request: _Request) -> Outcomes:
        cost = sum(request.costs[name] for name in fresh)
        outcomes = await self.workers.call(
            compute_run, scenario, fresh, request.sampling, client=request.client, cost=cost
        )
        for outcome in outcomes.values():  # those without series too: until they are committed nothing else has them
            count_runs("interactive", outcome.status, fallbacks=outcome.fallbacks)
            if outcome.cacheable:
                self.memory.put(outcome.key, replace(outcome, cached=True))
        return outcomes


def shared_work(name: str, scenario: Scenario, roads: int) -> tuple[str, ...]:
    """Alike for strategies that one worker computes: ours of one speed plan, and over several roads all of ours.

    Somebody's own law may take a worker's whole time: it has one to itself, whatever it is called.
    """
    ours = STRATEGIES.get(name)
    if ours is None:
        return "own", name
    return (resolve_speed_plan(ours, scenario.speed.policy),) if roads == 1 else ()
