"""Batches: accepted whole or refused, then followed, cancelled and read while the driver computes them."""

import asyncio
import hashlib
from collections.abc import AsyncIterator, Callable, Iterable, Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from cachetools import LRUCache

from backend import digest
from backend.batches import plan, reading
from backend.batches import table as batch_table
from backend.batches.driver import Driver
from backend.batches.robustness import BASELINE
from backend.batches.sweeps import Sweep, SweepError, size
from backend.batches.table import Format
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
from backend.runs import ordered
from backend.settings import Settings
from backend.store import Store, StoredBatch
from backend.store.batches import FINAL, UNFINISHED, BatchRow
from backend.streams import server_sent
from backend.unknown_names import pointer, shown_path
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import SCHEMA_VERSION, Scenario, dotted

PAGE = 250  # rows read in one transaction
RETRY_AFTER = 30
SUMMARIES = 16  # of batches that have ended, kept: a page that is opened again asks for the same


class Batches:
    """The one service of batches; its methods belong to the event loop."""

    def __init__(
        self, *, store: Store, workers: Workers, admission: Admission, driver: Driver, settings: Settings
    ) -> None:
        self._store = store
        self._workers = workers
        self._admission = admission
        self._driver = driver
        self._settings = settings
        self._summaries: LRUCache[tuple[str, ...], dict[str, Any]] = LRUCache(SUMMARIES)

    async def estimate(
        self, scenario: Scenario, strategies: Iterable[str], sweep: Sweep, client: str
    ) -> dict[str, Any]:
        """What that batch would be, as `Estimate`.

        Raises:
            InvalidError, CostLimitError: As `create`.
        """
        names = ordered(strategies)
        self._check_size(sweep, names)
        base = scenario.model_dump(mode="json")
        with self._admission.computing(client, scenario, names):
            planned = await self._planned(base, names, sweep)
            seconds = await self._workers.call(plan.pilot, base, names, sweep)
        failing = sum(run["result_key"] is None for run in planned.runs)
        points = len(planned.runs) // len(names)
        return {
            "points": points,
            "total": len(planned.runs),
            "contradictory": failing,
            "estimated_cost": planned.cost,
            "estimated_seconds": None if seconds is None else seconds * points / self._settings.batch_workers,
        }

    async def create(
        self, scenario: Scenario, strategies: Iterable[str], sweep: Sweep, key: str | None, client: str
    ) -> dict[str, Any]:
        """Accept a batch, as `Batch`: when this returns, it is committed.

        Raises:
            ConflictError: The idempotency key had another body.
            InvalidError: Fields or values that cannot be used.
            CostLimitError: It is too big.
            TemporaryError: Too much is waiting.
        """
        names = ordered(strategies)
        base = scenario.model_dump(mode="json")
        sent = sweep.model_dump(mode="json", by_alias=True, exclude_none=True)
        body = digest.canonical({"scenario": base, "strategies": names, "sweep": sent})
        request_hash = hashlib.sha256(body).hexdigest()[:43]
        if key is not None:
            known = await self._store.read(self._store.batches.by_idempotency_key, key)
            if known is not None:
                return _same(known, request_hash)
        self._check_size(sweep, names)
        await self._check_room()
        with self._admission.computing(client, scenario, names):
            planned = await self._planned(base, names, sweep)
        batch = StoredBatch(
            id=digest.random_id(),
            state="queued",
            reason=None,
            core_version=CORE_VERSION,
            schema_version=SCHEMA_VERSION,
            scenario=base,
            strategies=names,
            sweep=sent,
            fields=planned.fields,
            estimated_cost=planned.cost,
            total=len(planned.runs),
            done=0,
            failed=sum(run["result_key"] is None for run in planned.runs),
            request_hash=request_hash,
            created_at=datetime.now(UTC),
            started_at=None,
            finished_at=None,
        )
        stored, new = await self._store.write(self._store.batches.create, batch, planned.runs, key)
        if not new:
            return _same(stored, request_hash)
        self._driver.wake()
        return batch_answer(stored)

    async def get(self, batch_id: str) -> dict[str, Any]:
        """The batch as it stands, as `Batch`.

        Raises:
            NotFoundError: There is none.
        """
        return batch_answer(await self._stored(batch_id))

    async def newest(self, limit: int) -> dict[str, Any]:
        """The batches accepted last, as `Batches`."""
        return {"batches": [batch_answer(batch) for batch in await self._store.read(self._store.batches.newest, limit)]}

    async def cancel(self, batch_id: str) -> dict[str, Any]:
        """Cancel what waits and what runs; what is finished stays. A finished batch is answered as it is.

        Raises:
            NotFoundError: There is none.
        """
        await self._stored(batch_id)
        await self._store.write(self._store.batches.cancel, batch_id)
        self._driver.wake()
        return await self.get(batch_id)

    async def events(self, batch_id: str, after: int, client: str) -> AsyncIterator[bytes]:
        """Server-sent events behind number `after`, as they happen, until the batch has ended.

        Raises:
            NotFoundError: There is none.
            TemporaryError: Too many streams are open.
        """
        await self._stored(batch_id)

        async def ended() -> bool:
            return (await self._stored(batch_id)).state in FINAL

        return await server_sent(
            ended=ended,
            events=lambda number: self._store.read(self._store.batches.events, batch_id, number),
            after=after,
            admission=self._admission,
            client=client,
        )

    async def table(self, batch_id: str, figures: Sequence[str]) -> dict[str, Any]:
        """Every row column by column, with those figures, as `BatchTable`.

        Raises:
            NotFoundError: There is none.
        """
        batch = await self._stored(batch_id)
        whole: dict[str, list[Any]] = batch_table.columns([], batch.fields, figures)
        async for rows in self._pages(batch.id):
            page = await asyncio.to_thread(batch_table.columns, rows, batch.fields, figures)
            for name, values in page.items():
                whole[name] += values
        known = batch_table.units(batch)
        return {
            "batch": batch.id,
            "state": batch.state,
            "units": {name: known[name] for name in whole if name in known},
            "columns": whole,
        }

    async def summary(self, batch_id: str, figures: Sequence[str], baseline: str | None, client: str) -> dict[str, Any]:
        """What its finished rows say as a whole, as `BatchSummary`.

        Raises:
            NotFoundError: There is none.
            InvalidError: It has no such strategy as `baseline`.
            TemporaryError: Too much is being read.
        """
        batch = await self._stored(batch_id)
        against = baseline or (BASELINE if BASELINE in batch.strategies else batch.strategies[0])
        if against not in batch.strategies:
            message = f"The batch has no such strategy; it has {', '.join(batch.strategies)}"
            raise InvalidError(message, parameter="baseline")
        asked = (batch.id, against, *figures)
        if asked not in self._summaries:
            with self._admission.reading(client):
                pages = self._pages(batch.id)
                found = await reading.summarised(batch, pages, self._workers, figures, against)
            if batch.state not in FINAL:
                return found
            self._summaries[asked] = found
        return self._summaries[asked]

    async def results(self, batch_id: str, file_format: Format) -> tuple[StoredBatch, AsyncIterator[bytes]]:
        """The batch and its rows in that format, piece by piece.

        Raises:
            NotFoundError: There is none.
        """
        batch = await self._stored(batch_id)
        render: Callable[[StoredBatch, AsyncIterator[list[BatchRow]]], AsyncIterator[bytes]] = {
            "json": batch_table.as_json,
            "csv": batch_table.as_csv,
            "parquet": batch_table.as_parquet,
        }[file_format]
        return batch, render(batch, self._pages(batch.id))

    async def _pages(self, batch_id: str) -> AsyncIterator[list[BatchRow]]:
        last = -1
        while rows := await self._store.read(self._store.batches.rows, batch_id, last, PAGE):
            yield rows
            last = rows[-1].position

    async def _stored(self, batch_id: str) -> StoredBatch:
        batch = await self._store.read(self._store.batches.load, batch_id)
        if batch is None:
            raise NotFoundError("There is no batch of this id.")
        return batch

    async def _planned(self, base: Mapping[str, Any], names: Sequence[str], sweep: Sweep) -> plan.Plan:
        try:
            planned = await self._workers.call(plan.plan, base, names, sweep)
        except SweepError as error:
            errors = [
                {"pointer": pointer(["sweep", *shown_path(path)]), "message": message} for path, message in error.errors
            ]
            raise InvalidError("The sweep has fields that cannot be used; errors names each.", errors=errors) from None
        limit, each = self._settings.max_batch_cost, self._settings.max_request_cost
        if planned.cost > limit:
            raise _too_big(
                f"The estimated cost of {planned.cost:.3g} s of computing is over the limit of {limit:g} s a batch"
            )
        if planned.dearest > each:
            raise _too_big(
                f"One run's estimated cost of {planned.dearest:.3g} s of computing is over the limit of {each:g} s; "
                f"{CHEAPER_RUN}"
            )
        return planned

    def _check_size(self, sweep: Sweep, names: Sequence[str]) -> None:
        total, limit = size(sweep) * len(names), self._settings.max_batch_runs
        if total > limit:
            raise _too_big(f"{total:.6g} runs are over the limit of {limit} runs a batch")

    async def _check_room(self) -> None:
        counts = await self._store.read(self._store.batches.counts)
        if sum(counts.get(state, (0, 0))[0] for state in UNFINISHED) >= self._settings.max_unfinished_batches:
            raise BusyError("The service is full: too many batches are waiting.", retry_after=RETRY_AFTER)


def batch_answer(batch: StoredBatch) -> dict[str, Any]:
    """`Batch`."""
    known = dotted.fields()
    return {
        "id": batch.id,
        "state": batch.state,
        "reason": batch.reason,
        "total": batch.total,
        "done": batch.done,
        "failed": batch.failed,
        "core_version": batch.core_version,
        "scenario": batch.scenario,
        "strategies": batch.strategies,
        "sweep": batch.sweep,
        "fields": [
            {"name": name, "title": known[name].title, "unit": known[name].unit}
            if name in known
            else {"name": name, "title": name, "unit": "1"}
            for name in batch.fields
        ],
        "estimated_cost": batch.estimated_cost,
        "created_at": batch.created_at,
        "started_at": batch.started_at,
        "finished_at": batch.finished_at,
    }


def _same(known: StoredBatch, request_hash: str) -> dict[str, Any]:
    if known.request_hash != request_hash:
        raise ConflictError("This Idempotency-Key came with another request before.", kind="idempotency-key-reused")
    return batch_answer(known)


def _too_big(message: str) -> CostLimitError:
    return CostLimitError(message, pointer="/sweep")
