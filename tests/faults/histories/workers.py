"""Worker processes that take the time, die and hang as a history's seed has it, in place of real ones."""

import asyncio
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any
from unittest.mock import patch

from backend.compute import worker_process, workers
from backend.compute.fair_queue import FairQueue
from backend.compute.worker_process import Answer, WorkerDiedError
from backend.compute.workers import Workers
from tests.faults.histories.loop import SimulatedLoop

Gives = Callable[[Callable[..., Any], tuple[Any, ...]], Any]
Duration = Callable[[tuple[Any, ...]], float]  # of a task, by its arguments [s]


class Machine:
    """Processes of one machine.

    Attributes:
        dying: Share of tasks over which their process dies.
        slowest_start: Of a process [s].
        running: By process the arguments of its task.
        answer: What a task gives, from its function and arguments.
        begun: Called with the arguments of a task that begins.
    """

    def __init__(self, loop: SimulatedLoop, duration: Duration) -> None:
        self.loop = loop
        self.duration = duration
        self.dying = 0.0
        self.slowest_start = 1.0
        self.running: dict[Any, tuple[Any, ...]] = {}
        self.begun: Callable[[tuple[Any, ...]], None] = lambda _: None
        self.answer: Gives = lambda function, args: function(*args)

    @contextmanager
    def workers(self, count: int, **settings: Any) -> Iterator[Workers]:
        """Production workers that have these processes."""
        machine = self

        class Process(_Process):
            on = machine

        with patch.object(workers, "WorkerProcess", Process), patch.object(worker_process, "begin"):
            made = Workers(count, warm_up="", **settings)
            made._queue = FairQueue(reserved=settings.get("reserved", 0), clock=self.loop.time)
            made.start()
            yield made


class _Process:
    on: Machine

    def __init__(self, *_: Any) -> None:
        self.active = True
        self._asked: asyncio.Task[Answer] | None = None

    async def wait_until_warm(self) -> None:
        await asyncio.sleep(float(self.on.loop.rng.uniform(0.1, self.on.slowest_start)))

    def ask(self, function: Callable[..., Any], args: tuple[Any, ...]) -> "asyncio.Task[Answer]":
        self._asked = asyncio.ensure_future(self._answer(function, args))
        return self._asked

    async def _answer(self, function: Callable[..., Any], args: tuple[Any, ...]) -> Answer:
        if self in self.on.running:
            self.on.loop.broken("one process has two tasks")
        self.on.running[self] = args
        self.on.begun(args)
        seconds, dies = self.on.duration(args), self.on.loop.rng.random() < self.on.dying
        try:
            await asyncio.sleep(seconds / 2 if dies else seconds)
            if dies:
                self.active = False
                raise WorkerDiedError
        except asyncio.CancelledError:
            self.active = False
            raise
        finally:
            del self.on.running[self]
        return Answer(self.on.answer(function, args), None, 0)

    def end(self) -> None:
        self.active = False
        if self._asked is not None:
            self.on.loop.call_soon_threadsafe(self._asked.cancel)
