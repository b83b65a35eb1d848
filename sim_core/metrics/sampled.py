"""The sums from which metrics are computed, of signals sampled at any times: those of a recording.

Two samples at one instant are the values before and after a jump, as in result files of Modelica tools.

Mean squares are trapezoids of the squared samples: by Parseval's theorem, evenly spaced samples of a signal without
content above half the sampling rate have the signal's own power (Oppenheim & Schafer, Discrete-Time Signal Processing,
3rd ed., 2010, sections 2.9 and 4.2). Straight lines between the samples have less: at a frequency f the share
(2 + cos(2π f step)) / 3, which is 6 % less at a tenth of the sampling rate. Only where signals jump are accelerations
straight lines between samples, as in a simulated run, which alone writes jumps.
"""

from collections.abc import Mapping, Sequence
from functools import partial
from math import ceil, nan

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import lfilter

from sim_core.arrays import FloatArray
from sim_core.catalogue import METRIC_SIGNALS
from sim_core.errors import RefusedError
from sim_core.metrics.comfort import weighting
from sim_core.metrics.definition import Sums, mean_squares

WEIGHTED_STEP = 1e-3  # longest of the weighting [s]
# Of a sampling step: a section that ends so near to a sample ends there, as times of a file are rounded.
STEP_TOLERANCE = 0.1
EVEN = 0.25  # of the usual step: the most that a step between evenly spaced samples differs from it
AIRBORNE_SHARE = 1 - 1e-6  # of the static load: a tyre that lacks this much has none, as loads of a file are rounded

TimeSpan = tuple[float, float]  # first and last time [s]
_ROWS = {key: row for row, key in enumerate(METRIC_SIGNALS)}


def sampled_sums(
    signals: Mapping[str, FloatArray],
    sections: Sequence[TimeSpan | None],
    static: TimeSpan,
    clearances: tuple[TimeSpan, TimeSpan],
) -> Sums:
    """Return the sums of a recorded drive.

    Args:
        signals: By the catalogue's names (samples,), `time` [s] not descending; one that is missing is NaN throughout.
        sections: First and last time of the rough road, the bump and what follows it [s]; None for one that was not
            recorded.
        static: Load of both tyres at rest [N].
        clearances: From rest to the bump stops of both axles, in compression, then in rebound [m]; infinite without.

    Raises:
        RefusedError: All sections were recorded, with no sample between their two ends.

    Example:
        >>> import numpy as np
        >>> signals = {key: np.full(3, np.nan) for key in METRIC_SIGNALS}
        >>> signals |= {"time": np.array([0.0, 1.0, 2.0]), "front_force": np.array([0.0, 3.0, 0.0])}
        >>> stops = (0.1, 0.1), (0.1, 0.1)
        >>> sums = sampled_sums(signals, [(0.0, 1.0), (1.0, 2.0), (2.0, 2.0)], (1.0, 1.0), stops)
        >>> float(sums.squares[0, 6]), float(sums.peaks[1, 6])
        (4.5, 3.0)
    """
    time, table = signals["time"], np.array([signals[key] for key in METRIC_SIGNALS])
    spans = [None if span is None else (_snapped(time, span[0]), _snapped(time, span[1])) for span in sections]
    parts = [_in_section(time, table, span) for span in spans]
    whole = None if spans[0] is None or None in spans or spans[-1] is None else (spans[0][0], spans[-1][1])
    at, rows = np.zeros(2), np.full((len(table), 2), nan)  # of a drive that was not recorded as a whole
    weighted, step = np.full(1, nan), 1.0
    if whole is not None:
        at, rows = _clip_to_span(time, table, whole)
        weighted, step = _weighted(at, rows[_ROWS["body_acceleration"]])
    power = _power(at, rows)
    return Sums(
        time_unit=1.0,
        durations=[nan if span is None else span[1] - span[0] for span in spans],
        squares=np.array([squares for squares, _ in parts]),
        peaks=np.array([peaks for _, peaks in parts]),
        weighted_squares=float(np.sum(weighted**2)),
        weighted_fourths=float(np.sum(weighted**4)),
        weighted_samples=len(weighted),
        weighted_step=step,
        power=float(np.trapezoid(power, at)),
        peak_power=float(power.max()),
        **_airborne(at, rows, static),
        on_stops=_on_stops(at, rows, clearances),
    )


def _snapped(time: FloatArray, instant: float) -> float:
    """Return the sample's instant that is nearest to this one where it is near, else this one [s]."""
    after = time[np.clip(np.searchsorted(time, instant), 1, len(time) - 1)]
    before = time[max(0, int(np.searchsorted(time, instant, "right")) - 1)]
    nearest = float(before if instant - before < after - instant else after)
    return nearest if abs(nearest - instant) <= STEP_TOLERANCE * (after - before) else instant


def _clip_to_span(time: FloatArray, rows: FloatArray, span: TimeSpan) -> tuple[FloatArray, FloatArray]:
    """Return the samples of a span and its two ends (n,) [s], with the signals there (signals, n).

    Where a signal jumps at an end, the value that lies within the span counts.
    """
    first = int(np.clip(np.searchsorted(time, span[0], "right") - 1, 0, len(time) - 2))
    last = int(np.clip(np.searchsorted(time, span[1], "left"), first + 1, len(time) - 1))
    at = np.concatenate([[span[0]], time[first + 1 : last], [span[1]]])
    begin, end = (
        _interpolate(time, rows, sample, instant) for sample, instant in ((first, span[0]), (last - 1, span[1]))
    )
    return at, np.column_stack([begin, rows[:, first + 1 : last], end])


def _interpolate(time: FloatArray, rows: FloatArray, sample: int, instant: float) -> FloatArray:
    """Return the signals at an instant between a sample and the next one (signals,)."""
    step = time[sample + 1] - time[sample]
    share = float(np.clip((instant - time[sample]) / step, 0.0, 1.0)) if step > 0 else 0.0
    a, b = rows[:, sample], rows[:, sample + 1]
    there: FloatArray = a if share == 0 else b if share == 1 else (1 - share) * a + share * b
    return there


def _in_section(time: FloatArray, table: FloatArray, span: TimeSpan | None) -> tuple[FloatArray, FloatArray]:
    """Return the integrals of METRIC_SIGNALS' squares, and their peaks (8,); of no time both are 0."""
    if span is None:
        return np.full(len(table), nan), np.full(len(table), nan)
    if span[1] <= span[0]:
        return np.zeros(len(table)), np.zeros(len(table))
    at, values = _clip_to_span(time, table, span)
    steps = np.diff(at)
    a, b = values[:, :-1], values[:, 1:]
    means = mean_squares(a, b) if (steps == 0).any() else (a * a + b * b) / 2
    return means @ steps, np.abs(values).max(axis=1)


def _power(time: FloatArray, rows: FloatArray) -> FloatArray:
    """Return both actuators' |u·ḋ| together (n,) [W]."""
    deflections, forces = (
        rows[[_ROWS[f"{axle}_{kind}"] for axle in ("front", "rear")]] for kind in ("deflection", "force")
    )
    speeds = np.array([_derivative(each, time) for each in deflections])
    return np.asarray(np.abs(forces * speeds).sum(axis=0))


def _derivative(values: FloatArray, time: FloatArray) -> FloatArray:
    """Return the rate of change (n,), from one side alone at both ends and where two samples stand at one instant."""
    rate = np.zeros_like(values)
    for part in np.split(np.arange(len(time)), 1 + np.flatnonzero(np.diff(time) == 0)):
        if len(part) > 1:
            rate[part] = np.gradient(values[part], time[part], edge_order=2 if len(part) > 2 else 1)
    return rate


def _airborne(time: FloatArray, rows: FloatArray, static: TimeSpan) -> dict[str, float]:
    """Return for how long any tyre, the front and the rear one was without the load that it has at rest [s]."""
    names = "airborne", "front_airborne", "rear_airborne"
    loads = rows[[_ROWS["front_tyre_load"], _ROWS["rear_tyre_load"]]]
    off = np.where(np.isnan(loads), nan, loads <= -AIRBORNE_SHARE * np.array(static)[:, None])
    return {name: float(np.trapezoid(each, time)) for name, each in zip(names, (off.max(axis=0), *off), strict=True)}


def _on_stops(time: FloatArray, rows: FloatArray, clearances: tuple[TimeSpan, TimeSpan]) -> float:
    """Return for how long either suspension was beyond the clearance of its bump stops [s]."""
    down, up = np.array(clearances)[:, :, None]
    if np.isinf(down).all():
        return 0.0
    deflections = rows[[_ROWS["front_deflection"], _ROWS["rear_deflection"]]]
    beyond = np.where(np.isnan(deflections), nan, (deflections < -down) | (deflections > up))
    return float(np.trapezoid(beyond.max(axis=0), time))


def _weighted(time: FloatArray, acceleration: FloatArray) -> tuple[FloatArray, float]:
    """Return the acceleration through Wk (n,) [m/s^2], and the step between its samples [s].

    The mean is subtracted first: Wk passes nothing at 0 Hz, but a filter that starts from rest would ring with gravity
    or an offset in the signal.

    Evenly spaced samples that are coarser than the filter's step are joined by a cubic spline, others by lines: at a
    tenth of the sampling rate lines lack 3 % of an oscillation, the spline 0.02 % (Unser, Splines: a perfect fit for
    signal and image processing, IEEE Signal Processing Magazine 16(6), 1999).
    """
    duration = time[-1] - time[0]
    values, usual = acceleration - np.trapezoid(acceleration, time) / duration, _usual_step(time)
    step = usual / ceil(usual / WEIGHTED_STEP - STEP_TOLERANCE)
    inner = np.diff(time)[1:-1]
    even = len(inner) > 1 and bool((np.abs(inner - usual) < EVEN * usual).all())  # but for the rounding of times
    smooth = step < usual and even and np.isfinite(values).all()
    between = CubicSpline(time, values) if smooth else partial(np.interp, xp=time, fp=values)
    count = int(duration / step + STEP_TOLERANCE)
    middle = time[0] + step * (np.arange(count) + 0.5)
    # A line through two places within each step: a jump at its end stays out of it.
    early, late = (between(middle + share * step) for share in (-0.25, 0.25))
    begin, end = 1.5 * early - 0.5 * late, 1.5 * late - 0.5 * early
    parts = weighting(step).reshape(3, 2, -1)  # onward, begin and end, each real and imaginary, of every mode
    total = np.zeros(count + 1)
    for turn, first, last in zip(*(parts[:, 0] + 1j * parts[:, 1]), strict=True):
        driven = np.concatenate([[0.0], first * begin + last * end])
        total += 2 * lfilter([1.0], [1.0, -turn], driven).real
    return total, step


def _usual_step(time: FloatArray) -> float:
    """Return the usual step between samples [s]: the mean where all are alike, as a file rounds single ones.

    Raises:
        RefusedError: There is no sample between the first and the last instant.
    """
    steps = np.diff(time)
    steps = steps[steps > 0][:-1]  # the last one ends with the road, not with a sample
    if not len(steps):
        raise RefusedError("The recording has too few samples on this road")
    usual, mean = float(np.median(steps)), float(np.mean(steps))
    return mean if abs(mean - usual) < STEP_TOLERANCE * usual else usual
