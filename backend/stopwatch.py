"""How long a process takes, apart from what it waits for a processor that others have."""

import time
from contextlib import suppress
from pathlib import Path


class Stopwatch:
    """Counts the seconds since it was made, on Linux without those that the process waited for a processor.

    A process that computes or sleeps takes time, one that a busy machine keeps from computing does not.

    Args:
        pid: Of the process.
    """

    def __init__(self, pid: int) -> None:
        self._statistics = Path(f"/proc/{pid}/schedstat")
        self._waited = 0.0
        self._begin = self._now()

    @property
    def seconds(self) -> float:
        """Since it began [s]."""
        return self._now() - self._begin

    def _now(self) -> float:
        with suppress(OSError):  # no Linux, or the process has ended
            self._waited = int(self._statistics.read_text().split()[1]) / 1e9
        return time.monotonic() - self._waited
