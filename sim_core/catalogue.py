"""The only catalogue of signals, windows, statistics, stages and metrics: key, label, unit.

Everything that shows a number (tables, plots, CSV headers, API documentation) reads it from here.
Units are SI; a view may show others, and then converts itself.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """One named quantity: `unit` is the SI unit, '1' for none; `symbol` as in docs/nomenclature.md.

    From `notable` on [unit] it is worth a warning, where it is one that warns.
    """

    key: str
    label: str
    unit: str
    symbol: str = ""
    description: str = ""
    notable: float = 0.0


def _catalogue(*items: Quantity) -> dict[str, Quantity]:
    return {item.key: item for item in items}


# Time histories a run returns, in this order.
SIGNALS = _catalogue(
    Quantity(key="time", label="Time", unit="s", symbol="t", description="0 when the front axle passes x = 0"),
    Quantity(key="position", label="Distance", unit="m", symbol="x", description="travelled by the front axle"),
    Quantity(key="speed", label="Speed", unit="m/s", symbol="v"),
    Quantity(key="front_road", label="Road, front axle", unit="m", symbol="z_r1"),
    Quantity(key="rear_road", label="Road, rear axle", unit="m", symbol="z_r2"),
    Quantity(key="brake_pressure", label="Brake pressure", unit="Pa", symbol="P_c"),
    Quantity(key="brake_deceleration", label="Braking deceleration", unit="m/s^2", symbol="a_brake"),
    Quantity(key="body_acceleration", label="Body acceleration", unit="m/s^2", symbol="z̈_b", description="up positive"),
    Quantity(
        key="pitch_acceleration",
        label="Pitch acceleration",
        unit="rad/s^2",
        symbol="θ̈",
        description="nose-down positive",
    ),
    Quantity(
        key="front_tyre_load",
        label="Front tyre dynamic load",
        unit="N",
        symbol="F_t1",
        description="pressed harder positive",
    ),
    Quantity(
        key="rear_tyre_load",
        label="Rear tyre dynamic load",
        unit="N",
        symbol="F_t2",
        description="pressed harder positive",
    ),
    Quantity(
        key="front_deflection",
        label="Front suspension deflection",
        unit="m",
        symbol="d_1",
        description="z_b1 - z_w1, extension positive",
    ),
    Quantity(
        key="rear_deflection",
        label="Rear suspension deflection",
        unit="m",
        symbol="d_2",
        description="z_b2 - z_w2, extension positive",
    ),
    Quantity(
        key="front_force",
        label="Front actuator force",
        unit="N",
        symbol="u_1",
        description="lifts the body, presses the wheel down",
    ),
    Quantity(
        key="rear_force",
        label="Rear actuator force",
        unit="N",
        symbol="u_2",
        description="lifts the body, presses the wheel down",
    ),
)

# Signals that get an RMS and a peak in each window.
METRIC_SIGNALS = (
    "body_acceleration",
    "pitch_acceleration",
    "front_tyre_load",
    "rear_tyre_load",
    "front_deflection",
    "rear_deflection",
    "front_force",
    "rear_force",
)

# The four the paper's tables compare.
PAPER_SIGNALS = METRIC_SIGNALS[:4]

WINDOWS = _catalogue(
    Quantity(key="rough_road", label="Rough road", unit="1", description="front axle from x = 0 to the bump"),
    Quantity(key="bump", label="Bump", unit="1", description="front axle on the bump until the rear axle has left it"),
    Quantity(key="whole", label="Whole run", unit="1", description="x = 0 to the end of the road"),
)

STATISTICS = _catalogue(
    Quantity(key="rms", label="RMS", unit="1", description="root mean square over the window's time"),
    Quantity(key="peak", label="Peak", unit="1", description="largest magnitude in the window"),
)

ROUGH_ROAD, BUMP, WHOLE = WINDOWS
RMS, PEAK = STATISTICS
# What of PAPER_SIGNALS: RMS on the rough road (Tables 4, 7, 9), peaks on the bump (Tables 5, 8, 10).
PAPER_VIEWS = ((ROUGH_ROAD, RMS), (BUMP, PEAK))

STAGES = _catalogue(
    Quantity(key="cruise", label="Cruise", unit="1"),
    Quantity(key="brake", label="Brake", unit="1", description="from detection to the bump"),
    Quantity(
        key="bump",
        label="Bump",
        unit="1",
        description="front axle from the bump's start until the rear axle has left it",
    ),
)

COMFORT = _catalogue(
    Quantity(key="weighted_rms", label="Weighted RMS (ISO 2631-1 Wk)", unit="m/s^2", symbol="a_w"),
    Quantity(key="vibration_dose", label="Vibration dose value (Wk)", unit="m/s^1.75", symbol="VDV"),
    Quantity(
        key="front_dynamic_load_coefficient",
        label="Front dynamic load coefficient",
        unit="1",
        description="RMS on the rough road over static load",
    ),
    Quantity(
        key="rear_dynamic_load_coefficient",
        label="Rear dynamic load coefficient",
        unit="1",
        description="RMS on the rough road over static load",
    ),
    Quantity(
        key="actuator_mean_power",
        label="Actuator power, mean magnitude",
        unit="W",
        description="mean of |u·ḋ| summed over both axles",
    ),
    Quantity(
        key="actuator_peak_power",
        label="Actuator power, peak",
        unit="W",
        description="largest |u·ḋ| summed over both axles",
    ),
)

EVENTS = _catalogue(
    Quantity(
        key="airborne_ms",
        label="Airborne",
        unit="ms",
        description="time either tyre is off the road, or would have to pull on it where it cannot lift off",
        notable=1.0,
    ),
    Quantity(key="front_airborne_ms", label="Front tyre airborne", unit="ms"),
    Quantity(key="rear_airborne_ms", label="Rear tyre airborne", unit="ms"),
    Quantity(
        key="target_reached",
        label="Target speed reached",
        unit="1",
        description="within the target band at the bump, or nothing to brake for; null without a target",
    ),
    Quantity(
        key="bump_complete",
        label="Bump crossed completely",
        unit="1",
        description="false where the road ends before the rear axle has left the bump: its peaks are then up to there",
    ),
    Quantity(
        key="travel_exceeded_mm",
        label="Travel over the limit, whole run",
        unit="mm",
        description="largest deflection beyond mpc.deflection_limit anywhere, also while braking; 0 if held",
        notable=0.1,
    ),
    Quantity(
        key="limited_steps",
        label="Steps with a limit active",
        unit="1",
        description="control steps, run-in included, in which a limit of force, travel or actuator shaped the command",
    ),
    Quantity(key="qp_solves", label="QPs solved", unit="1", description="run-in included"),
    Quantity(
        key="qp_fallbacks",
        label="QP solver fallbacks",
        unit="1",
        description="solved by the other solver after the first gave no verified solution",
    ),
    Quantity(
        key="qp_failures",
        label="QPs not solved",
        unit="1",
        description="neither solver gave a verified solution and the last safe force was held; of an ECU, its "
        "iterations ran out and the forces were clipped",
    ),
    Quantity(
        key="max_slack_mm",
        label="Largest travel slack",
        unit="mm",
        description="largest predicted deflection beyond the limit the MPC accepted",
    ),
    Quantity(
        key="ecu_most_iterations",
        label="ECU: most iterations",
        unit="1",
        description="of its solver in one step; null without an ECU",
    ),
    Quantity(
        key="ecu_clipped_values",
        label="ECU: values beyond their range",
        unit="1",
        description="measured or previewed values a converter clipped; null without an ECU",
    ),
    Quantity(
        key="ecu_held_commands",
        label="ECU: commands without effect",
        unit="1",
        description="lost, late or overtaken: the actuators held an earlier one; null without an ECU",
    ),
)

# Figures of a whole run that stand beside the windows.
RUN_FIGURES = _catalogue(
    Quantity(
        key="travel_time", label="Travel time", unit="s", description="front axle from x = 0 to the end of the road"
    ),
    Quantity(
        key="arrival_speed_kmh",
        label="Speed at the bump",
        unit="km/h",
        description="when the front axle reaches the bump",
    ),
)

LIMITS_EXCEEDED = (
    "events.travel_exceeded_mm",
    "events.airborne_ms",
)  # metrics that are 0 where a limit of the car holds

_FLAGS = ("target_reached", "bump_complete")  # the events that are true or false


@dataclass(frozen=True, slots=True, kw_only=True)
class Metric:
    """One number of a strategy's result, or something true or false.

    Attributes:
        key: Its flat name, as the columns of tables have it: `bump.body_acceleration.peak`.
        label: In words.
        unit: SI unit, `1` for none.
        path: Where it stands in a result's summary.
        flag: Whether it is true or false.
    """

    key: str
    label: str
    unit: str
    path: tuple[str, ...]
    flag: bool = False

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
    signals = [
        Metric(
            key=metric_key(window.key, signal, statistic.key),
            label=f"{SIGNALS[signal].label}, {'RMS' if statistic.key == 'rms' else statistic.label.lower()}, "
            f"{window.label.lower()}",
            unit=SIGNALS[signal].unit,
            path=("metrics", window.key, signal, statistic.key),
        )
        for window in WINDOWS.values()
        for signal in METRIC_SIGNALS
        for statistic in STATISTICS.values()
    ]
    others = [
        Metric(
            key=".".join((*part, item.key)),
            label=item.label,
            unit=item.unit,
            path=(*part, item.key),
            flag=item.key in _FLAGS,
        )
        for part, items in ((("comfort",), COMFORT), (("events",), EVENTS), ((), RUN_FIGURES))
        for item in items.values()
    ]
    return {metric.key: metric for metric in (*signals, *others)}


# Every number of a result by its flat name: the columns of tables, the figures of summaries, objectives and limits.
METRICS = _metrics()
NUMBERS = tuple(key for key, metric in METRICS.items() if not metric.flag)
PAPER_METRICS = tuple(
    metric_key(window, signal, statistic) for window, statistic in PAPER_VIEWS for signal in PAPER_SIGNALS
)

# Lines a plot draws beside the curves; values come with each result as `reference`.
REFERENCES = _catalogue(
    Quantity(key="front_static_load", label="Front static tyre load", unit="N"),
    Quantity(key="rear_static_load", label="Rear static tyre load", unit="N"),
    Quantity(key="deflection_limit", label="Suspension travel limit", unit="m"),
    Quantity(key="force_limit", label="Actuator force limit", unit="N"),
    Quantity(key="target_speed", label="Target speed", unit="m/s"),
    Quantity(key="target_band", label="Half width of the target band", unit="m/s"),
)
