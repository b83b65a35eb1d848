"""What counts against a time limit: not the processor time that others take."""

import os
import subprocess
import sys
import time

import pytest

from backend.stopwatch import Stopwatch

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="only Linux counts what a process waits")
BUSY = "while True: pass"


def test_waiting_for_a_processor_does_not_count_and_sleeping_does() -> None:
    core = {min(os.sched_getaffinity(0))}
    programs = [subprocess.Popen([sys.executable, "-c", each]) for each in (BUSY, BUSY, "import time; time.sleep(60)")]
    try:
        for each in programs:
            os.sched_setaffinity(each.pid, core)
        begin, stopwatches = time.monotonic(), [Stopwatch(each.pid) for each in programs]
        time.sleep(1.5)
        busy, other, asleep = (each.seconds for each in stopwatches)
        passed = time.monotonic() - begin
    finally:
        for each in programs:
            each.kill()
            each.wait()
    assert busy + other < 1.3 * passed, "two share a core, which each of them had half of the time"
    assert asleep > 0.5 * passed
