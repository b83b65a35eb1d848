"""A worker process, and what happens inside: it takes one task after the other through a pipe of its own.

Nothing is shared with other workers, no queue and no lock: one that dies or hangs takes its own task with it.
"""

import asyncio
import contextlib
import multiprocessing
import os
import pickle
import resource
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from importlib import import_module
from multiprocessing import forkserver, parent_process, resource_tracker
from multiprocessing.connection import Connection
from multiprocessing.pool import ExceptionWithTraceback  # type: ignore[attr-defined]  # typeshed does not have it
from pathlib import Path
from typing import Any

from backend.compute.memory import keep_freed_memory

# Elsewhere a system's own libraries may fail in what was forked.
METHOD = "forkserver" if sys.platform == "linux" else "spawn"
WARM_UP = 120.0  # a new process may take to import and warm up, on a busy machine [s]
_STATM = Path("/proc/self/statm")


class WorkerDiedError(Exception):
    """The process has ended before it answered."""


@dataclass(frozen=True, slots=True)
class Answer:
    """The value or error of a task, and the process's resident memory afterwards [bytes]; 0 outside Linux."""

    value: Any
    error: Exception | None
    memory: int


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
    """A process that warms up before its first task.

    While it has no task, its `pipe` is readable only where it has died, which the system may tell later.

    A fork server's child shares what that has warmed and is there at once; the first one waits for the server.

    Args:
        warm_up: Name of a module whose import warms up.
        nice: How far behind other processes it stands (0 to 19).
    """

    def __init__(self, warm_up: str, nice: int) -> None:
        context = _context(warm_up)
        self.pipe, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, warm_up, nice), daemon=True)
        with _interrupts_blocked():
            self._process.start()
        theirs.close()
        self._waiting = ThreadPoolExecutor(1, thread_name_prefix="worker")  # for its answer

    @property
    def active(self) -> bool:
        """Check whether it still accepts tasks."""
        return bool(self._process.is_alive())

    async def wait_until_warm(self) -> None:
        """Wait until it is warm.

        Raises:
            WorkerDiedError: It ended before.
            TimeoutError: It took too long.
        """
        async with asyncio.timeout(WARM_UP):
            await asyncio.get_running_loop().run_in_executor(self._waiting, self._exchange)

    def ask(self, function: Callable[..., Any], args: tuple[Any, ...]) -> asyncio.Future[Answer]:
        """Return what `function(*args)` gives there; it fails with WorkerDiedError where the process dies before."""
        # Takes the core, which the service imports beside its first worker.
        from backend.custom_controllers import registry as custom_controllers

        task = function, args, custom_controllers.controller_sources()
        return asyncio.get_running_loop().run_in_executor(self._waiting, self._exchange, task)

    def end(self) -> None:
        """End the process, whatever it does; takes some milliseconds."""
        self._process.kill()
        self._process.join()
        self._waiting.shutdown()
        self.pipe.close()

    def _exchange(self, task: tuple[Any, ...] | None = None) -> Any:
        """Send a task, perhaps, and return what comes."""
        message = pickle.dumps(task)
        try:
            if task is not None:
                self.pipe.send_bytes(message)
            answer = self.pipe.recv_bytes()
        except (EOFError, OSError):
            raise WorkerDiedError from None
        return pickle.loads(answer)  # noqa: S301 - our own process's


def _serve(pipe: Connection, warm_up: str, nice: int) -> None:
    """Do what comes through the pipe, in a new process, until nobody asks any more or the service ends, even killed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(nice)
    keep_freed_memory()
    threading.Thread(target=_follow_service, name="follow-service", daemon=True).start()
    import_module(warm_up)  # does nothing in what was forked from a process that has
    with contextlib.suppress(EOFError, OSError):
        pipe.send_bytes(pickle.dumps(None))
        while True:
            pipe.send_bytes(_answer(pipe.recv_bytes()))


def _follow_service() -> None:
    service = parent_process()
    if service is not None:
        service.join()
        os._exit(1)


def _answer(task: bytes) -> bytes:
    from backend.custom_controllers import registry as custom_controllers

    value, error = None, None
    try:
        function, args, controllers = pickle.loads(task)  # noqa: S301 - the service's
        custom_controllers.set_sources(controllers)
        value = function(*args)
    except Exception as failure:  # noqa: BLE001 - the service raises it
        error = ExceptionWithTraceback(failure, failure.__traceback__)
    try:
        return pickle.dumps(Answer(value, error, _resident_memory()))
    except Exception as failure:  # noqa: BLE001 - of what cannot be sent
        return pickle.dumps(Answer(None, RuntimeError(f"{failure!r}, sending {error or value!r}"), _resident_memory()))


def _resident_memory() -> int:
    try:
        return int(_STATM.read_text().split()[1]) * resource.getpagesize()
    except OSError:
        return 0
