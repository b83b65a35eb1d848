"""The steps of a tuning: a generation is asked for, computed and committed; in the end the comparison.

The database is the truth here too. The next step follows from what is committed: the trials of complete generations,
and batches that are found again by their keys. So whoever takes a step, and however often it is begun, it is the same
step, and what a crash interrupts goes on where its batch stands.
"""

import asyncio
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

from backend.store import Store, StoredBatch, StoredTuning
from backend.store.tunings import Step, StoredTrial
from backend.tuner import comparison, front
from backend.tuner.batching import TuningBatches, TuningFailedError, roads, sets_of
from backend.tuner.measure import Aims, Roads
from backend.tuner.objectives import Summary
from backend.tuner.space import Weights, first_weights, weights_at, weights_of


class Steps:
    """Takes steps; its methods belong to the event loop, Optuna to a thread of its own."""

    def __init__(self, store: Store, batches: TuningBatches) -> None:
        self._store = store
        self._batches = batches
        self._asking = ThreadPoolExecutor(1, thread_name_prefix="tuner")

    def close(self) -> None:
        """Nothing more is asked."""
        self._asking.shutdown(wait=False, cancel_futures=True)

    async def take(self, tuning: StoredTuning) -> None:
        """The next step, to its end.

        Raises:
            TuningFailedError: It cannot go on.
            UndefinedObjectiveError: An objective cannot be told.
            ServiceError: As `Batches.create`.
        """
        trials = await self._store.read(self._store.tunings.trials, tuning.id)
        aims = Aims(objectives=tuning.request["objectives"], limits=tuning.request["limits"])
        if len(trials) < tuning.total:
            await self._generation(tuning, trials, aims)
        else:
            await self._compare(tuning, trials, aims)

    async def _generation(self, tuning: StoredTuning, trials: list[StoredTrial], aims: Aims) -> None:
        seeds, name = tuning.request["seeds"], str(tuning.generation)
        batch = await self._batches.find(tuning, name)
        if batch is None:
            sets = await self._next_weights(tuning, trials, aims)
            batch = await self._batches.submit(tuning, name, tuning.request["strategy"], sets, seeds)
        measured = await self._measured(tuning, "search", batch, aims, seeds)
        if measured is None:
            return
        made = [
            aims.trial(len(trials) + index, tuning.generation, weights, found)
            for index, (weights, found) in enumerate(zip(sets_of(batch, seeds), measured, strict=True))
        ]
        if not trials and all(trial.values is None for trial in made):
            raise TuningFailedError(f"No set of weights could be run. {made[0].reason}")
        told = await asyncio.to_thread(_told, [*trials, *made], len(aims.objectives))
        await self._store.write(self._store.tunings.add_generation, tuning, made, told)

    async def _next_weights(self, tuning: StoredTuning, trials: list[StoredTrial], aims: Aims) -> list[Weights]:
        """The generation's sets of weights: first the paper's and the scenario's own, then what Optuna proposes."""
        from backend.tuner.search import Search, ask  # Optuna and all: not before there is a tuning

        request = tuning.request
        scenario, strategy, ranges = request["scenario"], request["strategy"], request["search"]
        count = min(request["population"], tuning.total - len(trials))
        given = first_weights(scenario, strategy, ranges)[len(trials) : len(trials) + count]
        search = Search(
            ranges=ranges,
            scenario=scenario,
            objectives=len(aims.objectives),
            limits=aims.most,
            seed=request["seed"],
        )
        asked = partial(ask, search, trials, generation=tuning.generation, count=count - len(given))
        points = await asyncio.get_running_loop().run_in_executor(self._asking, asked)
        own = weights_at(scenario, strategy, ranges)
        return [*given, *(weights_of(point, ranges, own) for point in points)]

    async def _compare(self, tuning: StoredTuning, trials: list[StoredTrial], aims: Aims) -> None:
        request, objectives = tuning.request, len(aims.objectives)
        own = len(first_weights(request["scenario"], request["strategy"], request["search"])) > 1 < len(trials)
        roles = await asyncio.to_thread(comparison.chosen, trials, objectives, own=own)
        batch = await self._batches.find(tuning, "comparison")
        if batch is None:
            sets = [trials[number].weights for number in roles]
            batch = await self._batches.submit(tuning, "comparison", request["strategy"], sets, roads(tuning))
        measured = await self._measured(tuning, "comparison", batch, aims, roads(tuning))
        if measured is None:
            return
        by_number = dict(zip(roles, measured, strict=True))
        seeds, fresh = request["seeds"], request["fresh_seeds"]
        points = comparison.compared(trials, roles, by_number, seeds, fresh, objectives)
        found = {"batch": batch.id, "figures": aims.figures, "points": points}
        await self._store.write(self._store.tunings.finish, tuning, found)

    async def _measured(
        self, tuning: StoredTuning, step: Step, batch: StoredBatch, aims: Aims, seeds: Sequence[int]
    ) -> list[Roads] | None:
        """What each set of weights of the batch gave on each road; None where the tuning has ended meanwhile."""
        if not await self._store.write(self._store.tunings.waits_for, tuning, batch.id, step):
            await self._batches.cancel(batch)
            return None
        passive: dict[int, Summary] = {}
        if aims.needs_passive:
            reference = await self._batches.passive(tuning)
            await self._batches.done(reference)
            passive = await self._batches.summaries(reference, roads(tuning))
        await self._batches.done(batch)
        return await self._batches.measured(batch, aims, seeds, passive)


def _told(trials: Sequence[StoredTrial], objectives: int) -> Mapping[str, Any]:
    """What a generation's event tells beside the counts: how good the best are by now."""
    best = [front.best(trials, index) for index in range(objectives)]
    return {
        "best": [None if trial is None or trial.values is None else trial.values[i] for i, trial in enumerate(best)],
        "hypervolume": front.dominated_share(front.front(trials), trials[0].values),
    }
