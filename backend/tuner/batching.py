"""Sets of weights on roads, as batches: handed in once, found again by their key, waited for, read road by road."""

import asyncio
import contextlib
from collections.abc import AsyncIterator, Sequence

import orjson

from backend.batches.driver import Driver
from backend.batches.service import Batches
from backend.batches.sweeps import Sweep
from backend.store import Store, StoredBatch, StoredTuning
from backend.store.batches import FINAL, BatchRow
from backend.tuner.measure import Aims, Failure, Measured, Roads
from backend.tuner.objectives import Summary
from backend.tuner.space import Weights
from sim_core.scenario import Scenario

LOOK = 0.4  # between two looks at a batch, where nothing tells that one has ended [s]
PAGE = 250  # rows read in one transaction
ROAD = "road.seed"
CLIENT = "tuner"  # whose computing it counts as


class TuningFailedError(Exception):
    """The tuning cannot go on; the message says why, to whoever asked for it."""


class TuningBatches:
    """The batches of tunings; its methods belong to the event loop."""

    def __init__(self, *, store: Store, batches: Batches, driver: Driver) -> None:
        self._store = store
        self._batches = batches
        self._driver = driver

    async def find(self, tuning: StoredTuning, name: str) -> StoredBatch | None:
        """The tuning's batch of that name, if it was handed in."""
        return await self._store.read(self._store.batches.by_idempotency_key, _key(tuning, name))

    async def submit(
        self, tuning: StoredTuning, name: str, strategy: str, sets: Sequence[Weights], seeds: Sequence[int]
    ) -> StoredBatch:
        """Hand in each set of weights on each road, a set's roads side by side.

        Raises:
            ServiceError: As `Batches.create`.
        """
        scenario = Scenario.model_validate(tuning.request["scenario"])
        sweep = Sweep.model_validate({"list": [{**weights, ROAD: seed} for weights in sets for seed in seeds]})
        await self._batches.create(scenario, [strategy], sweep, _key(tuning, name), CLIENT)
        batch = await self.find(tuning, name)
        assert batch is not None  # noqa: S101  # just accepted
        return batch

    async def cancel(self, batch: StoredBatch) -> None:
        """Nobody waits for it."""
        await self._batches.cancel(batch.id)

    async def passive(self, tuning: StoredTuning) -> StoredBatch:
        """The passive car on every road of the tuning."""
        found = await self.find(tuning, "passive")
        return found or await self.submit(tuning, "passive", "passive", [{}], roads(tuning))

    async def done(self, batch: StoredBatch) -> None:
        """Wait until it is.

        Raises:
            TuningFailedError: It was cancelled, or failed as a whole.
        """
        while True:
            ended = self._driver.ended
            found = await self._store.read(self._store.batches.load, batch.id)
            if found is None or found.state in FINAL:
                break
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(LOOK):
                    await ended.wait()
        if found is None or found.state == "cancelled":
            raise TuningFailedError("One of its batches was cancelled")
        if found.state == "failed":
            raise TuningFailedError(f"One of its batches failed. {found.reason}")

    async def measured(
        self, batch: StoredBatch, aims: Aims, seeds: Sequence[int], passive: dict[int, Summary]
    ) -> list[Roads]:
        """What each set of weights of a batch that is done gave on each road."""
        found: list[Roads] = []
        async for rows in self._pages(batch.id):
            values = await asyncio.to_thread(_measure, rows, aims, seeds, passive)
            for row, value in zip(rows, values, strict=True):
                index, road = divmod(row.position, len(seeds))
                if index == len(found):
                    found.append({})
                found[index][seeds[road]] = value
        return found

    async def summaries(self, batch: StoredBatch, seeds: Sequence[int]) -> dict[int, Summary]:
        """A batch's runs by road, where it has one set of weights.

        Raises:
            TuningFailedError: One of them failed.
        """
        found: dict[int, Summary] = {}
        async for rows in self._pages(batch.id):
            for row in rows:
                summary = orjson.loads(row.summary or "{}")
                if row.status != "ok":
                    raise TuningFailedError(f"The passive car failed. {row.reason or summary.get('reason')}")
                found[seeds[row.position]] = summary
        return found

    async def _pages(self, batch_id: str) -> AsyncIterator[list[BatchRow]]:
        last = -1
        while rows := await self._store.read(self._store.batches.rows, batch_id, last, PAGE):
            yield rows
            last = rows[-1].position


def roads(tuning: StoredTuning) -> list[int]:
    """Every road of the tuning: those trained on, then the fresh ones."""
    return [*tuning.request["seeds"], *tuning.request["fresh_seeds"]]


def sets_of(batch: StoredBatch, seeds: Sequence[int]) -> list[Weights]:
    """The sets of weights that a batch was handed in with."""
    points = batch.sweep["list"][:: len(seeds)]
    return [{name: value for name, value in point.items() if name != ROAD} for point in points]


def _measure(
    rows: Sequence[BatchRow], aims: Aims, seeds: Sequence[int], passive: dict[int, Summary]
) -> list[Measured | Failure]:
    return [aims.measured(row, passive.get(seeds[row.position % len(seeds)], {})) for row in rows]


def _key(tuning: StoredTuning, name: str) -> str:
    """The batch's idempotency key; with spaces, which no request can send, so that nobody else's key is ever this."""
    return f"tuning {tuning.id} {tuning.attempt} {name}"
