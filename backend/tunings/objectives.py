"""What a run is worth: objectives and limits from the metrics of runs, road by road."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from backend.json_types import Summary
from sim_core.catalogue import BUMP, METRICS, PAPER_SIGNALS, PEAK, RMS, SIGNALS, WHOLE, WINDOWS

# Kinds that are shares of the passive car's values: what to call each, its statistic, its window where none is named.
NORMALISED = {"paper": ("Eq. 16", RMS, WHOLE), "peaks": ("Eq. 16 with peaks", PEAK, BUMP)}
# The terms of Eq. 16 with the signals that make each: its one F is the load of both tyres.
_TERMS = (PAPER_SIGNALS[:1], PAPER_SIGNALS[1:2], PAPER_SIGNALS[2:])


class UndefinedObjectiveError(Exception):
    """An objective has no value; the message says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredObjective:
    """What is minimised, written out.

    Attributes:
        kind: Eq. 16 of RMS values, of peaks, or one metric.
        q: Coefficients of Eq. 16's terms.
        window: Of Eq. 16; None of a metric.
        figure: The metric's key; None of Eq. 16.
    """

    kind: Literal["paper", "peaks", "figure"]
    q: Sequence[float]
    window: str | None
    figure: str | None

    @property
    def normalised(self) -> bool:
        """Check whether it is a share of the passive car's values."""
        return self.figure is None

    @property
    def label(self) -> str:
        """Return what to call it."""
        if self.figure is not None:
            return METRICS[self.figure].label
        q = "" if tuple(self.q) == (1, 1, 1) else f", q = {', '.join(f'{each:g}' for each in self.q)}"
        return f"{NORMALISED[self.kind][0]}, {WINDOWS[self.window or WHOLE].label.lower()}{q}"

    @property
    def unit(self) -> str:
        """Return its unit; `1` for none."""
        return "1" if self.figure is None else METRICS[self.figure].unit

    def value(self, run: Summary, passive: Summary) -> float:
        """Return its value on one road; Eq. 16 is Σ q_i (X_i / X_i,passive)², X_i the RMS (or peak) of a term.

        Args:
            run: The run on that road.
            passive: The passive car's; not read where nothing is normalised by it.

        Raises:
            UndefinedObjectiveError: The passive car's value is zero.
        """
        if self.figure is not None:
            return float(METRICS[self.figure].of(run))
        _, statistic, window = NORMALISED[self.kind]
        window, total = self.window or window, 0.0
        for coefficient, signals in zip(self.q, _TERMS, strict=True):
            if not coefficient:
                continue
            ours, theirs = (
                sum(float(each["metrics"][window][signal][statistic]) ** 2 for signal in signals)
                for each in (run, passive)
            )
            if theirs == 0:
                raise UndefinedObjectiveError(
                    f"The passive car's {SIGNALS[signals[0]].label.lower()} is zero "
                    f"({WINDOWS[window].label.lower()}): nothing can be a share of it"
                )
            total += coefficient * ours / theirs
        return total


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredLimit:
    """What one metric (its key) may be at most, in its SI unit."""

    figure: str
    at_most: float

    @property
    def label(self) -> str:
        """Return what to call it."""
        return METRICS[self.figure].label

    @property
    def unit(self) -> str:
        """Return its unit; `1` for none."""
        return METRICS[self.figure].unit
