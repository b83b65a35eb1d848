"""What a simulation returns: metrics always, time histories beside them."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario

_FORCES = ("front_force", "rear_force")
FORCE_TOLERANCE = 1e-6  # of the largest force: what changes by less does not jump


def no_columns(_: slice) -> Mapping[str, FloatArray]:
    """Return no columns: of time histories that are all there."""
    return {}


class Series(Mapping[str, FloatArray]):
    """Time histories, made when they are asked for: most runs are asked for their metrics alone.

    Args:
        shared: Signals as they are returned, all of one length.
        columns: Gives the others of some held commands, each with a row for every command (n, each + 1): its last
            sample is the value before the next command, which the histories leave out.
        each: Samples of a held command.
    """

    def __init__(
        self, shared: Mapping[str, FloatArray], columns: Callable[[slice], Mapping[str, FloatArray]], each: int = 1
    ) -> None:
        self._shared = shared
        self._make_columns = columns
        self._each = each
        self._length = len(shared["time"])

    @cached_property
    def _columns(self) -> Mapping[str, FloatArray]:
        return self._make_columns(slice(0, -(-self._length // self._each)))

    def __getitem__(self, key: str) -> FloatArray:
        """Return the history of a signal (samples,), put together anew each time: many long ones take much memory."""
        return self.between(key, 0, self._length)

    def between(self, key: str, start: int, end: int, dtype: type[np.floating[Any]] = np.float64) -> NDArray[Any]:
        """Return a signal's samples from `start` up to before `end`."""
        if key in self._shared:
            return np.asarray(self._shared[key][start:end], dtype)
        rows, each = self._columns[key], self._each
        first = start // each
        return rows[first : -(-end // each), :-1].astype(dtype).ravel()[start - first * each : end - first * each]

    def at(self, key: str, samples: NDArray[np.intp]) -> FloatArray:
        """Return a signal at these samples alone."""
        if key in self._shared:
            return self._shared[key][samples]
        return self._columns[key][np.divmod(samples, self._each)]

    @cached_property
    def jumps(self) -> NDArray[np.intp]:
        """Return the samples (jumps,) at which a held force jumps: no history has what it was just before."""
        if not (set(_FORCES) <= self._columns.keys()):
            return np.zeros(0, np.intp)
        samples = np.arange(self._each, self._length, self._each)
        jumped = np.zeros(len(samples), np.bool_)
        for key in _FORCES:
            rows = self._columns[key]
            change = np.abs(rows[1 : len(samples) + 1, 0] - rows[: len(samples), -1])
            jumped |= change > FORCE_TOLERANCE * np.abs(rows).max(initial=0.0)
        return samples[jumped]

    def with_jumps(self, key: str, start: int, end: int, dtype: type[np.floating[Any]] = np.float64) -> NDArray[Any]:
        """Return a signal's samples from `start` up to before `end`, those before jumps counted and among them.

        There are as many more than in the histories as there are `jumps`: two at each such instant, the values before
        and after it.
        """
        at = self.jumps + np.arange(len(self.jumps))  # of the samples before jumps
        first, last = np.searchsorted(at, [start, end]).tolist()
        jumps = self.jumps[first:last]
        values = self.between(key, start - first, end - last, dtype)
        shared = key in self._shared
        before = self._shared[key][jumps] if shared else self._columns[key][jumps // self._each - 1, -1]
        return np.insert(values, jumps - (start - first), before.astype(dtype))

    def of_commands(self, start: int, end: int) -> "Series":
        """Return the samples of the held commands to which those from `start` to before `end` belong, and no others."""
        first, last = start // self._each, -(-end // self._each)
        samples = slice(first * self._each, last * self._each)

        def columns(commands: slice) -> Mapping[str, FloatArray]:
            return self._make_columns(slice(first + commands.start, first + commands.stop))

        return Series({key: values[samples] for key, values in self._shared.items()}, columns, self._each)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return its histories, put together."""
        return type(self), ({key: self[key] for key in self}, no_columns)

    def columns(self, key: str) -> FloatArray:
        """Return a signal with its values at both ends of every held command (n, samples + 1).

        Raises:
            KeyError: It is none of those a suspension changes.
        """
        return self._columns[key]

    def __iter__(self) -> Iterator[str]:
        """Yield names in the catalogue's order."""
        return iter(SIGNALS)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(SIGNALS)


@dataclass(frozen=True, slots=True, kw_only=True)
class Span:
    """One driving stage, by the front axle: times [s] and positions [m] of its two ends."""

    stage: str
    start_time: float
    end_time: float
    start_position: float
    end_position: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingReport:
    """How a recording became a result (sim_core.recorded).

    Attributes:
        offset: Position of its distance 0 [m]; like the next three None where no place was found.
        scale: Metres of the road in a metre of its distance; where that follows from its time, also what a second of
            its clock lasts.
        likeness: Correlation coefficient with the simulated drive it was placed by.
        reference: That drive's strategy.
        samples: Of the recording, of each signal.
        start: Where on the road it begins [m].
        end: Where it ends [m].
        missing: Signals that it does not have.
        notes: All of this in words, and what may be wrong.
    """

    offset: float | None
    scale: float | None
    likeness: float | None
    reference: str | None
    samples: int
    start: float
    end: float
    missing: tuple[str, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StrategyResult:
    """One strategy's run over one scenario.

    Attributes:
        strategy: Strategy id.
        scenario: What was driven; of a recorded drive the scenario whose road it was placed on.
        metrics: Window -> signal -> statistic -> value in the signal's unit: `rough_road`, `bump` or `whole`; a signal
            from `body_acceleration` on; `rms` or `peak` (catalogue.WINDOWS, METRIC_SIGNALS, STATISTICS).
        comfort: Key -> value; keys and units are in catalogue.COMFORT.
        events: Key -> a count, a time, true or false, or None where it does not apply (catalogue.EVENTS).
        reference: Lines for plots, such as static loads: key -> value, None where it does not apply
            (catalogue.REFERENCES).
        stages: The driving stages in order, without gaps.
        travel_time: Front axle from x = 0 to the road's end [s].
        arrival_speed_kmh: Speed when the front axle meets the bump [km/h].
        series: Time histories: signal -> array (samples,), `time` ascending from 0; units are in catalogue.SIGNALS.
        recording: How a recording became this result, whose values may be NaN; None of a simulated one.
        label: What its controller is called; None of a recorded drive.

    Example:
        >>> from sim_core import Scenario, simulate
        >>> result = simulate(Scenario(), "lv")
        >>> [span.stage for span in result.stages]
        ['cruise', 'brake', 'bump', 'cruise']
        >>> peak = result.metrics["whole"]["front_tyre_load"]["peak"]  # [N]
        >>> bool(abs(result.series["front_tyre_load"]).max() <= peak)  # the metric also looks between samples
        True
    """

    strategy: str
    scenario: Scenario = field(repr=False)
    metrics: Mapping[str, Mapping[str, Mapping[str, float]]]
    comfort: Mapping[str, float]
    events: Mapping[str, float | bool | None]
    reference: Mapping[str, float | None]
    stages: tuple[Span, ...]
    travel_time: float
    arrival_speed_kmh: float
    series: Series
    recording: RecordingReport | None = None
    label: str | None = None

    def summary(self) -> dict[str, Any]:
        """Return everything but the series, the scenario, and the strategy's id and label, ready for JSON."""
        of_recording = {} if self.recording is None else {"recording": asdict(self.recording)}
        return {
            "metrics": self.metrics,
            "comfort": self.comfort,
            "events": self.events,
            "reference": self.reference,
            "stages": [asdict(span) for span in self.stages],
            "travel_time": self.travel_time,
            "arrival_speed_kmh": self.arrival_speed_kmh,
            **of_recording,
        }
