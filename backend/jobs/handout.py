"""What of a sweep is handed out next, and how large a chunk: about a second of computing."""

import math
from collections import Counter
from dataclasses import dataclass, field

from backend import digest
from backend.jobs.chunk import WaitingRun
from backend.store import Store, StoredJob

CHUNK_SECONDS = 1.0  # a chunk is cut to take about so long
SHORTEST_CHUNK = 0.1  # and no shorter where the rest of a job is shared out [s]
FIRST_CHUNK = 8  # runs at most, while it is not known how long one takes
FIRST_COST = 2.0  # their estimated cost [s]
LONGEST_CHUNK = 1000  # runs
STRIKES = 3  # a run alone may lose its processes so often (two each time) before it fails


@dataclass(slots=True, kw_only=True)
class HandOut:
    """A sweep being computed.

    Attributes:
        job: As it was when this began.
        group: Of its chunks.
        position: Runs up to this one are computed or on their way.
        returned: Chunks to hand out (again) before new ones are cut.
        under_way: How many chunks are not yet stored.
        exhausted: Whether no run behind `position` waits, as far as is known.
        turn: When it was last given a place.
        run_seconds: How long a run takes, by the chunks so far [s].
        strikes: How often a run alone lost its processes, by key.
    """

    job: StoredJob
    group: str = field(default_factory=digest.random_id)
    position: int = -1
    returned: list[list[WaitingRun]] = field(default_factory=list)
    under_way: int = 0
    exhausted: bool = False
    turn: int = 0
    run_seconds: float | None = None
    strikes: Counter[str] = field(default_factory=Counter)

    async def next_chunk(self, store: Store, places: int) -> list[WaitingRun]:
        """What to hand out next, where so many chunks can be under way; nothing where all is on its way or done."""
        if self.returned:
            return self.returned.pop(0)
        while not self.exhausted:
            last, runs = await store.write(store.job_runs.waiting, self.job.id, self.position, self.size(places))
            if last is None:
                self.exhausted = True
            else:
                self.position = last
            if runs:
                return runs
        return []

    def take_back(self, *chunks: list[WaitingRun]) -> None:
        """Hand these out again."""
        self.returned += [chunk for chunk in chunks if chunk]

    def halve(self, runs: list[WaitingRun]) -> bool:
        """Hand a chunk that could not be computed out again in two halves; False where it is a single run."""
        keys = list(dict.fromkeys(run.key for run in runs))
        if len(keys) == 1:
            return False
        first = set(keys[: len(keys) // 2])
        self.take_back([run for run in runs if run.key in first], [run for run in runs if run.key not in first])
        return True

    def try_again(self, runs: list[WaitingRun]) -> bool:
        """Hand a single run that lost its process out again; False where it has had its tries."""
        self.strikes[runs[0].key] += 1
        if self.strikes[runs[0].key] == STRIKES:
            return False
        self.take_back(runs)
        return True

    def learn(self, runs: int, seconds: float) -> None:
        """A chunk of so many runs took so long."""
        if runs:
            each = max(seconds, 1e-4) / runs
            self.run_seconds = each if self.run_seconds is None else 0.7 * self.run_seconds + 0.3 * each

    def size(self, places: int) -> int:
        """Runs of the next chunk, where so many chunks can be under way: at the end the rest is shared."""
        if self.run_seconds is None:
            each = self.job.estimated_cost / self.job.total
            return min(FIRST_CHUNK, max(1, int(FIRST_COST / max(each, 1e-3))))
        left = self.job.total - 1 - self.position
        share = max(math.ceil(left / places), round(SHORTEST_CHUNK / self.run_seconds))
        return min(LONGEST_CHUNK, max(1, min(round(CHUNK_SECONDS / self.run_seconds), share)))
