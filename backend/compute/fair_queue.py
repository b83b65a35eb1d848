"""Which task is next: one of the client that has the least in work. Knows neither processes nor the event loop."""

import time
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from math import inf

from cachetools import TTLCache

SHORT = 1.0  # a task of no greater estimated cost may take a reserved process [s]
HALF_LIFE = 10.0  # after which half of what a client has used is forgotten [s]
MOST_CLIENTS = 10_000  # whose use is remembered


@dataclass(slots=True, eq=False)
class Task:
    """A task that waits or runs.

    Attributes:
        client: Who asks for it.
        cost: Estimated [s].
        begun: When it began to run, on the queue's clock [s]; infinite while it waits.
        reserved: Whether it took a reserved place.
    """

    client: str
    cost: float
    begun: float = inf
    reserved: bool = False


class FairQueue:
    """Tasks that wait for a process, and those that run.

    A client has in work what its running tasks cost, by estimate or by the time so far, whichever is more, and what its
    earlier ones took, of which half is forgotten after every HALF_LIFE. The time that was measured counts, so a client
    gains nothing where its tasks are estimated too low. Of one client the oldest task is next.

    Attributes:
        begun: How many tasks have begun.

    Args:
        reserved: Of all places so many, but not the last one, are left to short tasks of clients that have no task
            running.
        clock: Seconds, monotonic.
    """

    def __init__(self, *, reserved: int = 0, clock: Callable[[], float] = time.monotonic) -> None:
        self.begun = 0
        self._reserved = reserved
        self._clock = clock
        self._waiting: dict[Task, None] = {}  # in their order
        self._running: set[Task] = set()
        # By client the seconds it used, and when they were counted.
        self._used: TTLCache[str, tuple[float, float]] = TTLCache(MOST_CLIENTS, 10 * HALF_LIFE, clock)

    @property
    def waiting(self) -> int:
        """Return how many tasks wait."""
        return len(self._waiting)

    def add(self, client: str, cost: float) -> Task:
        """Add a task that waits from now on, with its estimated cost [s]."""
        task = Task(client, cost)
        self._waiting[task] = None
        return task

    def remove(self, task: Task) -> None:
        """Forget a task that waits."""
        self._waiting.pop(task, None)

    def begin_next(self, places: int) -> Task | None:
        """Begin the task that is next, where so many may run at once; None where none may begin."""
        running = Counter(task.client for task in self._running)
        reserved = max(0, min(self._reserved, places - 1))
        in_reserved = min(reserved, sum(task.reserved for task in self._running))
        anybody = len(self._running) - in_reserved < places - reserved
        eligible = [
            task
            for task in self._waiting
            if anybody or (in_reserved < reserved and task.cost <= SHORT and not running[task.client])
        ]
        if not eligible:
            return None
        in_work = {client: self.in_work(client) for client in {task.client for task in eligible}}
        task = min(eligible, key=lambda each: in_work[each.client])  # of equals the first, which is the oldest
        del self._waiting[task]
        self.begun += 1
        task.begun, task.reserved = self._clock(), not anybody
        self._running.add(task)
        return task

    def end(self, task: Task, *, killed: bool = False) -> None:
        """End a running task; killed, it counts as all that was estimated, for its process has to start again."""
        self._running.discard(task)
        now = self._clock()
        took = max(now - task.begun, task.cost if killed else 0.0)
        self._used[task.client] = self._still_used(task.client) + took, now

    def in_work(self, client: str) -> float:
        """Return what the client has in work [s]."""
        now = self._clock()
        running = (max(task.cost, now - task.begun) for task in self._running if task.client == client)
        return self._still_used(client) + sum(running)

    def elapsed(self, task: Task) -> float:
        """Return how long the task has been running [s]; 0 while it waits."""
        return max(0.0, self._clock() - task.begun)

    def _still_used(self, client: str) -> float:
        used, counted = self._used.get(client, (0.0, 0.0))
        return used * float(0.5 ** ((self._clock() - counted) / HALF_LIFE))
