"""Where one strategy's result comes from: memory, the store, an equal computation under way, or a worker."""

import asyncio
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from backend import digest, worker
from backend.admission import Admission
from backend.compute import Workers
from backend.memory import Memory
from backend.store import Store, StoredResult
from backend.worker import Outcome
from sim_core.scenario import Scenario


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
        self._flights: dict[str, asyncio.Task[dict[str, Outcome]]] = {}
        self._waiting: Counter[asyncio.Task[dict[str, Outcome]]] = Counter()

    async def get(
        self, scenario: Scenario, names: Sequence[str], client: str, *, with_series: bool
    ) -> dict[str, Found]:
        """Each strategy's result: from memory, from the store (unless its series are wanted), or computed."""
        keys = {name: digest.result_key(scenario, name) for name in names}
        found: dict[str, Found] = {}
        if not with_series:
            unknown = [key for key in keys.values() if self._memory.get(key) is None]
            kept = await self._store.call(self._store.load_results, unknown) if unknown else {}
            found = {
                name: Found(outcome=_from_store(kept[key]), cached=True) for name, key in keys.items() if key in kept
            }
        for name, key in keys.items():
            remembered = self._memory.get(key)
            if remembered is not None and name not in found:
                found[name] = Found(outcome=remembered, cached=True)
        missing = {name: key for name, key in keys.items() if name not in found}
        if missing:
            with self._admission.computing(client, scenario, missing):
                found |= await self._compute(scenario, missing)
        return {name: found[name] for name in names}

    async def _compute(self, scenario: Scenario, missing: Mapping[str, str]) -> dict[str, Found]:
        """Join what is under way already; the rest goes to one worker, so that shared work is done once."""
        fresh = {name: key for name, key in missing.items() if key not in self._flights}
        if fresh:
            task = asyncio.create_task(self._fly(scenario, fresh))
            self._flights |= dict.fromkeys(fresh.values(), task)
        flights = {name: self._flights[key] for name, key in missing.items()}
        self._waiting.update(set(flights.values()))
        try:
            landed = {task: await asyncio.shield(task) for task in set(flights.values())}
        finally:
            self._leave(set(flights.values()))
        return {name: Found(outcome=landed[task][name], cached=name not in fresh) for name, task in flights.items()}

    async def _fly(self, scenario: Scenario, fresh: Mapping[str, str]) -> dict[str, Outcome]:
        this = asyncio.current_task()
        try:
            outcomes = await self._workers.call(worker.run, scenario, list(fresh))
            for name, key in fresh.items():
                self._memory.put(key, outcomes[name])
            return outcomes
        finally:
            for key in fresh.values():
                if self._flights.get(key) is this:
                    del self._flights[key]

    def _leave(self, flights: Iterable[asyncio.Task[dict[str, Outcome]]]) -> None:
        """One request less waits for these; a flight nobody waits for any more is called off."""
        for task in flights:
            self._waiting[task] -= 1
            if self._waiting[task]:
                continue
            del self._waiting[task]
            if not task.done():
                self._flights = {key: flight for key, flight in self._flights.items() if flight is not task}
                task.cancel()


def _from_store(item: StoredResult) -> Outcome:
    return Outcome(status=item.status, summary=item.summary, compute_ms=item.compute_ms, series=None)
