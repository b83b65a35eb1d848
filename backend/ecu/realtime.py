"""The drive in real time: a frame every control step; an answer after the next frame is late.

The plant is simulated at the same pace; an ordinary operating system wakes both sides, so the figures are this
machine's at this moment, not a control unit's.
"""

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

import numpy as np

from backend.cost import affordable
from backend.ecu.build import EcuError
from backend.ecu.link import ProcessEcu, connected
from backend.ecu.models import ChangesByWindow, RealtimeReport, Times
from backend.errors import EcuUnavailableError
from sim_core import Scenario, StrategyResult, simulate
from sim_core.catalogue import PAPER_SIGNALS, PAPER_VIEWS
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.interface import Ecu, Frame, Reply
from sim_core.strategies.lv_hil import LvHil

LONGEST = 60.0  # a drive may take [s]
BINS = 40


@dataclass(slots=True)
class Timing:
    """Per control step [s]: from frame to answer, the wake-up's delay, the program's own time; and the misses."""

    latency: list[float] = field(default_factory=list)
    lateness: list[float] = field(default_factory=list)
    computing_ns: list[int] = field(default_factory=list)
    misses: int = 0


class PacedEcu(Ecu):
    """Sends each frame at its time and waits for the answer until the next frame."""

    def __init__(self, link: ProcessEcu, step: float, timing: Timing) -> None:
        self._link = link
        self._step = step
        self._timing = timing
        self._begin = time.monotonic() + step

    def exchange(self, frame: Frame) -> Reply | None:
        """The answer, or None where the deadline passed."""
        due = self._begin + frame.step * self._step
        time.sleep(max(due - time.monotonic(), 0.0))
        sent = time.monotonic()
        self._timing.lateness.append(sent - due)
        self._link.send(frame)
        deadline = due + self._step
        while (answer := self._link.receive(deadline)) is not None:
            now, (step, reply) = time.monotonic(), answer
            if now > deadline:  # it may have lain there while this side was not woken
                break
            if step == frame.step:
                self._timing.latency.append(now - sent)
                return reply  # an earlier one came too late, and is of no use any more
        self._timing.misses += 1
        return None


def drive_by_clock(scenario: Scenario) -> RealtimeReport:
    """Drive once in real time and once in lock-step; takes as long as the drive.

    Raises:
        EcuUnavailableError: The program cannot take part.
        RidelabError: As `simulate` raises.
    """
    timing = Timing()

    @contextmanager
    def paced(calibration: Calibration) -> Iterator[Ecu]:
        with connected(calibration) as link:
            yield PacedEcu(link, scenario.mpc.sample_time, timing)
            timing.computing_ns = link.computing_ns

    lock_step = affordable.simulate(scenario, "lv_hil")
    try:
        measured = simulate(scenario, LvHil(connect=paced))
    except EcuError as error:
        raise EcuUnavailableError(str(error)) from None
    return RealtimeReport(
        steps=len(timing.lateness),
        deadline=scenario.mpc.sample_time,
        misses=timing.misses,
        latency=spread(timing.latency, scenario.mpc.sample_time),
        wake_up=spread(timing.lateness, scenario.mpc.sample_time),
        computing=spread([value * 1e-9 for value in timing.computing_ns], scenario.mpc.sample_time),
        changes=changes(measured, lock_step),
    )


def spread(values: Sequence[float], longest: float) -> Times | None:
    """Mean, deviation, percentiles and a histogram of times [s]; bins grow evenly in ratio from 1 µs to twice that.

    A time outside is counted in the first or the last bin.
    """
    if not values:
        return None
    times = np.asarray(values)
    edges = np.geomspace(1e-6, 2 * longest, BINS + 1)
    counts, _ = np.histogram(np.clip(times, edges[0], edges[-1]), edges)
    middle, most = np.percentile(times, [50, 99])
    return Times(
        mean=float(times.mean()),
        deviation=float(times.std()),
        median=float(middle),
        percentile_99=float(most),
        most=float(times.max()),
        edges=edges.tolist(),
        counts=counts.tolist(),
    )


def changes(result: StrategyResult, base: StrategyResult) -> ChangesByWindow:
    """Change of Tables 9 and 10's eight figures against a base, by window and signal [%]; None against zero."""

    def change(window: str, signal: str, statistic: str) -> float | None:
        new, old = (each.metrics[window][signal][statistic] for each in (result, base))
        return (new / old - 1) * 100 if old else None

    return {
        window: {signal: change(window, signal, statistic) for signal in PAPER_SIGNALS}
        for window, statistic in PAPER_VIEWS
    }
