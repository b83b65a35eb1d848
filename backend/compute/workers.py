"""Warm worker processes, which clients share fairly.

One that dies, hangs, or whose memory has grown too large is replaced while the others serve.
"""

import asyncio
import contextlib
import logging
import os
from collections.abc import Callable, Coroutine
from typing import Any, TypeVar

from backend.compute import worker_process
from backend.compute.fair_queue import SHORT, FairQueue, Task
from backend.compute.worker_process import Answer, WorkerDiedError, WorkerProcess
from backend.errors import WorkerLostError, WorkersBusyError, WorkerTimeoutError
from backend.metrics import WORKER_FAILURES

logger = logging.getLogger(__name__)

T = TypeVar("T")
WAIT_FOR_PROCESS = 60.0  # in which no task begins, before those that wait are refused [s]
ATTEMPTS = 2
BATCH_NICE = 10  # of 19: a process of batches beside one that computes for a person gets a tenth of a core
RESERVED = 1  # of the interactive processes for short runs, beside those that are set
MAX_WORKER_MEMORY = 256 * 1024 * 1024  # resident, shared libraries included; beyond it a process is replaced [bytes]
NOTHING = Answer(None, None, 0)  # of a task that never began
ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class Workers:
    """Warm processes, which take one task each; the last used is first (its caches fit best).

    Attributes:
        count: How many tasks of one client may run at once.

    Args:
        count: How many tasks of one client may run at once.
        timeout: A task may take this long [s].
        warm_up: Name of the module that each process imports before its first task, which warms it up.
        nice: How far behind other processes these stand (0 to 19).
        max_memory: Resident, after a task; beyond it a process is replaced [bytes].
        reserved: So many processes more are left to short tasks of clients that have none running.
    """

    def __init__(
        self,
        count: int,
        *,
        timeout: float,
        warm_up: str,
        nice: int = 0,
        max_memory: int = MAX_WORKER_MEMORY,
        reserved: int = 0,
    ) -> None:
        self.count = count
        self._reserved = reserved
        self._max_memory = max_memory
        self._timeout = timeout
        self._warm_up = warm_up
        self._nice = nice
        self._queue = FairQueue(reserved=reserved)
        self._turns: dict[Task, asyncio.Future[WorkerProcess]] = {}  # of the tasks that wait
        self._idle: list[WorkerProcess] = []
        self._processes: set[WorkerProcess] = set()
        self._ending: set[WorkerProcess] = set()  # which `close` waits for
        self._background: set[asyncio.Task[Any]] = set()
        self._warm = asyncio.Event()
        self._started = self._closed = False

    def begin(self) -> None:
        """Begin to warm up; needs no event loop yet, `start` goes on."""
        os.environ.update(ONE_THREAD)  # before anything is spawned: BLAS reads it once
        worker_process.begin(self._warm_up)

    def start(self) -> None:
        """Begin to add every process, each of them used once it is warm."""
        self._started = True
        self.begin()
        for _ in range(self.count):
            self._spawn_background(self._add_process())
        for _ in range(self._reserved):
            self._spawn_background(self._add_reserved())

    async def wait_until_warm(self) -> None:
        """Wait until the first worker is warm."""
        await self._warm.wait()

    @property
    def ready(self) -> bool:
        """Check whether a warm worker is there, busy or idle."""
        return any(process.active for process in self._processes)

    @property
    def load(self) -> dict[str, int]:
        """Return how many processes are busy and idle, and how many tasks wait for one."""
        idle = len(self._idle)
        return {"busy": max(0, len(self._processes) - idle), "idle": idle, "waiting": self._queue.waiting}

    async def call(self, function: Callable[..., T], *args: Any, client: str = "", cost: float = 0.0) -> T:
        """Run `function(*args)` in a worker; a task whose worker dies is tried once more. The first starts the workers.

        A task whose caller is cancelled does not begin; one that runs ends with its process, unless it is short.

        Args:
            function: What to run.
            *args: Its arguments.
            client: Who asks: of several the one that has least in work is next. Empty is the service itself.
            cost: Estimated [s].

        Raises:
            WorkerLostError: Two workers died over it.
            WorkerTimeoutError: It took longer than the limit.
            WorkersBusyError: None came free within a minute, for whatever task.
        """
        if not self._started:
            self.start()
        for attempt in range(1, ATTEMPTS + 1):
            task, process = await self._turn(client, cost)
            answering = process.ask(function, args)
            try:
                async with asyncio.timeout(self._timeout):
                    answer = await asyncio.shield(answering)
            except asyncio.CancelledError:
                self._spawn_background(self._abandon(task, process, answering))
                raise
            except TimeoutError:
                WORKER_FAILURES.labels("timeout").inc()
                answering.add_done_callback(_ignore)
                self._give_back(task, process, None)
                raise WorkerTimeoutError from None
            except WorkerDiedError:
                if self._closed:
                    break
                WORKER_FAILURES.labels("died").inc()
                logger.warning("A worker died during a task (%d of %d attempts)", attempt, ATTEMPTS)
                self._give_back(task, process, None)
                continue
            except Exception:  # a task that cannot be sent, or an answer that cannot be read
                self._give_back(task, process, None)
                raise
            self._give_back(task, process, answer)
            if answer.error is not None:
                raise answer.error
            result: T = answer.value
            return result
        raise WorkerLostError

    async def close(self) -> None:
        """End every process; takes at most a few seconds."""
        self._closed = True
        self._ending |= self._processes
        self._processes = set()
        background = tuple(self._background)
        for each in background:
            each.cancel()
        await asyncio.gather(*background, return_exceptions=True)
        await asyncio.gather(*(asyncio.to_thread(process.end) for process in self._ending))

    async def _abandon(self, task: Task, process: WorkerProcess, answering: asyncio.Future[Answer]) -> None:
        """Nobody waits for a task any more: a short one may end by itself, as a new process has empty caches."""
        answering.add_done_callback(_ignore)
        left = 0.0 if task.cost > SHORT else max(0.0, SHORT - self._queue.elapsed(task))
        answer = None
        try:
            await asyncio.wait({answering}, timeout=left)
            if answering.done() and answering.exception() is None:
                answer = answering.result()
        finally:
            self._give_back(task, process, answer)

    async def _turn(self, client: str, cost: float) -> tuple[Task, WorkerProcess]:
        """Return a task that begins now, and the process that is to run it."""
        task = self._queue.add(client, cost)
        turn = self._turns[task] = asyncio.get_running_loop().create_future()
        self._dispatch()
        try:
            while not turn.done():
                begun = self._queue.begun
                await asyncio.wait({turn}, timeout=WAIT_FOR_PROCESS)
                if self._queue.begun == begun:
                    raise WorkersBusyError
            return task, turn.result()
        except BaseException:
            if turn.done():  # its turn came just then
                self._give_back(task, turn.result(), NOTHING)
            turn.cancel()
            self._queue.remove(task)
            raise
        finally:
            self._turns.pop(task, None)

    def _dispatch(self) -> None:
        """Hand idle processes to the tasks that are next."""
        for process in [each for each in self._idle if each.pipe.poll()]:  # died while idle: no task's doing
            self._idle.remove(process)
            self._replace(process)
        while self._idle and (task := self._queue.begin_next(len(self._processes))) is not None:
            turn = self._turns[task]
            if turn.cancelled():  # whoever asked for it goes away just now
                self._queue.end(task)
            else:
                turn.set_result(self._idle.pop())

    def _give_back(self, task: Task, process: WorkerProcess, answer: Answer | None) -> None:
        """A task has ended: its process takes the next one; one that gave no answer, or has grown, is replaced."""
        self._queue.end(task, killed=answer is None)
        if answer is not None and answer.memory <= self._max_memory:
            self._idle.append(process)
        else:
            self._replace(process)
        self._dispatch()

    def _replace(self, process: WorkerProcess) -> None:
        if process not in self._processes:  # the service is closing, and ends it
            return
        self._processes.discard(process)
        self._ending.add(process)
        self._spawn_background(self._end(process))
        self._spawn_background(self._add_process())

    async def _end(self, process: WorkerProcess) -> None:
        """End a process; where that is called off, `close` does it."""
        await asyncio.to_thread(process.end)
        self._ending.discard(process)

    async def _add_reserved(self) -> None:
        """Add a process that the service needs only once another one has something to do."""
        await self._warm.wait()
        await self._add_process()

    async def _add_process(self) -> None:
        """Spawn a process, warm it and hand it out; keep trying, more slowly, while that fails."""
        for delay in (0.1, 1.0, 5.0, *[30.0] * 1000):
            # In a thread: the first waits for what warms up.
            spawning = asyncio.ensure_future(asyncio.to_thread(WorkerProcess, self._warm_up, self._nice))
            try:
                process = await asyncio.shield(spawning)
                await process.wait_until_warm()
            except asyncio.CancelledError:
                await asyncio.shield(_end(spawning))
                raise
            except Exception:  # whatever kept it from starting, the service goes on trying
                logger.exception("A worker did not start")
                await _end(spawning)
                await asyncio.sleep(delay)
            else:
                self._processes.add(process)
                self._idle.append(process)
                self._warm.set()
                self._dispatch()
                return

    def _spawn_background(self, work: Coroutine[Any, Any, T]) -> asyncio.Task[T]:
        """Run it beside; the set keeps it alive, and a failure nobody waits for is no news."""
        task = asyncio.ensure_future(work)
        self._background.add(task)
        task.add_done_callback(self._forget)
        return task

    def _forget(self, task: asyncio.Task[Any]) -> None:
        self._background.discard(task)
        _ignore(task)


def _ignore(ended: "asyncio.Future[Any]") -> None:
    """Note that nobody waits for this any more: asyncio would log a failure as never retrieved."""
    if not ended.cancelled():
        ended.exception()


async def _end(spawning: "asyncio.Future[WorkerProcess]") -> None:
    """End a process that does not serve, if it came to be one."""
    with contextlib.suppress(Exception):
        process = await spawning
        await asyncio.to_thread(process.end)
