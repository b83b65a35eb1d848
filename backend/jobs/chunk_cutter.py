"""A job whose runs are being computed: which chunk comes next, and how large it is (about a second of computing)."""

import math
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from backend import digest
from backend.compute.chunk_messages import ComputeRun
from backend.job_run import JobRun
from backend.jobs.kind import JobKind
from backend.store import Store, StoredJob

CHUNK_SECONDS = 1.0  # a chunk is cut to take about so long
LONGEST_CHUNK = 1000  # runs
MOST_CRASHES = 3  # a run alone may lose its processes so often (two each time) before it fails


@dataclass(slots=True, kw_only=True)
class RunningJob:
    """A job whose runs are being computed.

    Attributes:
        job: The stored job as it was at the start.
        kind: What is computed of its runs.
        group: Cancels all its chunks together.
        order: Positions of the runs that waited at the start, in the order in which they are computed.
        sent: How many of them are sent.
        to_resend: Chunks to send again before new ones are cut.
        open_chunks: Chunks sent and not yet stored.
        last_send: Number of its last chunk among all chunks sent.
        run_seconds: Mean time of a run in the chunks so far [s].
        crash_count: How often a run alone lost its processes, by position.
    """

    job: StoredJob
    kind: JobKind
    group: str = field(default_factory=digest.random_id)
    order: NDArray[np.intp]
    sent: int = 0
    to_resend: list[list[JobRun]] = field(default_factory=list)
    open_chunks: int = 0
    last_send: int = 0
    run_seconds: float | None = None
    crash_count: Counter[int] = field(default_factory=Counter)

    @property
    def compute(self) -> ComputeRun:
        """Return what a worker computes of each run."""
        if self.kind.compute is None:
            raise TypeError(f"Jobs of the kind {self.kind.name} have no runs")
        return self.kind.compute

    async def next_chunk(self, store: Store, max_chunks: int) -> list[JobRun]:
        """Return the next chunk, where all jobs have at most `max_chunks` open; empty where no run is left."""
        if self.to_resend:
            return self.to_resend.pop(0)
        size = self.size(max_chunks)
        while next_ones := self.order[self.sent : self.sent + size].tolist():
            self.sent += len(next_ones)
            waiting = {run.position: run for run in await store.read(store.job_runs.waiting, self.job.id, next_ones)}
            if waiting:
                return [waiting[each] for each in next_ones if each in waiting]
        return []

    def take_back(self, *chunks: list[JobRun]) -> None:
        """Send these chunks again."""
        self.to_resend += [chunk for chunk in chunks if chunk]

    def halve(self, runs: list[JobRun]) -> bool:
        """Send a chunk that failed again as two halves; False where it is a single run."""
        half = len(runs) // 2
        self.take_back(*([runs[:half], runs[half:]] if half else []))
        return half > 0

    def try_again(self, runs: list[JobRun]) -> bool:
        """Send a single run that lost its process again; False after `MOST_CRASHES` tries."""
        self.crash_count[runs[0].position] += 1
        if self.crash_count[runs[0].position] == MOST_CRASHES:
            return False
        self.take_back(runs)
        return True

    def record_time(self, runs: int, seconds: float) -> None:
        """Update the mean time of a run: a chunk of `runs` took `seconds`."""
        if runs:
            each = seconds / runs
            self.run_seconds = each if self.run_seconds is None else 0.7 * self.run_seconds + 0.3 * each

    def size(self, max_chunks: int) -> int:
        """Return the size of the next chunk, where `max_chunks` can be open: the processes share the rest."""
        each = self.run_seconds or self.job.estimated_cost / self.job.total
        left = len(self.order) - self.sent
        return max(1, min(LONGEST_CHUNK, int(CHUNK_SECONDS / max(each, 1e-4)), math.ceil(left / max_chunks)))
