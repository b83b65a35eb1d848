"""The process that runs a file of somebody's own.

It may print, exit, hang, crash or eat memory: whoever asked gets a `ControllerFileError` with the file's message and
line, and nothing else of the service notices.
"""

import ctypes
import inspect
import os
import pickle
import resource
import signal
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, TypeVar

from backend.stopwatch import Stopwatch
from sim_core import controller_files
from sim_core.controller_files import ControllerFileError, file_error, format_error
from sim_core.errors import ForceError, RidelabError

T = TypeVar("T")
MEMORY = 4 * 1024**3  # of address space, so that a controller that takes ever more is told so [bytes]
STARTING = 30.0  # Python and the core may take to be imported [s]
GRACE = 2.0  # beyond its limit: a controller that catches everything does not end by itself [s]
SHORTEST = 1e-3  # that a timer is set to; 0 would switch it off [s]
_MAIN = "import sys; from backend.custom_controllers.controller_process import main; main(sys.argv[1])"
_PARENT_DEATH_SIGNAL = 1  # prctl(2)


class SlowFileError(ControllerFileError):
    """It did not end within its time, which another time may be enough."""


class _OutOfTime(BaseException):
    """Nothing that a controller should catch."""


class ControllerProcess:
    """A process with one file loaded.

    Args:
        source: One of `sim_core.controller_files.sources`.
    """

    def __init__(self, source: str) -> None:
        self._name = Path(source).name
        self._process = subprocess.Popen(  # noqa: S603 - our own module, no shell
            [sys.executable, "-P", "-c", _MAIN, source],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            start_new_session=True,
        )
        assert self._process.stdin is not None  # noqa: S101 - both are pipes
        assert self._process.stdout is not None  # noqa: S101 - both are pipes
        self._tasks = Connection(os.dup(self._process.stdin.fileno()), readable=False)
        self._answers = Connection(os.dup(self._process.stdout.fileno()), writable=False)
        self._process.stdin.close()
        self._process.stdout.close()
        self._started = False

    def call(self, function: Callable[..., T], *args: Any, limit: float) -> T:
        """`function(*args)` in the process, which ends where it gives no answer.

        Args:
            function: Of a module.
            *args: Its arguments.
            limit: It may take so long [s], as a `Stopwatch` counts.

        Raises:
            SlowFileError: It did not end within that time.
            ControllerCodeError: The file's code failed, as it would on every machine.
            ControllerFileError: It failed otherwise, or ended its process.
            RidelabError: As the function raises.
        """
        try:
            if not self._started:
                self._receive(STARTING, f"its process did not start within {STARTING:g} s")
                self._started = True
            with suppress(BrokenPipeError):  # it has ended, which the answer says
                self._tasks.send_bytes(pickle.dumps((function, args, limit)))
            answer = self._receive(limit + GRACE, _unended(limit))
        except BaseException:  # also whoever calls this off
            self.close()
            raise
        if isinstance(answer, RidelabError):
            raise answer
        result: T = answer
        return result

    def _receive(self, limit: float, late: str) -> Any:
        stopwatch = Stopwatch(self._process.pid)
        try:
            while (left := limit - stopwatch.seconds) > 0:
                if self._answers.poll(left):
                    return pickle.loads(self._answers.recv_bytes())  # noqa: S301 - from a file that its operator trusts
        except (EOFError, OSError):
            raise ControllerFileError(f"{self._name}: {self._end()}") from None
        raise SlowFileError(f"{self._name}: {late}, and was ended")

    def _end(self) -> str:
        code = self._process.wait()
        how = f"by {signal.Signals(-code).name}" if code < 0 else f"with the code {code}"
        return f"it ended its process {how}"

    @property
    def alive(self) -> bool:
        """Check whether it can be asked again."""
        return not self._tasks.closed

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()
        self._tasks.close()
        self._answers.close()


def _unended(limit: float) -> str:
    return f"it did not end within {limit:g} s"


def main(source: str) -> None:
    """Load the file when the first task comes, then do what is asked until nobody asks any more."""
    tasks, answers = Connection(os.dup(0), writable=False), Connection(os.dup(1), readable=False)
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):  # what the file prints is no answer
        os.dup2(nowhere, stream)
    with suppress(OSError, AttributeError):  # not on Linux: there it ends with the pipe
        ctypes.CDLL(None).prctl(_PARENT_DEATH_SIGNAL, signal.SIGKILL)
    with suppress(ValueError, OSError):  # less is allowed already
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))
    os._exit = sys.exit  # type: ignore[assignment]  # with a traceback, so that its line can be told
    answers.send_bytes(pickle.dumps(None))
    with suppress(EOFError):
        while True:
            answers.send_bytes(_answer(source, tasks.recv_bytes()))


def _answer(source: str, task: bytes) -> bytes:
    """The pickled result of a task, or the error to raise in its place."""
    function, args, limit = pickle.loads(task)  # noqa: S301 - from our own service
    file = source
    stopwatch = Stopwatch(os.getpid())

    def stop(*_: object) -> None:
        if (left := limit - stopwatch.seconds) <= 0:
            raise _OutOfTime
        signal.setitimer(signal.ITIMER_REAL, max(left, SHORTEST))

    try:
        signal.signal(signal.SIGALRM, stop)
        signal.setitimer(signal.ITIMER_REAL, limit)
        try:
            controllers = controller_files.load(source)
            controller_files.set_controller_source(lambda: controllers)  # whatever becomes of the file meanwhile
            file = inspect.getfile(next(iter(controllers.values())))
            return pickle.dumps(function(*args))
        finally:
            signal.signal(signal.SIGALRM, signal.SIG_IGN)  # first: `stop` sets the timer again
            signal.setitimer(signal.ITIMER_REAL, 0)
    except BaseException as error:  # noqa: BLE001 - of anybody's code
        if isinstance(error, RidelabError) and not isinstance(error, ControllerFileError | ForceError):
            return pickle.dumps(error)
        folder = f"{Path(file).parent}{os.sep}"  # which is no business of whoever asked
        if isinstance(error, _OutOfTime):
            said = format_error(error, file).replace(_OutOfTime.__name__, _unended(limit))
            return pickle.dumps(SlowFileError(said.replace(folder, "")))
        failure = error if isinstance(error, ControllerFileError) else file_error(error, file)
        return pickle.dumps(type(failure)(failure.message.replace(folder, "")))
