"""A run's own export, read back as a recording: one definition of every metric gives the run's own metrics."""

from math import isnan

import pytest

from backend.recordings import reading
from backend.runs import exports
from sim_core import STRATEGIES, Bump, Road, Scenario, Vehicle, simulate
from sim_core.catalogue import COMFORT, EVENTS, METRIC_SIGNALS, SIGNALS, STATISTICS, WINDOWS
from sim_core.recorded.result import recorded_result
from sim_core.result import StrategyResult
from sim_core.scenario.presets import preset
from sim_core.scenario.vehicles import VEHICLES
from tests.there import there

SCENARIOS = {
    "paper": Scenario(),
    "half_car_consistent": preset("half_car_consistent"),
    "van": Scenario(vehicle=VEHICLES["van"].vehicle),
    "washboard": preset("washboard"),
    "stops": Scenario(vehicle=Vehicle(bump_stop_clearance=0.05, tyre_lift_off=True)),
    "both axles at once": Scenario(road=Road(rear_axle="together")),
    "no bump": Scenario(road=Road(bump=Bump(height=0))),
}
ALWAYS = {
    ("paper", "lv"),
    ("paper", "suspension_only"),
    ("half_car_consistent", "lv_hil"),
    ("van", "lqr"),
    ("washboard", "skyhook"),
    ("stops", "groundhook"),
    ("both axles at once", "hybrid"),
    ("no bump", "passive"),
}
# Of a controller or of its speed plan: a recording has none of these, and all other events.
NOT_RECORDED = {
    "target_reached",
    "limited_steps",
    "qp_solves",
    "qp_fallbacks",
    "qp_failures",
    "max_slack_mm",
    "ecu_most_iterations",
    "ecu_clipped_values",
    "ecu_held_commands",
}


def numbers(result: StrategyResult) -> dict[str, float | None]:
    """Every metric that a recording can have too, by name."""
    of_windows = {
        f"{window}.{signal}.{statistic}": result.metrics[window][signal][statistic]
        for window in WINDOWS
        for signal in METRIC_SIGNALS
        for statistic in STATISTICS
    }
    events = {key: result.events[key] for key in EVENTS if key not in NOT_RECORDED}
    drive = {"travel_time": result.travel_time, "arrival_speed_kmh": result.arrival_speed_kmh}
    return {**of_windows, **{key: result.comfort[key] for key in COMFORT}, **events, **drive}


@pytest.mark.parametrize(
    ("name", "strategy"),
    [
        pytest.param(name, strategy, marks=() if (name, strategy) in ALWAYS else pytest.mark.thorough)
        for name in SCENARIOS
        for strategy in STRATEGIES
    ],
)
def test_a_runs_own_export_has_its_own_metrics(name: str, strategy: str) -> None:
    """Within 0.05 %, but for two kinds of metrics.

    The power, 0.3 % and on a road without a bump 0.5 %, is of a deflection whose rate a recording does not have. The
    RMS of accelerations, 0.1 %, is the samples' own where nothing jumps; a run's is of lines between them.
    """
    scenario = SCENARIOS[name]
    result = simulate(scenario, strategy)
    export = exports.Export(
        strategies=[strategy],
        signals=list(SIGNALS),
        points=None,
        file_format="csv",
        encoding="list",
        core_version="",
        sources={},
    )
    found = recorded_result(scenario, reading.read(exports.render(scenario, export, None), {}).drive)
    recording = there(found.recording)
    reference = strategy.removesuffix("_hil")  # the ECU drives LV's controller, with arithmetic of its own
    assert (recording.reference, recording.offset, recording.scale) == (reference, 0, 1)
    assert there(recording.likeness) > (0.999 if reference == strategy else 0.98)
    ours, theirs = numbers(found), numbers(result)
    lacking = {key for each in (ours, theirs) for key, value in each.items() if value is None or isnan(value)}
    assert not lacking, "both have every metric, on a flat bump too"
    power = 0.003 if scenario.road.bump.height else 0.005
    for key, value in theirs.items():
        relative = power if "power" in key else 1e-3 if key.endswith("acceleration.rms") else 5e-4
        assert ours[key] == pytest.approx(value, rel=relative, abs=1e-6), key
