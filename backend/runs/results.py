"""Gets each strategy's result from memory, the store, an equal computation in progress, or a worker."""

import asyncio
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from cachetools import LRUCache

from backend import digest
from backend.compute.workers import Workers
from backend.cost.estimate import estimate
from backend.gate import Gate
from backend.json_types import JsonObject
from backend.metrics import CACHE, RUNS, SOLVER_FALLBACKS
from backend.outcome import Outcome, Sampling
from backend.recordings.service import Recordings
from backend.roads.service import MeasuredRoads
from backend.runs.compute_run import compute_run
from backend.store import Store
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import STRATEGIES, resolve_speed_plan

Outcomes = dict[str, Outcome]  # by strategy, or by result key


@dataclass(frozen=True, slots=True, kw_only=True)
class _Request:
    """The client, the samples that it asks for (None: none), and each strategy's cost [s of one core]."""

    client: str
    sampling: Sampling | None
    costs: Mapping[str, float]


@dataclass(eq=False, slots=True)
class _Computation:
    """A computation in progress, and how many requests wait for it: the last one that goes away calls it off."""

    task: asyncio.Task[Outcomes]
    waiting: int = 0


@dataclass(eq=False, kw_only=True)
class Results:
    """Finds or computes results.

    Attributes:
        memory: The latest results by key, with their time histories; bounded in bytes.
    """

    store: Store
    workers: Workers
    gate: Gate
    roads: MeasuredRoads
    recordings: Recordings
    memory: LRUCache[str, Outcome]
    _in_progress: dict[tuple[str, Sampling | None], _Computation] = field(init=False, default_factory=dict)

    async def get(
        self,
        roads: Sequence[Scenario],
        names: Sequence[str],
        client: str,
        *,
        sampling: Sampling | None = None,
        costs: Mapping[str, float] | None = None,
        identity: JsonObject | None = None,
    ) -> list[Outcomes]:
        """Return each strategy's result on each of several roads, which idle workers share.

        Args:
            roads: What to drive; they differ in their seed alone.
            names: The strategies.
            client: Who asks.
            sampling: Which samples of the time histories to return, which no store has; None is none of them.
            costs: By strategy its `estimate` on one road, where that was made already.
            identity: The first road's, as for `digest.result_keys`.

        Raises:
            InvalidError: What is missing would be driven on a measured road that is not there, or too short, or is a
                recording that is not there.
            TemporaryError: Too much is being computed.
        """
        by_road = digest.result_keys(roads, names, identity)
        keys = [key for each in by_road for key in each.values()]
        found = {key: outcome for key in keys if (outcome := self.cached(key, sampling)) is not None}
        if sampling is None and len(found) < len(keys):
            found |= await self.store.read(self.store.runs.load_results, [key for key in keys if key not in found])
        missing = [{name: key for name, key in each.items() if key not in found} for each in by_road]
        CACHE.labels("hit").inc(len(found))
        CACHE.labels("miss").inc(len(keys) - len(found))
        if len(found) < len(keys):
            found |= await self._compute(roads, missing, client, sampling, costs)
        return [{name: found[key] for name, key in each.items()} for each in by_road]

    def cached(self, key: str, sampling: Sampling | None) -> Outcome | None:
        """Return the result in memory where its time histories have those samples; None is any, or none."""
        outcome = self.memory.get(key)
        return outcome if outcome is not None and sampling in (None, outcome.sampling) else None

    def remember(self, outcome: Outcome) -> None:
        """Have a result in memory, unless one of its key is there that alone has time histories, or it is too large."""
        if outcome.sampling is None and outcome.key in self.memory:
            return
        self.memory.pop(outcome.key, None)
        if outcome.size <= self.memory.maxsize:
            self.memory[outcome.key] = replace(outcome, cached=True)

    async def _compute(
        self,
        roads: Sequence[Scenario],
        missing: Sequence[Mapping[str, str]],
        client: str,
        sampling: Sampling | None,
        costs: Mapping[str, float] | None,
    ) -> Outcomes:
        """Return the missing results by key; no more tasks at once than workers, so that others come in between."""
        names = [name for each in missing for name in each]
        costs = costs or {name: estimate(roads[0], name) for name in set(names)}  # which no seed changes
        if roads[0].road.profile is not None or any(map(recording_id, names)):
            roads = [await self.recordings.on(await self.roads.on(road), names) for road in roads]
        request = _Request(client=client, sampling=sampling, costs=costs)
        places = asyncio.Semaphore(self.workers.count)
        with self.gate.computing(client, sum(costs[name] for name in names)):
            tasks = [
                asyncio.create_task(self._joined(road, keys, request, places))
                for road, of_road in zip(roads, missing, strict=True)
                for keys in together(of_road, road, len(roads))
            ]
            try:
                return {key: each for outcomes in await asyncio.gather(*tasks) for key, each in outcomes.items()}
            finally:
                for task in tasks:
                    task.cancel()

    async def _joined(
        self, road: Scenario, keys: Mapping[str, str], request: _Request, places: asyncio.Semaphore
    ) -> Outcomes:
        """Return these results by key, from equal computations in progress, and of the rest from one of its own."""
        sampling = request.sampling
        async with places:
            found, joined, rest = Outcomes(), dict[str, _Computation](), dict[str, str]()
            for name, key in keys.items():
                equal = [
                    each
                    for (other, samples), each in self._in_progress.items()
                    if other == key and sampling in (None, samples) and not each.task.cancelling()
                ]
                if (outcome := self.cached(key, sampling)) is not None:
                    found[key] = outcome  # another request has computed it meanwhile
                elif equal:
                    joined[key] = equal[0]
                else:
                    rest[name] = key
            waited = set(joined.values())
            if rest:
                own = _Computation(asyncio.create_task(self._computed(road, rest, request)))
                self._in_progress |= {(key, sampling): own for key in rest.values()}
                waited.add(own)
            for each in waited:
                each.waiting += 1
            try:
                outcomes = [await asyncio.shield(each.task) for each in waited]
            finally:
                for each in waited:
                    each.waiting -= 1
                    if not each.waiting:
                        each.task.cancel()
        computed = {key: outcome for each in outcomes for key, outcome in each.items()}
        found |= {key: computed[key] for key in rest.values()}
        return found | {key: replace(computed[key], cached=True) for key in joined}

    async def _computed(self, road: Scenario, keys: Mapping[str, str], request: _Request) -> Outcomes:
        """Have a worker compute these results, for every request that wants one of them until they are there."""
        sampling, cost = request.sampling, sum(request.costs[name] for name in keys)
        try:
            outcomes = await self.workers.call(compute_run, road, keys, sampling, client=request.client, cost=cost)
        finally:
            for key in keys.values():
                if self._in_progress[key, sampling].task is asyncio.current_task():
                    del self._in_progress[key, sampling]
        for outcome in outcomes.values():  # those without series too: until they are committed nothing else has them
            RUNS.labels("interactive", outcome.status).inc()
            SOLVER_FALLBACKS.inc(outcome.fallbacks)
            if outcome.cacheable:
                self.remember(outcome)
        return {outcome.key: outcome for outcome in outcomes.values()}


def together(keys: Mapping[str, str], scenario: Scenario, roads: int) -> list[dict[str, str]]:
    """Split strategies, with their results' keys, into those that one worker drives one after the other.

    Ours of one speed plan, which share work; of several roads all of ours. A custom controller may take a worker's
    whole time: it has one to itself.
    """
    by_work: dict[str, dict[str, str]] = {}
    for name, key in keys.items():
        ours = STRATEGIES.get(name)
        work = f"{name} alone" if ours is None else resolve_speed_plan(ours, scenario.speed.policy) * (roads == 1)
        by_work.setdefault(work, {})[name] = key
    return list(by_work.values())
