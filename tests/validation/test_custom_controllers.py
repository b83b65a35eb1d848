"""A custom controller is driven as ours are, and ours are written with nothing that a visitor has not."""

import importlib.util
import re
import sys
from copy import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sim_core
from sim_core import Controller, LinearLaw, Seen, Setup, check_controller, option, scenario_field, simulate
from sim_core.road.profile import road_profile
from sim_core.scenario import Actuator, Estimation, Mpc, Scenario, Vehicle
from sim_core.strategies import STRATEGIES, reads
from tests.there import there
from tests.validation.controllers import SHORT


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_each_of_our_controllers_needs_nothing_but_what_is_public_and_drives_the_same_outside(
    strategy: str, tmp_path: Path
) -> None:
    text = Path(there(sys.modules[STRATEGIES[strategy].__module__].__file__)).read_text()
    imported = re.findall(r"^(?:from|import) (sim_core\S*)(?: import \(?([^)]*?)\)?$)?", text, re.MULTILINE)
    assert {package for package, _ in imported} == {"sim_core"}
    assert {name for _, names in imported for name in re.findall(r"\w+", names)} <= set(sim_core.__all__)
    file = tmp_path / "outside.py"
    file.write_text(text)
    spec = there(importlib.util.spec_from_file_location("outside", file))
    module = importlib.util.module_from_spec(spec)
    there(spec.loader).exec_module(module)
    theirs: type[Controller] = getattr(module, STRATEGIES[strategy].__name__)
    ours, outside = simulate(SHORT, strategy), simulate(SHORT, theirs)
    assert outside.summary() == ours.summary()
    assert all(np.array_equal(outside.series[name], ours.series[name]) for name in ours.series)
    assert reads(theirs) == reads(STRATEGIES[strategy])
    assert check_controller(type("Theirs", (theirs,), {"__doc__": theirs.__doc__, "id": f"my_{strategy}"})) == []


class Skyhook(Controller):
    """Damps the body's vertical and pitch motion."""

    id = "my_skyhook"
    label = "My skyhook"
    damping: float = option(2000.0, unit="N s/m", ge=0, le=20_000, help="Force per velocity.")

    def start(self, setup: Setup) -> None:
        self._arms = np.array([-setup.vehicle.cg_to_front, setup.vehicle.cg_to_rear])

    def force(self, seen: Seen) -> Any:
        return -self.damping * (seen.state[4] + self._arms * seen.state[5])


@pytest.mark.parametrize(
    "parts",
    [
        {},
        {"vehicle": Vehicle(rebound_ratio=2.0, bump_stop_clearance=0.05)},
        {"actuator": Actuator(bandwidth=8.0, rate_limit=20_000.0, saturation=300.0)},
        {"estimation": Estimation(kind="kalman"), "mpc": Mpc(force_limit=400)},
    ],
    ids=["linear", "nonlinear", "limited actuators", "estimated and limited"],
)
def test_a_force_a_step_is_the_law_that_says_the_same(parts: dict[str, Any]) -> None:
    """Ours is driven in blocks, theirs asked in each step. Neither looks ahead, so no filter is told of the road."""
    scenario = SHORT.model_copy(update=parts)
    ours, theirs = simulate(scenario, "skyhook"), simulate(scenario, Skyhook(damping=scenario.hook.skyhook_damping))
    assert theirs.events["limited_steps"] == ours.events["limited_steps"]
    for name in ("body_acceleration", "front_force", "rear_deflection"):
        np.testing.assert_allclose(theirs.series[name], ours.series[name], rtol=1e-9, atol=1e-9)


def test_a_law_with_limits_and_no_preview_decides_within_them_alone() -> None:
    fastest = 0.05  # of the body, upwards and down [m/s]

    class Asked(Controller):
        """Damps the body while it is slow."""

        id, label = "asked", "Asked"

        def force(self, seen: Seen) -> tuple[float, float]:
            velocity = seen.state[4]
            return (-2000.0 * velocity, -1000.0 * velocity) if abs(velocity) <= fastest else (0.0, 0.0)

    class Lawful(Asked):
        """Has the same as a law."""

        def linear_law(self, stage: str) -> LinearLaw:
            gain, limits = np.zeros((2, 10)), np.zeros((1, 10))
            gain[:, 4], limits[0, 4] = (-2000, -1000), 1 / fastest
            return LinearLaw(gain=gain, limits=limits)

    asked, lawful = simulate(SHORT, Asked), simulate(SHORT, Lawful)
    assert 0 < there(lawful.events["limited_steps"]) < len(asked.series["time"])
    for key in ("front_force", "body_acceleration"):
        np.testing.assert_allclose(lawful.series[key], asked.series[key], rtol=0, atol=1e-9)


SEEN = ["time", "position", "speed", "stage", "state", "measurement", "preview", "disturbances", "previous_force"]


class Watcher(Controller):
    """Gives no force and records what it sees."""

    id = "watcher"
    label = "Watcher"
    preview = scenario_field("mpc.preview")
    prediction_horizon = scenario_field("mpc.prediction_horizon")
    recorded: list[dict[str, Any]]

    def start(self, setup: Setup) -> None:
        self.setup = setup
        self.recorded.clear()

    def force(self, seen: Seen) -> Any:
        self.recorded.append({name: np.copy(getattr(seen, name)) for name in SEEN})
        return 0.0, 0.0


def watched(scenario: Scenario) -> dict[str, Any]:
    """Return by name what a controller sees in each control step."""
    watcher = Watcher()
    watcher.recorded = []
    simulate(scenario, watcher)
    return {name: np.stack([each[name] for each in watcher.recorded]) for name in SEEN}


@pytest.mark.parametrize("vehicle", [Vehicle(), Vehicle(rebound_ratio=1.5, bump_stop_clearance=0.03)])
def test_what_it_sees_is_what_happens(vehicle: Vehicle) -> None:
    """Sensors, preview and state against the time histories of the passive car that brakes alike."""
    quiet = Estimation(acceleration_noise=1e-4, deflection_noise=1e-6, pitch_rate_noise=1e-6)
    scenario = SHORT.model_copy(update={"vehicle": vehicle, "estimation": quiet})
    seen = watched(scenario)
    on_record = seen["time"] > -1e-9
    time, position = seen["time"][on_record], seen["position"][on_record]
    assert (np.diff(seen["time"]).round(12) == 0.01).all()
    passive = simulate(scenario, "speed_only").series
    np.testing.assert_allclose(np.interp(time, passive["time"], passive["position"]), position, atol=1e-6)
    np.testing.assert_allclose(np.interp(time, passive["time"], passive["speed"]), seen["speed"][on_record], atol=1e-4)
    for number, name in ((0, "front_deflection"), (1, "rear_deflection"), (2, "body_acceleration")):
        expected = np.interp(time, passive["time"], passive[name])
        scale = np.abs(passive[name]).max()
        np.testing.assert_allclose(seen["measurement"][on_record][:, number], expected, atol=5e-3 * scale)
    np.testing.assert_allclose(seen["measurement"][:, [3, 0, 1]], seen["state"][:, [5, 0, 1]], atol=1e-5)
    surface, ahead = road_profile(scenario.road), seen["preview"]
    assert ahead.shape == (len(seen["time"]), scenario.mpc.prediction_horizon, 2)
    later = seen["position"][1:-30]
    for axle, behind in enumerate((0, vehicle.wheelbase)):
        np.testing.assert_allclose(ahead[: len(later), 0, axle], surface.height(later - behind), atol=1e-9)
    tenth = seen["position"][10:][: len(later)]
    np.testing.assert_allclose(ahead[: len(later), 9, 0], surface.height(tenth), atol=1e-9)
    assert set(seen["stage"]) == {"cruise", "brake", "bump"}


def test_without_sensors_the_road_ahead_is_level() -> None:
    seen = watched(SHORT.model_copy(update={"mpc": Mpc(preview="none")}))
    np.testing.assert_allclose(np.diff(seen["preview"], axis=1), 0, atol=1e-15)


def test_options_belong_to_the_object_and_are_read_of_a_controller_that_has_some() -> None:
    soft, hard = simulate(SHORT, Skyhook(damping=500)), simulate(SHORT, Skyhook)
    assert hard.metrics["bump"]["body_acceleration"] != soft.metrics["bump"]["body_acceleration"]
    assert simulate(SHORT, Skyhook(damping=2000.0)).summary() == hard.summary()
    assert reads(Skyhook)[-1] == "own.my_skyhook"
    assert not any(name.startswith("own") for name in reads(Watcher))


class Assigned(Controller):
    """Has a field of each kind."""

    id, label = "assigned", "Assigned"
    flag: bool = option(default=True)
    front = rear = option(2000.0, ge=0)
    preview = scenario_field("mpc.preview")


OF_SCENARIO = {"flag": False, "front": 100.0, "rear": 300.0, "preview": "none"}
CHANGED = Scenario.model_validate(
    {"mpc": {"preview": "none"}, "own": {"assigned": {"flag": False, "front": 100.0, "rear": 300.0}}}
)


@pytest.mark.parametrize(
    ("name", "value"),
    [("flag", True), ("front", float("2000")), ("rear", 500.0), ("preview", Scenario().mpc.preview)],
)
def test_what_is_assigned_counts_also_where_it_is_the_default(name: str, value: Any) -> None:
    """In the object and its copies; else the scenario's value counts, in that scenario alone."""
    controller = Assigned()
    before = copy(controller)
    setattr(controller, name, value)
    for object_, own in ((controller, {name: value}), (copy(controller), {name: value}), (before, {})):
        ready = object_.for_scenario(CHANGED)
        assert {each: getattr(ready, each) for each in OF_SCENARIO} == OF_SCENARIO | own
        ready.rear = 700.0
    again = before.for_scenario(CHANGED).for_scenario(Scenario())
    assert (again.flag, again.front, again.rear, again.preview) == (True, 2000.0, 2000.0, "lookahead")
