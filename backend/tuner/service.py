"""Tunings: accepted whole or refused, then followed, cancelled, resumed and read while the driver goes on with them."""

import asyncio
import hashlib
import math
from collections.abc import AsyncIterator, Mapping
from datetime import UTC, datetime
from typing import Any

from backend import digest
from backend.batches import plan
from backend.batches.service import Batches
from backend.batches.sweeps import Sweep
from backend.compute import Workers
from backend.errors import (
    CHEAPER_RUN,
    BusyError,
    ConflictError,
    CostLimitError,
    InvalidError,
    NotFoundError,
)
from backend.http.admission import Admission
from backend.settings import Settings
from backend.store import Store, StoredTuning
from backend.store.tunings import FINAL, UNFINISHED
from backend.streams import server_sent
from backend.tuner import answers
from backend.tuner.driver import TuningDriver
from backend.tuner.measure import Aims
from backend.tuner.models import TuningRequest
from backend.tuner.space import first_weights
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.workload import estimate

RETRY_AFTER = 30


class Tunings:
    """The one service of tunings; its methods belong to the event loop."""

    def __init__(
        self,
        *,
        store: Store,
        workers: Workers,
        admission: Admission,
        batches: Batches,
        driver: TuningDriver,
        settings: Settings,
    ) -> None:
        self._store = store
        self._workers = workers
        self._admission = admission
        self._batches = batches
        self._driver = driver
        self._settings = settings

    async def estimate(self, wanted: TuningRequest, client: str) -> dict[str, Any]:
        """What that tuning would be, as `TuningEstimate`.

        Raises:
            CostLimitError: As `create`.
        """
        request = _stored_request(wanted)
        runs, cost = self._workload(request, wanted.trials)
        first = first_weights(request["scenario"], wanted.strategy, request["search"])
        points = [{**weights, "road.seed": seed} for weights in first for seed in wanted.seeds]
        sweep = Sweep.model_validate({"list": points})
        with self._admission.computing(client, wanted.scenario, [wanted.strategy]):
            each = await self._workers.call(plan.pilot, request["scenario"], [wanted.strategy], sweep)
        return {
            "runs": runs,
            "generations": math.ceil(wanted.trials / wanted.population),
            "estimated_cost": cost,
            "estimated_seconds": None if each is None else each * runs / self._settings.batch_workers,
        }

    async def create(self, wanted: TuningRequest, key: str | None) -> dict[str, Any]:
        """Accept a tuning, as `Tuning`: when this returns, it is committed.

        Raises:
            ConflictError: The idempotency key had another body.
            CostLimitError: It is too big.
            BusyError: Too many are waiting.
        """
        request = _stored_request(wanted)
        body = digest.canonical({**request, "trials": wanted.trials})
        request_hash = hashlib.sha256(body).hexdigest()[:43]
        if key is not None:
            known = await self._store.read(self._store.tunings.by_idempotency_key, key)
            if known is not None:
                return await self._same(known, request_hash)
        _, cost = self._workload(request, wanted.trials)
        await self._check_room()
        tuning = StoredTuning(
            id=digest.random_id(),
            state="queued",
            reason=None,
            step="search",
            attempt=1,
            core_version=CORE_VERSION,
            schema_version=SCHEMA_VERSION,
            request=request,
            estimated_cost=cost,
            total=wanted.trials,
            done=0,
            failed=0,
            feasible=0,
            generation=0,
            batch_id=None,
            comparison=None,
            request_hash=request_hash,
            created_at=datetime.now(UTC),
            started_at=None,
            finished_at=None,
        )
        stored, new = await self._store.write(self._store.tunings.create, tuning, key)
        if not new:
            return await self._same(stored, request_hash)
        self._driver.wake()
        return answers.tuning(stored, [], [])

    async def get(self, tuning_id: str) -> dict[str, Any]:
        """The tuning as it stands, as `Tuning`.

        Raises:
            NotFoundError: There is none.
        """
        return await self._answer(await self._stored(tuning_id))

    async def newest(self, limit: int) -> dict[str, Any]:
        """The tunings accepted last, as `Tunings`."""
        found = await self._store.read(self._store.tunings.newest, limit)
        return {"tunings": [answers.summary(tuning) for tuning in found]}

    async def trials(self, tuning_id: str) -> dict[str, Any]:
        """Every trial, as `Trials`.

        Raises:
            NotFoundError: There is none.
        """
        tuning = await self._stored(tuning_id)
        found = await self._store.read(self._store.tunings.trials, tuning.id)
        return {"tuning": tuning.id, "trials": [answers.trial(each) for each in found]}

    async def cancel(self, tuning_id: str) -> dict[str, Any]:
        """End it and the batch it waits for; complete generations stay. One that has ended is answered as it is.

        Raises:
            NotFoundError: There is none.
        """
        await self._stored(tuning_id)
        await self._store.write(self._store.tunings.cancel, tuning_id)
        tuning = await self._stored(tuning_id)
        if tuning.state == "cancelled" and tuning.batch_id is not None:
            await self._batches.cancel(tuning.batch_id)
        return await self._answer(tuning)

    async def resume(self, tuning_id: str, trials: int | None) -> dict[str, Any]:
        """Go on where it stopped, up to so many trials; one that has not ended is answered as it is.

        Raises:
            NotFoundError: There is none.
            ConflictError: It has not ended and other trials are asked for, or there is nothing left to do.
            InvalidError: It has more trials already.
            CostLimitError: It would be too big.
        """
        tuning = await self._stored(tuning_id)
        total = tuning.total if trials is None else trials
        if tuning.state in UNFINISHED and total == tuning.total:
            return await self._answer(tuning)
        if tuning.state in UNFINISHED:
            raise ConflictError("It has not ended: cancel it to change its number of trials.", kind="not-ended")
        if total < tuning.done + tuning.failed:
            message = f"It has {tuning.done + tuning.failed} trials already"
            raise InvalidError(message, parameter="trials")
        if tuning.state == "done" and total == tuning.total:
            raise ConflictError("It is done: name a greater number of trials to go on.", kind="done")
        _, cost = self._workload(tuning.request, total)
        await self._check_room()
        await self._store.write(self._store.tunings.resume, tuning_id, total, cost)
        self._driver.wake()
        return await self.get(tuning_id)

    async def events(self, tuning_id: str, after: int, client: str) -> AsyncIterator[bytes]:
        """Server-sent events behind number `after`, as they happen, until the tuning has ended.

        Raises:
            NotFoundError: There is none.
            TemporaryError: Too many streams are open.
        """
        await self._stored(tuning_id)

        async def ended() -> bool:
            return (await self._stored(tuning_id)).state in FINAL

        return await server_sent(
            ended=ended,
            events=lambda number: self._store.read(self._store.tunings.events, tuning_id, number),
            after=after,
            admission=self._admission,
            client=client,
        )

    async def _answer(self, tuning: StoredTuning) -> dict[str, Any]:
        trials = await self._store.read(self._store.tunings.trials, tuning.id)
        history = await self._store.read(self._store.tunings.history, tuning.id)
        return await asyncio.to_thread(answers.tuning, tuning, trials, history)

    async def _stored(self, tuning_id: str) -> StoredTuning:
        tuning = await self._store.read(self._store.tunings.load, tuning_id)
        if tuning is None:
            raise NotFoundError("There is no tuning of this id.")
        return tuning

    async def _same(self, known: StoredTuning, request_hash: str) -> dict[str, Any]:
        if known.request_hash != request_hash:
            raise ConflictError("This Idempotency-Key came with another request before.", kind="idempotency-key-reused")
        return await self._answer(known)

    def _workload(self, request: Mapping[str, Any], trials: int) -> tuple[int, float]:
        """Runs at most, and their estimated cost [s of one core].

        Raises:
            CostLimitError: Over the limits of a batch.
        """
        scenario = Scenario.model_validate(request["scenario"])
        aims = Aims(objectives=request["objectives"], limits=request["limits"])
        training, fresh = len(request["seeds"]), len(request["fresh_seeds"])
        points = len(aims.objectives) + 3  # of the comparison at most: the paper's, the own, each best, the knee
        runs = trials * training + points * fresh
        passive = (training + fresh) if aims.needs_passive else 0
        each = estimate(scenario, request["strategy"])
        cost = runs * each + passive * estimate(scenario, "passive")
        settings = self._settings
        if runs + passive > settings.max_batch_runs:
            raise _too_big(f"{runs + passive} runs are over the limit of {settings.max_batch_runs} runs a tuning")
        if cost > settings.max_batch_cost:
            raise _too_big(
                f"The estimated cost of {cost:.3g} s of computing is over the limit of {settings.max_batch_cost:g} s "
                "a tuning"
            )
        if each > settings.max_request_cost:
            raise _too_big(
                f"One run's estimated cost of {each:.3g} s of computing is over the limit of "
                f"{settings.max_request_cost:g} s; {CHEAPER_RUN}",
                "/scenario",
            )
        return runs + passive, cost

    async def _check_room(self) -> None:
        counts = await self._store.read(self._store.tunings.counts)
        if sum(counts.get(state, 0) for state in UNFINISHED) >= self._settings.max_unfinished_batches:
            raise BusyError("The service is full: too many tunings are waiting.", retry_after=RETRY_AFTER)


def _stored_request(wanted: TuningRequest) -> dict[str, Any]:
    """The request as it is kept: all written out, without the number of trials, which resuming may change."""
    sent = wanted.model_dump(mode="json", exclude={"trials", "dry_run"})
    return {
        **sent,
        "objectives": [objective.stored() for objective in wanted.objectives],
        "search": {name: list(ends) for name, ends in wanted.ranges.items()},
    }


def _too_big(message: str, pointer: str = "/trials") -> CostLimitError:
    return CostLimitError(message, pointer=pointer)
