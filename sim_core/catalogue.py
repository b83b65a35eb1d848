"""The only catalogue of signals, windows, statistics, stages and metrics: key, label, unit.

Everything that shows a number (tables, plots, CSV headers, API documentation) reads it from here.
Units are SI; a view may show others, and then converts itself.
"""

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that is named: `unit` is the SI unit, '1' for none; `symbol` as in docs/reference/nomenclature.md.

    Of those in LIMITS_EXCEEDED, `notable` is the value [unit] from which on a warning is shown.
    """

    key: str
    label: str
    unit: str
    description: str = ""
    _: KW_ONLY
    symbol: str = ""
    notable: float = 0.0


def _catalogue(*items: Entry) -> dict[str, Entry]:
    return {item.key: item for item in items}


# Time histories a run returns, in this order.
SIGNALS = _catalogue(
    Entry("time", "Time", "s", "0 when the front axle passes x = 0", symbol="t"),
    Entry("position", "Distance", "m", "travelled by the front axle", symbol="x"),
    Entry("speed", "Speed", "m/s", symbol="v"),
    Entry("front_road", "Road, front axle", "m", symbol="z_r1"),
    Entry("rear_road", "Road, rear axle", "m", symbol="z_r2"),
    Entry("brake_pressure", "Brake pressure", "Pa", symbol="P_c"),
    Entry("brake_deceleration", "Braking deceleration", "m/s^2", symbol="a_brake"),
    Entry("body_acceleration", "Body acceleration", "m/s^2", "up positive", symbol="z̈_b"),
    Entry("pitch_acceleration", "Pitch acceleration", "rad/s^2", "nose-down positive", symbol="θ̈"),
    Entry("front_tyre_load", "Front tyre dynamic load", "N", "pressed harder positive", symbol="F_t1"),
    Entry("rear_tyre_load", "Rear tyre dynamic load", "N", "pressed harder positive", symbol="F_t2"),
    Entry("front_deflection", "Front suspension deflection", "m", "z_b1 - z_w1, extension positive", symbol="d_1"),
    Entry("rear_deflection", "Rear suspension deflection", "m", "z_b2 - z_w2, extension positive", symbol="d_2"),
    Entry("front_force", "Front actuator force", "N", "lifts the body, presses the wheel down", symbol="u_1"),
    Entry("rear_force", "Rear actuator force", "N", "lifts the body, presses the wheel down", symbol="u_2"),
)

# SI unit -> the unit in which a person reads it, and the factor to that; other units are shown as they are.
SHOWN_UNITS = {"m": ("mm", 1000.0), "m/s": ("km/h", 3.6), "Pa": ("MPa", 1e-6), "N": ("kN", 1e-3)}

# Those that a suspension changes: they get an RMS and a peak in each window.
METRIC_SIGNALS = tuple(SIGNALS)[7:]

# The four the paper's tables compare.
PAPER_SIGNALS = METRIC_SIGNALS[:4]

WINDOWS = _catalogue(
    Entry("rough_road", "Rough road", "1", "front axle from x = 0 to the bump"),
    Entry("bump", "Bump", "1", "front axle on the bump until the rear axle has left it"),
    Entry("whole", "Whole run", "1", "x = 0 to the end of the road"),
)

STATISTICS = _catalogue(
    Entry("rms", "RMS", "1", "root mean square over the window's time"),
    Entry("peak", "Peak", "1", "largest magnitude in the window"),
)

ROUGH_ROAD, BUMP, WHOLE = WINDOWS
RMS, PEAK = STATISTICS
# What of PAPER_SIGNALS: RMS on the rough road (Tables 4, 7, 9), peaks on the bump (Tables 5, 8, 10).
PAPER_VIEWS = ((ROUGH_ROAD, RMS), (BUMP, PEAK))

STAGES = _catalogue(
    Entry("cruise", "Cruise", "1"),
    Entry("brake", "Brake", "1", "from detection to the bump"),
    Entry("bump", "Bump", "1", "front axle from the bump's start until the rear axle has left it"),
)

COMFORT = _catalogue(
    Entry("weighted_rms", "Weighted RMS (ISO 2631-1 Wk)", "m/s^2", symbol="a_w"),
    Entry("vibration_dose", "Vibration dose value (Wk)", "m/s^1.75", symbol="VDV"),
    Entry(
        "front_dynamic_load_coefficient",
        "Front dynamic load coefficient",
        "1",
        "RMS on the rough road over static load",
    ),
    Entry(
        "rear_dynamic_load_coefficient", "Rear dynamic load coefficient", "1", "RMS on the rough road over static load"
    ),
    Entry("actuator_mean_power", "Actuator power, mean magnitude", "W", "mean of |u·ḋ| summed over both axles"),
    Entry("actuator_peak_power", "Actuator power, peak", "W", "largest |u·ḋ| summed over both axles"),
)

EVENTS = _catalogue(
    Entry(
        "airborne_ms",
        "Airborne",
        "ms",
        "time either tyre is off the road, or would have to pull on it where it cannot lift off",
        notable=1.0,
    ),
    Entry("front_airborne_ms", "Front tyre airborne", "ms"),
    Entry("rear_airborne_ms", "Rear tyre airborne", "ms"),
    Entry(
        "stop_contact_ms",
        "Bump stop in contact",
        "ms",
        "time either suspension is deflected beyond its bump stops' clearance; 0 without bump stops",
        notable=1.0,
    ),
    Entry(
        "target_reached",
        "Target speed reached",
        "1",
        "within the target band at the bump, or nothing to brake for; null without a target",
    ),
    Entry(
        "bump_complete",
        "Bump crossed completely",
        "1",
        "false where the road ends before the rear axle has left the bump: its peaks are then up to there",
    ),
    Entry(
        "travel_exceeded_mm",
        "Travel over the limit, whole run",
        "mm",
        "largest deflection beyond mpc.deflection_limit anywhere, also while braking; 0 if held",
        notable=0.1,
    ),
    Entry(
        "limited_steps",
        "Steps with a limit active",
        "1",
        "control steps, run-in included, in which a limit of force, travel or actuator shaped the command",
    ),
    Entry("qp_solves", "QPs solved", "1", "run-in included"),
    Entry(
        "qp_fallbacks",
        "QP solver fallbacks",
        "1",
        "solved by the other solver: the first gave no verified solution, or is not asked again since both failed",
    ),
    Entry(
        "qp_failures",
        "QPs not solved",
        "1",
        "no solver that was asked gave a verified solution and the last safe force was held; of an ECU, its "
        "iterations ran out and the forces were clipped",
    ),
    Entry(
        "max_slack_mm", "Largest travel slack", "mm", "largest predicted deflection beyond the limit the MPC accepted"
    ),
    Entry("ecu_most_iterations", "ECU: most iterations", "1", "of its solver in one step; null without an ECU"),
    Entry(
        "ecu_clipped_values",
        "ECU: values beyond their range",
        "1",
        "measured or previewed values a converter clipped; null without an ECU",
    ),
    Entry(
        "ecu_held_commands",
        "ECU: commands without effect",
        "1",
        "lost, late or overtaken: the actuators held an earlier one; null without an ECU",
    ),
)

# Metrics of a whole run, beside those of its windows; the catalogue of the API has them as `run_figures`.
RUN_FIGURES = _catalogue(
    Entry("travel_time", "Travel time", "s", "front axle from x = 0 to the end of the road"),
    Entry("arrival_speed_kmh", "Speed at the bump", "km/h", "when the front axle reaches the bump"),
)

# Metrics that are 0 where a limit of the car holds.
LIMITS_EXCEEDED = ("events.travel_exceeded_mm", "events.airborne_ms")

_FLAGS = ("target_reached", "bump_complete")  # the events that are true or false


@dataclass(frozen=True, slots=True, kw_only=True)
class Metric:
    """One number of a strategy's result, or something true or false.

    Attributes:
        path: Where it stands in a result's summary.
        label: In words.
        unit: SI unit, `1` for none.
        flag: Whether it is true or false.
    """

    path: tuple[str, ...]
    label: str
    unit: str
    flag: bool = False

    @property
    def key(self) -> str:
        """Its flat name, as the columns of tables have it: `bump.body_acceleration.peak`."""
        return ".".join(self.path).removeprefix("metrics.")

    def of(self, summary: Mapping[str, Any]) -> Any:
        """Its value in a result's summary; None where that has none."""
        value: Any = summary
        for name in self.path:
            value = value.get(name) if isinstance(value, Mapping) else None
        return value


def metric_key(window: str, signal: str, statistic: str) -> str:
    """The flat name of one signal's statistic in one window."""
    return f"{window}.{signal}.{statistic}"


def _metrics() -> dict[str, Metric]:
    statistics = {RMS: "RMS", PEAK: "peak"}
    metrics = [
        Metric(
            path=("metrics", window.key, signal, statistic),
            label=f"{SIGNALS[signal].label}, {words}, {window.label.lower()}",
            unit=SIGNALS[signal].unit,
        )
        for window in WINDOWS.values()
        for signal in METRIC_SIGNALS
        for statistic, words in statistics.items()
    ]
    for part, items in ((("comfort",), COMFORT), (("events",), EVENTS), ((), RUN_FIGURES)):
        metrics += [
            Metric(path=(*part, key), label=item.label, unit=item.unit, flag=key in _FLAGS)
            for key, item in items.items()
        ]
    return {metric.key: metric for metric in metrics}


# Every number of a result by its flat name: the columns of tables, the figures of summaries, objectives and limits.
METRICS = _metrics()
NUMBERS = tuple(key for key, metric in METRICS.items() if not metric.flag)
PAPER_METRICS = tuple(
    metric_key(window, signal, statistic) for window, statistic in PAPER_VIEWS for signal in PAPER_SIGNALS
)

# Lines a plot draws beside the curves; values come with each result as `reference`.
REFERENCES = _catalogue(
    Entry("front_static_load", "Front static tyre load", "N"),
    Entry("rear_static_load", "Rear static tyre load", "N"),
    Entry("deflection_limit", "Suspension travel limit", "m"),
    Entry("force_limit", "Actuator force limit", "N"),
    Entry("target_speed", "Target speed", "m/s"),
    Entry("target_band", "Half width of the target band", "m/s"),
)
