"""A controller of one's own is driven as ours are, and ours are written with nothing that a visitor has not."""

import ast
import importlib.util
import re
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import sim_core
from sim_core import Controller, LinearLaw, Seen, Setup, check_controller, option, scenario_field, simulate
from sim_core.errors import RidelabError
from sim_core.road.profile import road_profile
from sim_core.scenario import Actuator, Bump, Estimation, Mismatch, Mpc, Road, Scenario, Vehicle
from sim_core.simulate import prepare
from sim_core.strategies import STRATEGIES, reads
from sim_core.vehicle.half_car import half_car
from tests.there import there

FILES = sorted(
    file
    for file in (Path(sim_core.__file__).parent / "strategies").glob("*.py")
    if file.stem not in ("__init__", "reads", "effects", "calibration")
)
SHORT = Scenario(road=Road(length=60, bump=Bump(start=30)))


def copied(file: Path, folder: Path) -> ModuleType:
    """The file as a visitor's module."""
    copy = folder / f"my_{file.name}"
    copy.write_bytes(file.read_bytes())
    spec = there(importlib.util.spec_from_file_location(copy.stem, copy))
    module = importlib.util.module_from_spec(spec)
    there(spec.loader).exec_module(module)
    return module


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_each_of_our_laws_needs_nothing_but_what_is_public_and_drives_the_same_outside(
    file: Path, tmp_path: Path
) -> None:
    own = [node for node in ast.walk(ast.parse(file.read_text())) if isinstance(node, ast.ImportFrom | ast.Import)]
    for node in own:
        names = [alias.name for alias in node.names]
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("sim_core"):
            assert node.module == "sim_core", names
            assert set(names) <= set(sim_core.__all__)
        else:
            assert not any(name.startswith("sim_core.") for name in names)
    module = copied(file, tmp_path)
    theirs = [
        each
        for each in vars(module).values()
        if isinstance(each, type) and issubclass(each, Controller) and each.__module__ == module.__name__
    ]
    assert theirs
    for law in theirs:
        ours, outside = simulate(SHORT, law.id), simulate(SHORT, law)
        assert outside.summary() == ours.summary()
        assert all(np.array_equal(outside.series[name], ours.series[name]) for name in ours.series)
        assert reads(law) == reads(STRATEGIES[law.id])
        assert check_controller(type(law.__name__, (law,), {"__doc__": law.__doc__, "id": f"my_{law.id}"})) == []


def test_all_strategies_are_one_file_each() -> None:
    assert {law.__module__.rpartition(".")[2] for law in STRATEGIES.values()} == {file.stem for file in FILES}


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
    "scenario",
    [
        SHORT,
        SHORT.model_copy(update={"vehicle": Vehicle(rebound_ratio=2.0, bump_stop_clearance=0.05)}),
        SHORT.model_copy(update={"actuator": Actuator(bandwidth=8.0, rate_limit=20_000.0, saturation=300.0)}),
        SHORT.model_copy(update={"estimation": Estimation(kind="kalman"), "mpc": Mpc(force_limit=400)}),
    ],
    ids=["linear", "nonlinear", "limited actuators", "estimated and limited"],
)
def test_a_force_a_step_is_the_law_that_says_the_same(scenario: Scenario) -> None:
    """Ours is driven in blocks, theirs asked in each step. Neither looks ahead, so no filter is told of the road."""
    ours, theirs = simulate(scenario, "skyhook"), simulate(scenario, Skyhook(damping=scenario.hook.skyhook_damping))
    assert theirs.events["limited_steps"] == ours.events["limited_steps"]
    for name in ("body_acceleration", "front_force", "rear_deflection"):
        np.testing.assert_allclose(theirs.series[name], ours.series[name], rtol=1e-9, atol=1e-9)


def test_options_have_defaults_bounds_and_belong_to_the_object() -> None:
    soft, hard = simulate(SHORT, Skyhook(damping=500)), simulate(SHORT, Skyhook)
    assert hard.metrics["bump"]["body_acceleration"] != soft.metrics["bump"]["body_acceleration"]
    assert simulate(SHORT, Skyhook(damping=2000.0)).summary() == hard.summary()
    for wrong in (-1.0, 20_001.0, "2000"):
        with pytest.raises(RidelabError) as refused:
            Skyhook(damping=wrong)
        assert refused.value.field == "own.my_skyhook.damping"
        assert refused.value.message.startswith("damping: Input should be ")
    with pytest.raises(RidelabError, match="damping"):
        Skyhook(dampnig=1.0)


class Watcher(Controller):
    """Gives no force and keeps what it sees."""

    id = "watcher"
    label = "Watcher"
    preview = scenario_field("mpc.preview")
    prediction_horizon = scenario_field("mpc.prediction_horizon")
    recorded: list[dict[str, Any]]

    def start(self, setup: Setup) -> None:
        self.setup = setup
        self.recorded.clear()

    def force(self, seen: Seen) -> Any:
        names = [
            "time",
            "position",
            "speed",
            "stage",
            "state",
            "measurement",
            "preview",
            "disturbances",
            "previous_force",
        ]
        self.recorded.append({name: np.copy(getattr(seen, name)) for name in names})
        return 0.0, 0.0


def watched(scenario: Scenario) -> dict[str, Any]:
    """By name what a controller sees in each control step."""
    watcher = Watcher()
    watcher.recorded = []
    simulate(scenario, watcher)
    return {name: np.stack([each[name] for each in watcher.recorded]) for name in watcher.recorded[0]}


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
    np.testing.assert_allclose(seen["measurement"][:, 3], seen["state"][:, 5], atol=1e-5)
    np.testing.assert_allclose(seen["measurement"][:, :2], seen["state"][:, :2], atol=1e-5)
    surface, ahead = road_profile(scenario.road), seen["preview"]
    assert ahead.shape == (len(seen["time"]), scenario.mpc.prediction_horizon, 2)
    later = seen["position"][1:-30]
    np.testing.assert_allclose(ahead[: len(later), 0, 0], surface.height(later), atol=1e-9)
    np.testing.assert_allclose(ahead[: len(later), 0, 1], surface.height(later - vehicle.wheelbase), atol=1e-9)
    np.testing.assert_allclose(
        ahead[: len(later), 9, 0], surface.height(seen["position"][10:][: len(later)]), atol=1e-9
    )
    assert set(seen["stage"]) == {"cruise", "brake", "bump"}


def test_measurements_have_the_noise_of_the_sensors() -> None:
    noise = Estimation(acceleration_noise=0.2, deflection_noise=0.002, pitch_rate_noise=0.01)
    exact = watched(SHORT.model_copy(update={"estimation": Estimation(acceleration_noise=1e-4, deflection_noise=1e-6)}))
    noisy = watched(SHORT.model_copy(update={"estimation": noise}))
    deviation = (noisy["measurement"] - exact["measurement"]).std(axis=0)
    np.testing.assert_allclose(deviation, [0.002, 0.002, 0.2, 0.01], rtol=0.25)
    np.testing.assert_array_equal(noisy["state"], exact["state"])


def test_without_sensors_the_road_ahead_is_level() -> None:
    seen = watched(SHORT.model_copy(update={"mpc": Mpc(preview="none")}))
    np.testing.assert_allclose(np.diff(seen["preview"], axis=1), 0, atol=1e-15)


@pytest.mark.parametrize(("least", "most"), [(-1.0, 10.0), (20.0, 10.0), (float("nan"), 10.0)])
def test_semi_active_dampers_have_a_range(least: float, most: float) -> None:
    with pytest.raises(RidelabError, match="least damping is 0 or more, and at most its greatest one"):
        sim_core.SemiActiveDampers(least=least, most=most)


@pytest.mark.parametrize("scenario", ["paper", {}, Scenario])
def test_what_is_no_scenario_is_refused(scenario: Any) -> None:
    with pytest.raises(RidelabError, match=r"A scenario is a sim_core\.Scenario"):
        simulate(scenario, "passive")


@pytest.mark.parametrize(
    ("base", "missing"),
    [
        (Controller, "force"),
        (sim_core.DampingController, "damping"),
        (sim_core.PredictiveController, "weights"),
        (sim_core.EcuController, "weights"),
    ],
)
def test_what_a_class_has_to_define_is_said(base: type[Controller], missing: str) -> None:
    unfinished = type("Unfinished", (base,), {})
    with pytest.raises(RidelabError, match=f"Unfinished has to define {missing}"):
        simulate(SHORT, unfinished)


def test_a_field_of_the_scenario_exists_and_takes_what_the_scenario_takes() -> None:
    class Misspelt(Controller):
        gain: float = scenario_field("hook.skyhok_damping")

    with pytest.raises(RidelabError, match=r"no field hook\.skyhok_damping.*hook\.skyhook_damping"):
        simulate(SHORT, Misspelt)
    lv, word = STRATEGIES["lv"], "word"
    for values, dotted in (
        ({"preview": word}, "mpc.preview"),
        ({"prediction_horizon": 0}, "mpc.prediction_horizon"),
        ({"stage_weights": word}, "mpc.stage_weights"),
    ):
        with pytest.raises(RidelabError) as refused:
            lv(**values)
        assert refused.value.field == dotted
        assert word not in refused.value.message
    assert lv(preview="none").for_scenario(SHORT).preview == "none"


@pytest.mark.parametrize(
    ("base", "members", "said"),
    [
        (Controller, {"preview": "ahead"}, "preview is one of none, wheelbase, lookahead, obstacle"),
        (Controller, {"prediction_horizon": -1}, "prediction_horizon is a whole number, 0 or more"),
        (Controller, {"prediction_horizon": 9}, "sets prediction_horizon and not preview"),
        (Controller, {"preview": "lookahead"}, "sets preview and not prediction_horizon"),
        (
            Controller,
            {"start": lambda self, _: setattr(self, "preview", "wheelbase")},
            "are set before start",
        ),
        (Controller, {"speed_plan": "fast"}, "speed_plan is planned or constant"),
        (Controller, {"speed_plan": property(lambda _: "constant")}, "set speed_plan on the class, not on objects"),
        (Controller, {"delayed": option(default=False)}, "set delayed on the class, not on objects"),
        (
            Controller,
            {"actuated": False, "dampers": lambda _: sim_core.SemiActiveDampers(least=0, most=1)},
            "a controller with dampers() must have actuated = True",
        ),
        (sim_core.PredictiveController, {"prediction_horizon": 0}, "prediction_horizon and a control_horizon of 1"),
        (sim_core.PredictiveController, {"control_horizon": 0}, "prediction_horizon and a control_horizon of 1"),
        (sim_core.EcuController, {"prediction_horizon": 0}, "prediction_horizon and a control_horizon of 1"),
    ],
)
def test_a_horizon_preview_or_plan_that_is_none_is_refused(
    base: type[Controller], members: dict[str, Any], said: str
) -> None:
    needed = {"force": lambda _self, _seen: (0.0, 0.0)} if base is Controller else {"weights": lambda *_: (1, 1, 1)}
    with pytest.raises(RidelabError, match=re.escape(said)):
        simulate(SHORT, type("Wrong", (base,), needed | members))


@pytest.mark.parametrize("preview", ["wheelbase", "lookahead", "obstacle"])
@pytest.mark.parametrize("horizon", [1, np.int64(7)])
def test_a_horizon_is_any_whole_number(preview: str, horizon: int) -> None:
    class Watcher(Controller):
        def force(self, seen: Seen) -> tuple[float, float]:
            assert seen.preview.shape == (horizon, 2)
            return 0.0, 0.0

    watcher = type("Watcher", (Watcher,), {"preview": preview, "prediction_horizon": horizon})
    assert simulate(SHORT, watcher).events["limited_steps"] == 0


@pytest.mark.parametrize(
    "members", [{}, {"preview": "lookahead", "prediction_horizon": 0}, {"preview": "none", "prediction_horizon": 9}]
)
def test_preview_is_there_for_those_who_ask_for_it_alone(members: dict[str, Any]) -> None:
    def force(_self: Controller, seen: Seen) -> Any:
        return seen.preview[0]

    blind = type("Blind", (Controller,), {"id": "blind", "label": "Blind", "__doc__": "Looks.", "force": force})
    looking = type("Looking", (blind,), {"__doc__": "Looks.", **members})
    (said,) = check_controller(looking, SHORT)
    assert said.startswith("seen.preview is there for a controller that asks for it: set preview (to ")
    assert "prediction_horizon" in said
    if not members.get("prediction_horizon"):
        expecting = type("Expecting", (looking,), {"force": lambda _self, seen: seen.disturbances[:2, 0]})
        with pytest.raises(RidelabError, match=r"seen\.disturbances is there for a controller that asks for it"):
            simulate(SHORT, expecting)
    asking = type("Asking", (looking,), {"__doc__": "Looks.", "preview": "wheelbase", "prediction_horizon": 9})
    assert check_controller(asking, SHORT) == []


def test_a_law_that_does_not_fit_its_preview_is_refused() -> None:
    class Wide(Controller):
        """Has a law for another horizon."""

        id, label = "wide", "Wide"

        def start(self, setup: Setup) -> None:
            self._law = LinearLaw(gain=np.zeros((2, 10)), preview_gain=np.zeros((2, 3)))

        def linear_law(self, stage: str) -> LinearLaw:
            return self._law

    with pytest.raises(RidelabError, match="three columns"):
        simulate(SHORT, Wide)
    for shapes in ({"gain": np.zeros((2, 4))}, {"gain": np.zeros((2, 10)), "limits": np.zeros((3, 11))}):
        with pytest.raises(RidelabError, match="shape"):
            LinearLaw(**shapes)
    with pytest.raises(RidelabError, match="as many control steps"):
        LinearLaw(gain=np.zeros((2, 10)), preview_gain=np.zeros((2, 3)), limits=np.zeros((1, 16)))


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

        id, label = "lawful", "Lawful"

        def linear_law(self, stage: str) -> LinearLaw:
            gain, limits = np.zeros((2, 10)), np.zeros((1, 10))
            gain[:, 4], limits[0, 4] = (-2000, -1000), 1 / fastest
            return LinearLaw(gain=gain, limits=limits)

    asked, lawful = simulate(SHORT, Asked), simulate(SHORT, Lawful)
    assert 0 < there(lawful.events["limited_steps"]) < len(asked.series["time"])
    for key in ("front_force", "body_acceleration"):
        np.testing.assert_allclose(lawful.series[key], asked.series[key], rtol=0, atol=1e-9)


def test_the_believed_car_is_told_not_the_real_one() -> None:
    scenario = SHORT.model_copy(update={"mismatch": Mismatch(body_mass=1.2)})
    watcher = Watcher()
    watcher.recorded = []
    ready = watcher.for_scenario(scenario)
    ready.start(prepare(scenario, ready).setup())
    assert ready.setup.vehicle == scenario.vehicle
    assert half_car(ready.setup.vehicle) is half_car(Vehicle())


def test_options_are_read_of_a_law_that_has_some() -> None:
    assert reads(Skyhook)[-1] == "own.my_skyhook"
    assert not any(name.startswith("own") for name in reads(Watcher))
