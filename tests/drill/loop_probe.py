"""The service with a probe in its event loop: `python -m tests.drill.loop_probe` has `python -m backend`'s options.

It writes a line of JSON to the file EVENT_LOOP_PROBE for each callback that took more than LIMIT of its thread's
processor time, which a busy machine does not lengthen: the seconds, and where it was after half of the limit.
"""

import asyncio
import gc
import json
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable
from pathlib import Path

from backend.__main__ import main

LIMIT = 0.02  # [s]
FRAMES = 12  # the innermost calls that are written down


class Probe:
    """Measures what the event loop calls; a thread of its own looks where a long call is.

    Args:
        file: Where its lines go.
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._loop_thread = threading.get_ident()
        self._began: float | None = None  # of the callback that runs now [s]
        self._stack: list[str] = []
        self._call = asyncio.Handle._run
        asyncio.Handle._run = self._measure()  # type: ignore[method-assign, assignment]
        gc.callbacks.append(self._collect)
        threading.Thread(target=self._look, daemon=True).start()

    def _collect(self, phase: str, info: dict[str, int]) -> None:
        """Nobody can look while garbage is collected; only a whole collection takes long."""
        if phase == "stop" and info["generation"] == 2 and threading.get_ident() == self._loop_thread:
            self._stack = ["all garbage was collected"]

    def _measure(self) -> Callable[[asyncio.Handle], None]:
        def run(handle: asyncio.Handle) -> None:
            if threading.get_ident() != self._loop_thread:
                return self._call(handle)
            self._stack = []
            self._began = begin = time.thread_time()
            self._call(handle)
            took = time.thread_time() - begin
            self._began = None
            if took > LIMIT:
                with self._file.open("a") as lines:
                    lines.write(json.dumps({"seconds": took, "where": self._stack or [repr(handle)]}) + "\n")
            return None

        return run

    def _look(self) -> None:
        clock = time.pthread_getcpuclockid(self._loop_thread)
        while True:
            time.sleep(LIMIT / 8)
            began = self._began
            if began is not None and not self._stack and time.clock_gettime(clock) - began > LIMIT / 2:
                frames = traceback.extract_stack(sys._current_frames()[self._loop_thread])
                names = [f"{Path(frame.filename).name}:{frame.lineno} {frame.name}" for frame in frames]
                self._stack = [name for name in names if not name.startswith("<frozen importlib")][-FRAMES:]


if __name__ == "__main__":
    Probe(Path(os.environ["EVENT_LOOP_PROBE"]))
    sys.exit(main())
