"""The paper page's rows: those that are stored, and a job that computes the others for as long as somebody waits."""

import asyncio
import contextlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from typing import Any

from backend.errors import BusyError
from backend.jobs.reproduction.work import RowRequest
from backend.jobs.service import request_hash
from backend.store import Store, StoredJob
from backend.store.jobs import FINAL, UNFINISHED
from sim_core.scenario import Scenario

RETRY_AFTER = 30
MAX_JOBS = 8  # that compute rows, of all visitors
LINGER = 15.0  # a job that nobody waits for is cancelled after so long [s]
TRY_AGAIN = timedelta(minutes=1)  # rows that failed are not tried again before, for those who ask every second
LOOK = 1.0  # between two looks at a job of another process [s]
ROW_COST = 0.02  # [s of one core]


@dataclass(frozen=True, slots=True, kw_only=True)
class Rows:
    """What is there of the rows that were asked for.

    Attributes:
        by_key: Those that are.
        total: How many were asked for.
        reason: Why some failed; None where none did. The others are complete then.
        complete: Whether there is nothing to wait for.
    """

    by_key: Mapping[str, Any]
    total: int
    reason: str | None
    complete: bool


class PaperRows:
    """Finds rows, or has them computed; its methods belong to the event loop."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._waiting: Counter[str] = Counter()
        self._asked_at: dict[str, float] = {}
        self._watching: set[asyncio.Task[None]] = set()

    async def get(self, requests: Sequence[RowRequest], patience: float | None) -> Rows:
        """These rows; those that come first are computed first.

        Args:
            requests: What is needed; each row may be there several times.
            patience: How long to wait for what is missing [s]; None is until it is there.

        Raises:
            BusyError: Too much of the paper page is being computed.
        """
        unique = list({request.key: request for request in requests}.values())
        rows = await self._stored(unique)
        if len(rows) == len(unique):
            return Rows(by_key=rows, total=len(unique), reason=None, complete=True)
        job = await self._job(unique, patient=patience is None)
        with self._waited_for(job.id):
            job, reason = await self._wait(job, patience)
        rows = await self._stored(unique)
        complete = len(rows) == len(unique) or reason is not None
        return Rows(by_key=rows, total=len(unique), reason=reason, complete=complete)

    async def _stored(self, requests: Sequence[RowRequest]) -> dict[str, Any]:
        results = await self._store.read(self._store.runs.load_results, [request.key for request in requests])
        return {key: result.summary["row"] for key, result in results.items()}

    async def _job(self, requests: Sequence[RowRequest], *, patient: bool) -> StoredJob:
        """The job that computes these rows: one under way, or (not for the patient) one that failed lately."""
        key = f"paper {request_hash([request.key for request in requests])}"
        existing = await self._store.read(self._store.jobs.by_idempotency_key, "reproduction", key)
        if existing is not None:
            ended = existing.finished_at
            failed_lately = existing.failed and not patient
            if ended is None or (failed_lately and datetime.now(UTC) - ended < TRY_AGAIN):
                return existing
            await self._store.write(self._store.jobs.delete, existing.id)
        counts = await self._store.read(self._store.jobs.counts)
        waiting = [n for (kind, state), (n, _) in counts.items() if kind == "reproduction" and state in UNFINISHED]
        if sum(waiting) >= MAX_JOBS:
            detail = "The service is full: too much of the paper page is being computed."
            raise BusyError(detail, retry_after=RETRY_AFTER)
        job = StoredJob(
            kind="reproduction",
            request={"scenario": Scenario().model_dump(mode="json"), "strategies": [], "fields": []},
            estimated_cost=ROW_COST * len(requests),
            total=len(requests),
            request_hash=request_hash(key),
        )
        runs = [request.run(position) for position, request in enumerate(requests)]
        stored, new = await self._store.write(self._store.jobs.create, job, runs, key)
        if new:
            task = asyncio.create_task(self._watch(stored.id))
            self._watching.add(task)
            task.add_done_callback(self._watching.discard)
        return stored

    async def _wait(self, job: StoredJob, patience: float | None) -> tuple[StoredJob, str | None]:
        """Until it has ended; as it is then, and why one of its runs failed."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(patience):
                while True:
                    changes = self._store.changes.count
                    now = await self._store.read(self._store.jobs.load, job.id)
                    if now is None or now.state in FINAL:
                        break
                    await self._store.changes.wait_beyond(changes, LOOK)
        now = await self._store.read(self._store.jobs.load, job.id)
        if now is None or not now.failed or now.state not in FINAL:
            return job, None
        rows = await self._store.read(self._store.job_runs.rows, job.id, -1, now.total)
        return now, next((row.reason for row in rows if row.status == "failed"), None)

    @contextlib.contextmanager
    def _waited_for(self, job_id: str) -> Iterator[None]:
        self._waiting[job_id] += 1
        try:
            yield
        finally:
            self._waiting[job_id] -= 1
            self._asked_at[job_id] = asyncio.get_running_loop().time()

    async def _watch(self, job_id: str) -> None:
        """Cancel a job of this process that nobody has waited for for a while."""
        clock = asyncio.get_running_loop().time
        self._asked_at.setdefault(job_id, clock())
        while True:
            await asyncio.sleep(LINGER / 3)
            job = await self._store.read(self._store.jobs.load, job_id)
            if job is None or job.state in FINAL:
                break
            if not self._waiting[job_id] and clock() - self._asked_at[job_id] > LINGER:
                await self._store.write(self._store.jobs.cancel, job_id)
                await self._store.write(self._store.jobs.delete, job_id)
                break
        del self._waiting[job_id], self._asked_at[job_id]
