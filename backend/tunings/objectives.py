"""What a run is worth: objectives and limits from the metrics of runs, road by road."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from backend.json_types import JsonObject, Summary
from backend.models import MetricName, RequestModel, inconsistent
from sim_core.catalogue import BUMP, METRICS, PAPER_SIGNALS, PEAK, RMS, SIGNALS, WHOLE, WINDOWS

# Kinds that are shares of the passive car's values: what to call each, its statistic, its window where none is named.
NORMALISED = {"paper": ("Eq. 16", RMS, WHOLE), "peaks": ("Eq. 16 with peaks", PEAK, BUMP)}
# The terms of Eq. 16 with the signals that make each: its one F is the load of both tyres.
_TERMS = (PAPER_SIGNALS[:1], PAPER_SIGNALS[1:2], PAPER_SIGNALS[2:])


class UndefinedObjectiveError(Exception):
    """An objective has no value; the message says why."""


Coefficient = Annotated[float, Field(ge=0, le=1000)]


class Objective(RequestModel):
    """What to make small, as its mean, or a quantile, over the training roads.

    `paper` is Eq. 16: q1 (a/a_p)² + q2 (r/r_p)² + q3 (F/F_p)² of the RMS of body and pitch acceleration and tyre load
    (both tyres) over the passive car's on the same road; `peaks` the same with peaks; `figure` one figure of a run.
    """

    kind: Literal["paper", "peaks", "figure"]
    q: Annotated[tuple[Coefficient, Coefficient, Coefficient], Field(strict=False)] = Field(
        (1, 1, 1), description="Of paper and peaks: q1 body acceleration, q2 pitch acceleration, q3 tyre load"
    )
    window: Literal[tuple(WINDOWS)] | None = Field(  # type: ignore[valid-type]  # from the core
        None, description="Of paper (without one whole) and peaks (bump)", json_schema_extra={"enum": [*WINDOWS, None]}
    )
    figure: MetricName | None = Field(None, description="Of figure: a name of a batch's columns")

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Self:
        if (self.figure is not None) != (self.kind == "figure"):
            raise inconsistent("figure", "A figure is named with the kind figure, and only there")
        if self.kind == "figure" and (self.window is not None or self.q != (1, 1, 1)):
            raise inconsistent("q" if self.window is None else "window", "Only the kinds paper and peaks take this")
        if not any(self.q):
            raise inconsistent("q", "At least one coefficient must be greater than 0")
        return self

    def stored(self) -> JsonObject:
        """Return it written out, as it is kept; of a metric `q` is not used."""
        window = None if self.figure is not None else self.window or NORMALISED[self.kind][2]
        return {"kind": self.kind, "q": list(self.q), "window": window, "figure": self.figure}

    @property
    def normalised(self) -> bool:
        """Check whether it is a share of the passive car's values."""
        return self.figure is None

    @property
    def label(self) -> str:
        """Return what to call it."""
        if self.figure is not None:
            return METRICS[self.figure].label
        q = "" if {*self.q} == {1} else f", q = {', '.join(f'{each:g}' for each in self.q)}"
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


class Limit(RequestModel):
    """A figure that may not be exceeded on any training road."""

    figure: MetricName
    at_most: float = Field(ge=-1e12, le=1e12)

    @property
    def label(self) -> str:
        """Return what to call it."""
        return METRICS[self.figure].label

    @property
    def unit(self) -> str:
        """Return its unit; `1` for none."""
        return METRICS[self.figure].unit
