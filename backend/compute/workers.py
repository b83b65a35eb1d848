"""Warm worker processes for interactive runs.

A process that dies or hangs takes only its slot with it, and a new one is warmed while the others serve. A process
whose memory has grown too large is replaced, once a fresh one is warm.
"""

import asyncio
import contextlib
import logging
import os
from collections.abc import Callable, Coroutine
from concurrent.futures.process import BrokenProcessPool
from typing import Any, TypeVar

from pebble import ProcessExpired

from backend.compute.slots import Slot
from backend.errors import WorkerLostError, WorkersBusyError, WorkerTimeoutError
from backend.metrics import WORKER_FAILURES

logger = logging.getLogger(__name__)

T = TypeVar("T")
PATIENCE = 60.0  # for a free worker [s]
ATTEMPTS = 2
MAX_WORKER_MEMORY = 256 * 1024 * 1024  # resident, shared libraries included; beyond it a process is replaced [bytes]
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class Workers:
    """A fixed number of warm processes, which take one task each; the last used is first (its caches fit best)."""

    def __init__(self, count: int, *, timeout: float, nice: int = 0, max_memory: int = MAX_WORKER_MEMORY) -> None:
        self._count = count
        self._max_memory = max_memory
        self._timeout = timeout
        self._nice = nice
        self._idle: asyncio.LifoQueue[Slot] = asyncio.LifoQueue()
        self._slots: set[Slot] = set()
        self._chores: set[asyncio.Task[Any]] = set()
        self._waiting = 0
        self._spawned: list[Slot] = []
        self._warm = asyncio.Event()
        self._started = False

    def spawn(self) -> None:
        """Begin to spawn and warm every slot, and return; needs no event loop yet. `start` takes them over."""
        os.environ.update(ONE_THREAD)  # before they are spawned: BLAS reads it once
        for _ in range(self._count):
            with contextlib.suppress(OSError, BrokenProcessPool):  # `start` tries again
                self._spawned.append(Slot(self._nice))

    def start(self) -> None:
        """Begin to spawn and warm every slot, unless that has begun, and use each once it is warm."""
        self._started = True
        os.environ.update(ONE_THREAD)
        for _ in range(self._count):
            self._chore(self._add_slot(self._spawned.pop() if self._spawned else None))

    def abandon(self) -> None:
        """End the processes that `spawn` began, where the application does not start."""
        for slot in self._spawned:
            slot.end()

    async def wait_until_warm(self) -> None:
        """Wait until the first worker is warm."""
        await self._warm.wait()

    @property
    def count(self) -> int:
        """Number of processes when all are started."""
        return self._count

    @property
    def ready(self) -> bool:
        """Whether a warm worker is there, busy or idle."""
        return any(slot.active for slot in self._slots)

    @property
    def load(self) -> dict[str, int]:
        """How many processes are busy and idle, and how many tasks wait for one."""
        idle = self._idle.qsize()
        return {"busy": max(0, len(self._slots) - idle), "idle": idle, "waiting": self._waiting}

    async def call(self, function: Callable[..., T], *args: Any, ends_with_caller: bool = False) -> T:
        """Run `function(*args)` in a worker; a task whose worker dies is tried once more. The first starts the workers.

        A caller that is cancelled leaves the task to its end, or (`ends_with_caller`) has the worker killed at once.

        Raises:
            WorkerLostError: Two workers died over it (or every one was found dead).
            WorkerTimeoutError: It took longer than the limit.
            WorkersBusyError: None came free within a minute.
        """
        if not self._started:
            self.start()
        deaths = 0
        for _ in range(self._count + ATTEMPTS):
            slot = await self._free_slot()
            if not slot.active:  # died while idle: not this task's doing
                self._discard(slot)
                continue
            # Shielded: whoever asked may go away, the slot is given back all the same.
            attempt = self._chore(self._attempt(slot, function, args))
            try:
                return await asyncio.shield(attempt)
            except asyncio.CancelledError:
                if ends_with_caller:
                    attempt.cancel()
                raise
            except BrokenProcessPool:
                logger.warning("A worker was found dead before it took a task")
            except ProcessExpired:
                deaths += 1
                WORKER_FAILURES.labels("died").inc()
                logger.warning("A worker died during a task (%d of %d attempts)", deaths, ATTEMPTS)
                if deaths == ATTEMPTS:
                    break
            except TimeoutError:
                WORKER_FAILURES.labels("timeout").inc()
                raise WorkerTimeoutError from None
        raise WorkerLostError

    async def _attempt(self, slot: Slot, function: Callable[..., T], args: tuple[Any, ...]) -> T:
        """Run it in that slot; afterwards the slot is idle again, or discarded where its process is not well."""
        healthy = False
        try:
            result, memory = await slot.call(function, args, self._timeout)
            healthy = True
            if memory > self._max_memory and all(each.state == "serving" for each in self._slots):  # one at a time
                logger.info("A worker has grown to %d MB and is replaced", memory >> 20)
                slot.state = "grown"
                self._chore(self._replace(slot))
            return result
        except (ProcessExpired, BrokenProcessPool, TimeoutError):
            raise
        except Exception:
            healthy = True  # the function raised, its process is well
            raise
        finally:
            if healthy and slot.state != "succeeded":
                self._idle.put_nowait(slot)
            else:
                self._discard(slot)

    async def close(self) -> None:
        """End every process; takes at most a few seconds."""
        ending, self._slots = self._slots, set()
        chores = tuple(self._chores)
        for chore in chores:
            chore.cancel()
        await asyncio.gather(*chores, return_exceptions=True)
        await asyncio.gather(*(asyncio.to_thread(slot.end) for slot in ending))

    async def _free_slot(self) -> Slot:
        self._waiting += 1
        try:
            async with asyncio.timeout(PATIENCE):
                return await self._idle.get()
        except TimeoutError:
            raise WorkersBusyError from None
        finally:
            self._waiting -= 1

    def _discard(self, slot: Slot) -> None:
        if slot not in self._slots:  # the service is closing, and ends it
            return
        self._slots.discard(slot)
        self._chore(asyncio.to_thread(slot.end))
        if slot.state == "serving":  # else its successor is warm, or soon will be
            self._chore(self._add_slot())

    async def _replace(self, slot: Slot) -> None:
        """Warm a successor, then end that slot as soon as it is idle."""
        await self._add_slot()
        slot.state = "succeeded"
        idle = [self._idle.get_nowait() for _ in range(self._idle.qsize())]
        for each in reversed(idle):  # back in their order, without that one
            if each is slot:
                self._discard(slot)
            else:
                self._idle.put_nowait(each)

    async def _add_slot(self, slot: Slot | None = None) -> None:
        """Spawn a process, warm it and hand it out; keep trying, more slowly, while that fails."""
        for delay in (0.1, 1.0, 5.0, *[30.0] * 1000):
            try:
                slot = slot or Slot(self._nice)
                await slot.wait_until_warm()
            except asyncio.CancelledError:
                if slot is not None:
                    await asyncio.shield(asyncio.to_thread(slot.end))
                raise
            except Exception:  # whatever kept it from starting, the service goes on trying
                logger.exception("A worker did not start")
                if slot is not None:
                    await asyncio.to_thread(slot.end)
                slot = None
                await asyncio.sleep(delay)
            else:
                self._slots.add(slot)
                self._idle.put_nowait(slot)
                self._warm.set()
                return

    def _chore(self, work: Coroutine[Any, Any, T]) -> asyncio.Task[T]:
        """Run it beside; the set keeps it alive, and a failure nobody waits for is no news."""
        task = asyncio.ensure_future(work)
        self._chores.add(task)
        task.add_done_callback(self._chore_done)
        return task

    def _chore_done(self, task: asyncio.Task[Any]) -> None:
        self._chores.discard(task)
        if not task.cancelled():
            task.exception()
