"""The metrics of signals that were sampled at any times: those of a recording, by the rules of a simulated run's.

Windows, trapezoids, the squares of accelerations, Wk and the comfort metrics are those of `sim_core.metrics.evaluate`.
A metric whose signal is missing, or was not recorded throughout its window, is NaN.
"""

from collections.abc import Mapping
from math import ceil, nan

import numpy as np
from scipy.signal import lfilter

from sim_core.arrays import FloatArray
from sim_core.catalogue import COMFORT, METRIC_SIGNALS
from sim_core.metrics.comfort import weighting
from sim_core.metrics.evaluate import mean_squares

WEIGHTED_STEP = 1e-3  # longest of the weighting [s]: between samples a signal is straight
Span = tuple[float, float]  # first and last time [s]


def window_metrics(
    signals: Mapping[str, FloatArray], windows: Mapping[str, Span | None]
) -> dict[str, dict[str, dict[str, float]]]:
    """RMS and peak of METRIC_SIGNALS in each window.

    Args:
        signals: By the catalogue's names (samples,), `time` [s] ascending; one that is missing is NaN throughout.
        windows: By name the first and last time [s]; None for one that was not recorded.

    Example:
        >>> import numpy as np
        >>> signals = {key: np.full(3, np.nan) for key in METRIC_SIGNALS}
        >>> signals |= {"time": np.array([0.0, 1.0, 2.0]), "front_force": np.array([0.0, 3.0, 0.0])}
        >>> window_metrics(signals, {"whole": (0.0, 2.0)})["whole"]["front_force"]["peak"]
        3.0
    """
    none = {key: {"rms": nan, "peak": nan} for key in METRIC_SIGNALS}
    return {name: none if span is None else _in_window(signals, span) for name, span in windows.items()}


def _in_window(signals: Mapping[str, FloatArray], span: Span) -> dict[str, dict[str, float]]:
    time, table = _between(signals, METRIC_SIGNALS, span)
    steps = np.diff(time)
    rms = np.sqrt(mean_squares(table[:, :-1], table[:, 1:]) @ steps / steps.sum())
    peaks = np.abs(table).max(axis=1)
    return {
        key: {"rms": one, "peak": highest}
        for key, one, highest in zip(METRIC_SIGNALS, rms.tolist(), peaks.tolist(), strict=True)
    }


def comfort_metrics(
    signals: Mapping[str, FloatArray], span: Span | None, rough: Mapping[str, Mapping[str, float]], static: Span
) -> dict[str, float]:
    """The metrics of comfort (catalogue.COMFORT).

    Args:
        signals: As of `window_metrics`.
        span: First and last time of the whole run [s]; None where not all of it was recorded.
        rough: The metrics of the rough road.
        static: Load of both tyres at rest [N].
    """
    if span is None:
        return dict.fromkeys(COMFORT, nan)
    weighted, step = _weighted(signals, span)
    time, (front, rear, front_force, rear_force) = _between(
        signals, ("front_deflection", "rear_deflection", "front_force", "rear_force"), span
    )
    power = np.abs(front_force * np.gradient(front, time)) + np.abs(rear_force * np.gradient(rear, time))
    return {
        "weighted_rms": float(np.sqrt(np.mean(weighted**2))),
        "vibration_dose": float((np.sum(weighted**4) * step) ** 0.25),  # (∫ a_w⁴ dt)^¼ (ISO 2631-1, 6.3.2)
        "front_dynamic_load_coefficient": rough["front_tyre_load"]["rms"] / static[0],
        "rear_dynamic_load_coefficient": rough["rear_tyre_load"]["rms"] / static[1],
        "actuator_mean_power": float(np.trapezoid(power, time) / (span[1] - span[0])),
        "actuator_peak_power": float(power.max()),
    }


def airborne_ms(signals: Mapping[str, FloatArray], span: Span | None, static: Span) -> dict[str, float]:
    """Time with either tyre, the front and the rear one off the road [ms]: without the load that it has at rest."""
    keys = "airborne_ms", "front_airborne_ms", "rear_airborne_ms"
    if span is None:
        return dict.fromkeys(keys, nan)
    time, loads = _between(signals, ("front_tyre_load", "rear_tyre_load"), span)
    off = np.where(np.isnan(loads), nan, loads <= -np.array(static)[:, None])
    return {
        key: 1000 * float(np.trapezoid(each, time)) for key, each in zip(keys, (off.max(axis=0), *off), strict=True)
    }


def stop_contact_ms(signals: Mapping[str, FloatArray], span: Span | None, clearance: float | None) -> float:
    """Time with either suspension beyond the clearance [m] of its bump stops [ms], None where it has none."""
    if clearance is None:
        return 0.0
    if span is None:
        return nan
    time, deflections = _between(signals, ("front_deflection", "rear_deflection"), span)
    beyond = np.where(np.isnan(deflections), nan, np.abs(deflections) > clearance)
    return 1000 * float(np.trapezoid(beyond.max(axis=0), time))


def _between(signals: Mapping[str, FloatArray], keys: tuple[str, ...], span: Span) -> tuple[FloatArray, FloatArray]:
    """The times of a span with both ends (n,) [s], and those signals there (signals, n)."""
    time = signals["time"]
    inside = time[(time > span[0]) & (time < span[1])]
    at = np.concatenate([[span[0]], inside, [span[1]]])
    return at, np.array([np.interp(at, time, signals[key]) for key in keys])


def _weighted(signals: Mapping[str, FloatArray], span: Span) -> tuple[FloatArray, float]:
    """The acceleration through Wk (n,) [m/s^2], and the step between its samples [s]."""
    time, acceleration = signals["time"], signals["body_acceleration"]
    steps = ceil((span[1] - span[0]) / min(WEIGHTED_STEP, float(np.median(np.diff(time)))))
    step = (span[1] - span[0]) / steps
    even = np.interp(span[0] + step * np.arange(steps + 1), time, acceleration)
    parts = weighting(step).reshape(3, 2, -1)  # onward, begin and end, each real and imaginary, of every mode
    onward, begin, end = parts[:, 0] + 1j * parts[:, 1]
    total = np.zeros(steps + 1)
    for turn, first, last in zip(onward, begin, end, strict=True):
        driven = np.concatenate([[0.0], first * even[:-1] + last * even[1:]])
        total += 2 * lfilter([1.0], [1.0, -turn], driven).real
    return total, step
