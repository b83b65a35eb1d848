"""A worker process: a pool of one.

One that dies, hangs or breaks its pipe breaks its pool, which is thrown away whole, with every lock in it.
"""

import asyncio
import contextlib
import multiprocessing
import os
import signal
from collections.abc import Callable
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from typing import Any, Literal, TypeVar

from pebble import ProcessPool

from backend.compute import processes

T = TypeVar("T")
GRACE = 15.0  # beyond the task's own time limit: then the pool itself is stuck [s]
WARM_UP = 120.0  # a new process may take to import and warm up, on a busy machine [s]
POLL_INTERVAL = 0.25  # of a process that computes [s]


class WorkerProcess:
    """A process that has warmed up before its first task.

    Attributes:
        state: `grown` while a successor of a process that takes too much memory is warmed, `succeeded` once that is
            warm: then it ends when it is idle.

    Raises:
        BrokenProcessPool: It broke at once.
    """

    def __init__(self, warm_up: processes.WarmUp, nice: int) -> None:
        context = multiprocessing.get_context("spawn")
        # Inherited: Ctrl-C, which a terminal sends to all, is the service's; one that still imports would fail loudly.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            self._pool = ProcessPool(max_workers=1, initializer=processes.start, initargs=(nice,), context=context)
            self._warm = self._schedule(processes.prepare, (warm_up,), WARM_UP)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        self._pid = 0
        self.state: Literal["serving", "grown", "succeeded"] = "serving"

    @property
    def active(self) -> bool:
        """Whether it still accepts tasks."""
        return bool(self._pool.active)

    async def wait_until_warm(self) -> None:
        """Wait until it is warm; raises the error that prevented it."""
        self._pid = await self._result(self._warm, WARM_UP)

    async def call(self, function: Callable[..., T], args: tuple[Any, ...], timeout: float) -> tuple[T, int]:
        """The function's result, and the resident memory of the process afterwards [bytes].

        Raises:
            BrokenProcessPool: It broke.
            ProcessExpired: The process died.
            TimeoutError: It took longer than `timeout` [s] and was ended, or the pool is stuck.
        """
        task = self._schedule(processes.call_and_measure, (function, args), timeout)
        result: tuple[T, int] = await self._result(task, timeout)
        return result

    def interrupt(self) -> None:
        """Call its task off; the process stays, as long as the task is Python or ends soon."""
        with contextlib.suppress(ProcessLookupError):  # it has just died
            os.kill(self._pid, processes.INTERRUPT)

    def end(self) -> None:
        """End its process; takes at most a few seconds."""
        with contextlib.suppress(Exception):  # a broken pool may fail to end tidily; its process is ended all the same
            self._pool.stop()  # type: ignore[no-untyped-call]  # pebble leaves it untyped
            self._pool.join()

    def _schedule(self, function: Callable[..., Any], args: tuple[Any, ...], timeout: float) -> "Future[Any]":
        try:
            task: Future[Any] = self._pool.schedule(function, args=args, timeout=timeout)
        except RuntimeError as error:  # it broke since it was looked at
            raise BrokenProcessPool(str(error)) from None
        return task

    async def _result(self, task: "Future[T]", timeout: float) -> T:
        """The task's result; a pool that breaks just as it takes a task would leave it unanswered for ever."""
        future = asyncio.wrap_future(task)
        future.add_done_callback(_retrieve_exception)
        for _ in range(int((timeout + GRACE) / POLL_INTERVAL)):
            done, _ = await asyncio.wait({future}, timeout=POLL_INTERVAL)
            if done:
                return future.result()
            if not self.active:
                raise BrokenProcessPool("The worker's pool broke")
        raise TimeoutError


def _retrieve_exception(future: asyncio.Future[Any]) -> None:
    """Nobody may wait any more when it is set: asyncio would log it as never retrieved."""
    if not future.cancelled():
        future.exception()
