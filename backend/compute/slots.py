"""Slots: each a pool of one process of its own.

A process that dies, hangs or breaks its pipe breaks its slot, which is thrown away whole, with every lock in it.
"""

import asyncio
import contextlib
import multiprocessing
from collections.abc import Callable
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from typing import Any, TypeVar

from pebble import ProcessPool

from backend.compute import processes

T = TypeVar("T")
Spawned = tuple[ProcessPool, "Future[None]"]  # a slot, and when it is warm
GRACE = 15.0  # beyond the task's own time limit: then the slot itself is stuck [s]
WARM_UP = 120.0  # a new process may take to import and warm up, on a busy machine [s]
POLL_INTERVAL = 0.25  # of a slot that computes [s]


def new(nice: int) -> ProcessPool:
    """A slot, whose process starts with its first task."""
    context = multiprocessing.get_context("spawn")
    return ProcessPool(max_workers=1, initializer=processes.start, initargs=(nice,), context=context)


def schedule(slot: ProcessPool, function: Callable[..., T], args: tuple[Any, ...], timeout: float) -> "Future[T]":
    """Hand the slot a task.

    Raises:
        BrokenProcessPool: It broke since it was looked at.
    """
    try:
        task: Future[T] = slot.schedule(function, args=args, timeout=timeout)
    except RuntimeError as error:
        raise BrokenProcessPool(str(error)) from None
    return task


def warm_up(slot: ProcessPool) -> "Future[None]":
    """Let its process import and compute what later tasks find done."""
    return schedule(slot, processes.warm_up, (), WARM_UP)


async def result(slot: ProcessPool, task: "Future[T]", timeout: float) -> T:
    """The task's result; a slot that breaks just as it takes a task would leave it unanswered for ever.

    Raises:
        BrokenProcessPool: The slot broke.
        TimeoutError: The slot is stuck beyond the task's own time limit [s].
    """
    future = asyncio.wrap_future(task)
    future.add_done_callback(_retrieve_exception)
    for _ in range(int((timeout + GRACE) / POLL_INTERVAL)):
        done, _ = await asyncio.wait({future}, timeout=POLL_INTERVAL)
        if done:
            return future.result()
        if not slot.active:
            raise BrokenProcessPool("The slot broke")
    raise TimeoutError


def end(slot: ProcessPool) -> None:
    """End its process; takes at most a few seconds."""
    with contextlib.suppress(Exception):  # a broken pool may fail to end tidily; its process is ended all the same
        slot.stop()  # type: ignore[no-untyped-call]  # pebble leaves it untyped
        slot.join()


def _retrieve_exception(future: asyncio.Future[Any]) -> None:
    """Nobody may wait any more when it is set: asyncio would log it as never retrieved."""
    if not future.cancelled():
        future.exception()
