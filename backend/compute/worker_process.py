"""A worker process: a pool of one.

One that dies, hangs or breaks its pipe breaks its pool, which is thrown away whole, with every lock in it.
"""

import asyncio
import contextlib
import multiprocessing
import os
import signal
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Future, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import forkserver, resource_tracker
from typing import Any, TypeVar

from pebble import ProcessPool

from backend.compute import processes

T = TypeVar("T")
# Elsewhere a system's own libraries may fail in what was forked.
METHOD = "forkserver" if sys.platform == "linux" else "spawn"
GRACE = 15.0  # beyond the task's own time limit: then the pool itself is stuck [s]
WARM_UP = 120.0  # a new process may take to import and warm up, on a busy machine [s]
STARTING = 1.0  # a process that is ended before it is warm may take to start [s]
POLL_INTERVAL = 0.25  # of a process that computes [s]


def begin(warm_up: str) -> None:
    """Have the fork server warm up, where there is one: its children come later."""
    if METHOD == "forkserver":
        _context(warm_up)
        resource_tracker.ensure_running()  # by itself the fork server would start this, which unblocks interrupts
        with _interrupts_blocked():
            forkserver.ensure_running()


def _context(warm_up: str) -> Any:
    context = multiprocessing.get_context(METHOD)
    context.set_forkserver_preload([warm_up])  # no other method takes notice
    return context


@contextlib.contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Children inherit this: Ctrl-C, which a terminal sends to all, is the service's."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class WorkerProcess:
    """A process that has warmed up before its first task.

    A fork server's child shares what that has warmed and is there at once; the first one waits for the server.

    Args:
        warm_up: Name of a module whose import warms up.
        nice: How far behind other processes it stands.

    Raises:
        BrokenProcessPool: It broke at once.
    """

    def __init__(self, warm_up: str, nice: int) -> None:
        with _interrupts_blocked():
            self._pool = ProcessPool(
                max_workers=1, initializer=processes.start, initargs=(nice,), context=_context(warm_up)
            )
            self._warm = self._schedule(processes.prepare, (warm_up,), WARM_UP)
        self._pid = 0

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
        from backend import custom_controllers  # takes the core, which the service imports beside its first worker

        task = self._schedule(
            processes.call_and_measure, (function, args, custom_controllers.controller_sources()), timeout
        )
        result: tuple[T, int] = await self._result(task, timeout)
        return result

    def interrupt(self) -> None:
        """Call its task off; the process stays, as long as the task is Python or ends soon."""
        with contextlib.suppress(ProcessLookupError):  # it has just died
            os.kill(self._pid, processes.INTERRUPT)

    def end(self) -> None:
        """End its process; takes at most a few seconds."""
        wait([self._warm], STARTING)  # it would complain of locks that are gone
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
