"""The paper page's rows: those that are stored, and a job that computes the others."""

import asyncio
import contextlib
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import timedelta
from functools import partial

import orjson

from backend.compute.shared_computations import SharedComputations
from backend.errors import BusyError, TooManyRequestsError
from backend.job_run import JobRun
from backend.jobs.kind import JobKind
from backend.jobs.service import request_hash
from backend.json_types import JsonObject
from backend.paper.paper_rows import compute_row
from backend.store import Store, StoredJob
from backend.store.job import FINAL
from sim_core.scenario import Scenario

RETRY_AFTER = 30
MAX_JOBS = 16  # that compute rows, of all visitors
MAX_CLIENT_JOBS = 4  # of one visitor; the page asks for four at once
# Rows that failed are not tried again before, for those who ask every second
# (test_rows_that_failed_are_not_computed_again_for_who_asks_every_second).
TRY_AGAIN = timedelta(minutes=1)
ROW_COST = 0.02  # [s of one core]
REPRODUCTION = JobKind(
    name="reproduction", word="reproduction", plural="reproductions", compute=compute_row, delete_when_done=True
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Rows:
    """The rows of a request that are available.

    Attributes:
        by_key: Those that are.
        total: How many were asked for.
        reason: Why some failed; None where none did. The others are complete then.
        complete: Whether there is nothing to wait for.
    """

    by_key: JsonObject
    total: int
    reason: str | None
    complete: bool


class PaperRows:
    """Reads rows, or submits a job that computes them."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._waits: SharedComputations[str, str | None] = SharedComputations()
        self._clients: dict[str, str] = {}  # who submitted an unfinished job, by its id

    async def get(self, requests: Sequence[JobRun], client: str, patience: float | None) -> Rows:
        """These rows; the first ones are computed first.

        Args:
            requests: What is needed; each row may be there several times.
            client: Who asks.
            patience: How long to wait for what is missing [s]; None is until it is there.

        Raises:
            TooManyRequestsError: Too much of the paper page is being computed for this client.
            BusyError: Too much of it is being computed.
        """
        unique = list({request.key: request for request in requests}.values())
        rows, reason = await self._stored(unique)
        if len(rows) < len(unique) and reason is None:
            job = await self._job(unique, client, patient=patience is None)
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(None if job.state in FINAL else patience):
                    reason = await self._waits.join(job.id, partial(self._wait, job))
            rows, failed = await self._stored(unique)
            reason = reason or failed
        complete = len(rows) == len(unique) or reason is not None
        return Rows(by_key=rows, total=len(unique), reason=reason, complete=complete)

    async def _stored(self, requests: Sequence[JobRun]) -> tuple[JsonObject, str | None]:
        """By key the rows that are stored, and why one has failed for good."""
        results = await self._store.read(self._store.runs.load_results, [request.key for request in requests])
        rows = {key: result.summary["row"] for key, result in results.items() if result.status == "ok"}
        reasons = [result.summary["reason"] for result in results.values() if result.status == "failed"]
        return rows, next(iter(reasons), None)

    async def _job(self, requests: Sequence[JobRun], client: str, *, patient: bool) -> StoredJob:
        """The job that computes these rows: an unfinished one, or (unless `patient`) one that failed lately."""
        key = f"paper {request_hash([request.key for request in requests])}"
        existing = await self._store.read(self._store.jobs.by_idempotency_key, REPRODUCTION.name, key)
        if existing is not None:
            ended = existing.finished_at
            failed_lately = existing.failed and not patient
            if ended is None or (failed_lately and await self._store.read(self._store.now) - ended < TRY_AGAIN):
                return existing
            await self._store.write(self._store.jobs.delete, existing.id)
        await self._check_open_jobs(client)
        job = StoredJob(
            kind=REPRODUCTION.name,
            request={"scenario": Scenario().model_dump(mode="json"), "strategies": [], "fields": []},
            estimated_cost=ROW_COST * len(requests),
            total=len(requests),
            request_hash=request_hash(key),
        )
        runs = [request._replace(position=position) for position, request in enumerate(requests)]
        stored, _ = await self._store.write(self._store.jobs.create, job, runs, key)
        self._clients.setdefault(stored.id, client)
        return stored

    async def _check_open_jobs(self, client: str) -> None:
        """Refuse a further job where too many are unfinished."""
        unfinished = await self._store.read(self._store.jobs.unfinished)
        waiting = {job.id for job in unfinished if job.kind == REPRODUCTION.name}
        self._clients = {job_id: each for job_id, each in self._clients.items() if job_id in waiting}
        if list(self._clients.values()).count(client) >= MAX_CLIENT_JOBS:
            detail = f"This client has used its share: {MAX_CLIENT_JOBS} parts of the paper page are being computed."
            raise TooManyRequestsError(detail, retry_after=RETRY_AFTER)
        if len(waiting) >= MAX_JOBS:
            detail = "The service is full: too much of the paper page is being computed."
            raise BusyError(detail, retry_after=RETRY_AFTER)

    async def _wait(self, job: StoredJob) -> str | None:
        """Wait for the job's end; why one of its runs failed."""
        now = await self._store.ended(job.id)
        if now is None or not now.failed:
            return None
        rows = await self._store.read(self._store.job_runs.rows, job.id, -1, now.total)
        failed = (row for row in rows if row.status == "failed")
        return next((row.reason or orjson.loads(row.summary or "{}").get("reason") for row in failed), None)
