"""What every kind of job does: accept once, list, follow, label, cancel, delete."""

import hashlib
from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any

from backend import digest
from backend.errors import CHEAPER_RUN, BusyError, ConflictError, CostLimitError, ForbiddenError, NotFoundError
from backend.gate import Gate
from backend.jobs.events import server_sent
from backend.jobs.kind import JobKind
from backend.settings import MAX_BATCH_RUNS, MAX_UNFINISHED_JOBS, Settings
from backend.store import Store, StoredJob
from backend.store.job import UNFINISHED, WAITING, State

RETRY_AFTER = 30


@dataclass(eq=False, kw_only=True)
class Jobs:
    """The service of one kind of job.

    Attributes:
        kind: Which.
        store: The database.
        gate: What is accepted at once.
        settings: Of the service.
    """

    kind: JobKind
    store: Store
    gate: Gate
    settings: Settings

    async def existing(self, key: str | None, request_hash: str) -> StoredJob | None:
        """Return the job that was accepted with that idempotency key.

        Raises:
            ConflictError: The key had another request.
        """
        if key is None:
            return None
        job = await self.store.read(self.store.jobs.by_idempotency_key, self.kind.name, key)
        return None if job is None else _same(job, request_hash)

    async def check_room(self) -> None:
        """Refuse where too many jobs of this kind wait.

        Raises:
            BusyError: There are.
        """
        counts = await self.store.read(self.store.jobs.counts)
        waiting = sum(
            count for (kind, state), (count, _) in counts.items() if kind == self.kind.name and state in UNFINISHED
        )
        if waiting >= MAX_UNFINISHED_JOBS:
            raise BusyError(f"The service is full: too many {self.kind.plural} are waiting.", retry_after=RETRY_AFTER)

    def check_runs(self, runs: float) -> None:
        """Refuse a job of too many runs; raises CostLimitError."""
        limit = MAX_BATCH_RUNS
        if runs > limit:
            raise self._over_limit(f"{runs:.6g} runs are over the limit of {limit} runs")

    def check_cost(self, cost: float, max_run_cost: float) -> None:
        """Refuse a job of that estimated cost, and of its costliest run [s of one core]; raises CostLimitError."""
        limit, each = self.settings.max_batch_cost, self.settings.max_request_cost
        if cost > limit:
            raise self._over_limit(f"The estimated cost of {cost:.3g} s of computing is over the limit of {limit:g} s")
        if max_run_cost > each:
            raise CostLimitError(
                f"One run's estimated cost of {max_run_cost:.3g} s of computing is over the limit of {each:g} s; "
                f"{CHEAPER_RUN}",
                pointer=self.kind.run_pointer,
            )

    def _over_limit(self, message: str) -> CostLimitError:
        return CostLimitError(f"{message} a {self.kind.word}", pointer=self.kind.size_pointer)

    async def accept(self, job: StoredJob, key: str | None) -> StoredJob:
        """Commit a job; where one was accepted with that key meanwhile, return that one.

        Raises:
            ConflictError: The key had another request.
        """
        stored, new = await self.store.write(self.store.jobs.create, job, (), key)
        return stored if new else _same(stored, job.request_hash)

    async def get(self, job_id: str) -> StoredJob:
        """Return the job as it stands.

        Raises:
            NotFoundError: There is none.
        """
        job = await self.store.read(self.store.jobs.load, job_id)
        if job is None or job.kind != self.kind.name:
            raise NotFoundError(f"There is no {self.kind.word} of this id.")
        return job

    async def page(
        self, *, limit: int, cursor: str | None, state: State | None, label: str | None
    ) -> tuple[list[StoredJob], str | None]:
        """Return the newest jobs without their sweeps, and the cursor of the next page (None: this is the last one)."""
        jobs = self.store.jobs
        return await self.store.read(jobs.page, self.kind.name, limit, cursor, state=state, label=label)

    async def positions(self, *jobs: StoredJob) -> dict[str, int]:
        """Return by id the number of runs of earlier jobs that wait; 0 for a job that runs or has ended."""
        unfinished = []
        if any(job.state in WAITING for job in jobs):
            unfinished = await self.store.read(self.store.jobs.unfinished)
        return {
            job.id: sum(
                other.open_runs
                for other in unfinished
                if job.state in WAITING and (other.created_at, other.id) < (job.created_at, job.id)
            )
            for job in jobs
        }

    async def owned(self, job_id: str, owner: str | None) -> StoredJob:
        """Return the job, for one who wants to change it: the token that submitted it, or anybody where none did.

        Args:
            job_id: The job.
            owner: The name of the token that asks; None where the service has no tokens, and every job is everybody's.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: It belongs to another token.
        """
        job = await self.get(job_id)
        if None not in (job.owner, owner) and job.owner != owner:
            raise ForbiddenError("This belongs to another token; only its owner may change it.")
        return job

    async def cancel(self, job_id: str, owner: str | None) -> StoredJob:
        """Cancel a job's waiting and running runs; finished ones stay. A job that has ended is returned unchanged.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: It belongs to another token.
        """
        await self.owned(job_id, owner)
        await self.store.write(self.store.jobs.cancel, job_id)
        return await self.get(job_id)

    async def resume(self, job_id: str, **values: Any) -> StoredJob:
        """Continue a job that has ended, with these columns changed."""
        await self.check_room()
        await self.store.write(self.store.jobs.resume, job_id, **values)
        return await self.get(job_id)

    async def set_label(self, job_id: str, label: str | None, owner: str | None) -> StoredJob:
        """Set its label, or (None) remove it.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: It belongs to another token.
        """
        await self.owned(job_id, owner)
        await self.store.write(self.store.jobs.set_label, job_id, label)
        return await self.get(job_id)

    async def delete(self, job_id: str, owner: str | None) -> None:
        """Delete a job; results that runs and other jobs share stay.

        Raises:
            NotFoundError: There is none.
            ForbiddenError: It belongs to another token.
            ConflictError: It has not ended, or a link shows it.
        """
        await self.owned(job_id, owner)
        if not await self.store.write(self.store.jobs.delete, job_id):
            raise ConflictError(
                "It has not ended, or a link shows it: cancel it first; what a link shows stays.", kind="not-deletable"
            )
        while await self.store.write(self.store.jobs.purge):
            pass

    async def events(self, job_id: str, after: int, client: str) -> AsyncIterator[bytes]:
        """Stream server-sent events behind number `after`, as they happen, until the job has ended.

        Raises:
            NotFoundError: There is none.
            TooManyRequestsError: The client has too many streams open.
            BusyError: The service has.
        """
        await self.get(job_id)
        return await server_sent(self.store, job_id, after, self.gate, client)


def request_hash(request: Any) -> str:
    """Return a hash that is equal for equal requests."""
    return hashlib.sha256(digest.canonical(request)).hexdigest()[:43]


def _same(job: StoredJob, hashed: str) -> StoredJob:
    if job.request_hash != hashed:
        raise ConflictError("This Idempotency-Key came with another request before.", kind="idempotency-key-reused")
    return job
