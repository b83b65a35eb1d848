"""A result is a pure function of exactly the fields its strategy says it reads."""

from pathlib import Path
from typing import Any, Self

import numpy as np
import pytest

from sim_core import Controller, Seen, check_controller, load_controllers, scenario_field
from sim_core.check_controller import undeclared_reads
from sim_core.result import StrategyResult
from sim_core.scenario import Bump, Hil, Lqr, Mpc, Road, Scenario, Speed, Vehicle, dotted
from sim_core.scenario.access import record_accesses
from sim_core.scenario.dotted import is_within
from sim_core.scenario.measured import MeasuredRoad
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES, reads, reads_in, values_read
from sim_core.strategies.effects import conditional_reads
from tests.servers.process import ROOT
from tests.validation.conditions import may_affect

# A short, lively run: limits bind, the car brakes, every stage occurs.
BASE = Scenario(
    vehicle=Vehicle(anti_dive=0.3, anti_lift=0.2),
    road=Road(length=34, bump=Bump(start=20, width=3, height=0.09, count=2, spacing=3.5)),
    speed=Speed(initial_speed_kmh=36, detection_distance=16),
    mpc=Mpc(prediction_horizon=12, control_horizon=8, force_limit=2500, deflection_limit=0.05),
    lqr=Lqr(preview="lookahead", preview_horizon=12),
    hil=Hil(bits=24, iterations=2, noise=0.002, jitter=0.004, packet_loss=0.05),
)
MEASURED = MeasuredRoad.of(np.linspace(0, 0.2, 5000) ** 2)
OTHER = {
    "cosine": "half_sine",
    "lookahead": "wheelbase",
    "daqp": "osqp",
    "guarded": "fuzzy",
    "predict": "none",
    "in_turn": "together",
    "exact": "kalman",
}


# A drive with the ECU in the loop takes a tenth of a second.
every_strategy = pytest.mark.parametrize(
    "strategy", [pytest.param(name, marks=[pytest.mark.thorough] * (name == "lv_hil")) for name in STRATEGIES]
)


def leaves(value: Any, name: str = "") -> list[str]:
    """Return the dotted names of all fields that hold a plain value."""
    if isinstance(value, dict):
        return [leaf for key, item in value.items() for leaf in leaves(item, f"{name}.{key}".lstrip("."))]
    return [name]


def altered(value: Any) -> Any:
    """Return another value of the same kind, within every limit."""
    if isinstance(value, str):
        return OTHER[value]
    if isinstance(value, list):
        return [altered(item) for item in value]
    if isinstance(value, bool):
        return not value
    return value - 1 if isinstance(value, int) and value else value * 0.93 or 0.01


def triangles(*peaks: float) -> list[dict[str, object]]:
    """Return fuzzy sets of Table 1's names."""
    ends = [2 * peaks[0] - peaks[1], *peaks, 2 * peaks[-1] - peaks[-2]]
    corners = zip(ends, ends[1:], ends[2:], strict=False)
    return [{"name": name, "function": "trimf", "corners": each} for name, each in zip("OSMLV", corners, strict=True)]


# Of fields that have no value, or whose value has to change by more to count.
VALUES: dict[str, Any] = {
    "road.profile": MEASURED.id,
    "vehicle.bump_stop_clearance": 0.02,
    "vehicle.front_damper_curve": [[-1, -3000], [1, 5000]],
    "vehicle.rear_damper_curve": [[-1, -3000], [1, 5000]],
    "mismatch.preview_resolution": 0.2,
    "actuator.bandwidth": 8.0,
    "actuator.rate_limit": 5000.0,
    "actuator.saturation": 300.0,
    "hook.max_damping": 5000.0,
    "speed.detection_distance": 1.0,  # within the horizon, of which preview sees no more then
    "hil.jitter": 0.006,  # whole milliseconds count
    "fuzzy.inputs": {"speed_error": triangles(0, 5, 11, 20, 30), "distance": triangles(0, 10, 30, 55, 80)},
    "fuzzy.output": triangles(0, 0.2, 0.45, 0.7, 1),
    "fuzzy.rules": [{"if": {"distance": "V"}, "then": "V"}, {"if": {"distance": "S"}, "then": "S"}],
}


def changed_by(changes: dict[str, Any], base: Scenario = BASE) -> Scenario:
    """Return the scenario with these fields, on its measured road where it names one."""
    scenario = Scenario.model_validate(dotted.with_changes(base.model_dump(mode="json"), changes))
    return scenario.on(MEASURED) if scenario.road.profile else scenario


def with_leaf(name: str, base: Scenario = BASE) -> Scenario:
    """Return the scenario with that one field changed."""
    value = dotted.value(base.model_dump(mode="json"), name)
    return changed_by({name: VALUES[name] if name in VALUES else altered(value)}, base)


# The policy says what else is read: it has a test of its own.
LEAVES = [name for name in leaves(BASE.model_dump(mode="json")) if name != "speed.policy"]


def is_read(strategy: str, name: str) -> bool:
    return any(is_within(name, part) for part in reads(STRATEGIES[strategy]))


def same(one: StrategyResult, two: StrategyResult) -> bool:
    """Bit for bit: every figure and every sample."""
    # By their texts: without a bump the speed there is not a number, which equals nothing.
    return repr(one.summary()) == repr(two.summary()) and all(
        np.array_equal(one.series[name], two.series[name]) for name in one.series
    )


# Fields that are read but need not show in this scenario.
SILENT = {
    "speed.controller",  # the guard only acts where fuzzy alone would be late
    "brake.threshold_speed",  # tanh is 1 to the last bit at any speed driven here
    "mpc.solver",  # either finds the same optimum
    "road.seed",
    "vehicle.bump_stop_stiffness",  # there are no stops
    "estimation.acceleration_noise",  # the state is told exactly
    "estimation.deflection_noise",
    "estimation.pitch_rate_noise",
    "estimation.knows_preview",
    "hook.min_damping",  # no damper is semi-active
    "hook.max_damping",
}


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_the_key_changes_with_the_fields_that_are_read_alone(strategy: str) -> None:
    key = values_read(BASE, STRATEGIES[strategy])
    changed = {name for name in LEAVES if values_read(with_leaf(name), STRATEGIES[strategy]) != key}
    assert changed == {name for name in LEAVES if is_read(strategy, name)}
    assert 20 < len(changed) < len(LEAVES)


@every_strategy
def test_the_speed_policy_changes_the_key_exactly_where_it_changes_the_result(strategy: str) -> None:
    """What is read follows the speed that is driven: a target matters where somebody slows down."""
    base, controller = simulate(BASE, strategy), STRATEGIES[strategy]

    def with_speed(scenario: Scenario, **speed: Any) -> tuple[Scenario, StrategyResult]:
        changed = scenario.model_copy(update={"speed": scenario.speed.model_copy(update=speed)})
        return changed, simulate(changed, strategy)

    for policy in ("planned", "constant"):
        changed, result = with_speed(BASE, policy=policy)
        is_own = policy == controller.speed_plan
        assert same(result, base) == (values_read(changed, controller) == values_read(BASE, controller)) == is_own
        slower, later = with_speed(changed, target_speed_kmh=19.0)
        alike = values_read(slower, controller) == values_read(changed, controller)
        assert same(later, result) == alike == (policy == "constant")


# Scenarios in which some fields that a strategy may read have no effect, and others have one.
VARIANTS: dict[str, dict[str, Any]] = {
    "as it is": {},
    "measured": {"road.profile": MEASURED.id},
    "filtered on a measured road": {"road.profile": MEASURED.id, "estimation.kind": "kalman"},
    "trusting": {"road.profile": MEASURED.id, "mpc.expected_offset": 0.1, "mpc.expected_noise": 0.01},
    "noisy": {"road.profile": MEASURED.id, "mismatch.preview_noise": 0.01},
    "filtered": {"estimation.kind": "kalman"},
    "filtered without preview": {"estimation.kind": "kalman", "mpc.preview": "none", "lqr.preview": "none"},
    "without preview": {"mpc.preview": "none", "lqr.preview": "none"},
    "behind the front": {"mpc.preview": "wheelbase", "lqr.preview": "wheelbase"},
    "the bump alone": {"mpc.preview": "obstacle", "lqr.preview": "obstacle"},
    "at constant speed": {"speed.policy": "constant"},
    "slowed down": {"speed.policy": "planned"},
    "level": {"road.bump.height": 0, "road.roughness": 0, "hil.noise": 0, "hil.jitter": 0, "hil.packet_loss": 0},
    "no bump": {"road.bump.height": 0, "road.bump.start": 100},
    "one bump": {"road.bump.count": 1, "vehicle.anti_dive": 0, "vehicle.anti_lift": 0},
    "stops": {"vehicle.bump_stop_clearance": 0.02, "hook.semi_active": True},
}


ONLY_WITH_A_BUMP = {
    "speed.policy",
    "speed.target_speed_kmh",
    "road.bump.start",
    "road.bump.width",
    "road.bump.count",
    "road.bump.spacing",
    "brake.friction_coefficient",
}


@every_strategy
def test_a_field_has_an_effect_only_where_the_conditions_of_its_reading_hold(strategy: str) -> None:
    """Under each variant what has no effect changes nothing at all, and each field has one under some variant."""
    groups = conditional_reads(STRATEGIES[strategy])
    always = {name for group in groups if not group.conditions for name in group.fields}
    silent, effective = set[str](), set[str]()
    for variant in VARIANTS:
        scenario = changed_by(VARIANTS[variant])
        base = simulate(scenario, strategy)
        for name in LEAVES:
            read = {each for group in groups for each in group.fields if is_within(name, each)}
            if not read or read & always:
                continue
            has_effect = may_affect(groups, name, scenario)
            if has_effect and name in effective:
                continue
            if variant == "no bump" and name in ONLY_WITH_A_BUMP:
                assert not has_effect, name
            unchanged = same(simulate(with_leaf(name, scenario), strategy), base)
            assert unchanged or has_effect, (variant, name)
            (silent if unchanged else effective).add(name)
    assert silent - effective <= SILENT


@every_strategy
def test_runs_leave_no_trace_in_each_other(strategy: str) -> None:
    """Results cached between runs change none of them, in any order and whatever a caller does with them."""
    first = simulate(BASE, strategy)
    copies = {name: values.copy() for name, values in first.series.items()}
    simulate(with_leaf("road.bump.height"), strategy)
    for other in STRATEGIES:
        simulate(BASE, other)
    for values in first.series.values():
        if values.flags.writeable:
            values *= 0
    again = simulate(BASE, strategy)
    assert all(np.array_equal(again.series[name], copies[name]) for name in copies)


# In these, all that is read by somebody is looked at.
WATCHED = "as it is", "filtered", "noisy", "behind the front", "the bump alone", "without preview", "stops"


@pytest.mark.parametrize("policy", ["by_strategy", "planned", "constant"])
@pytest.mark.parametrize("strategy", STRATEGIES)
def test_drives_look_at_exactly_the_fields_that_are_declared(strategy: str, policy: Any) -> None:
    """At none beyond in any drive, with nothing cached; and at each of them in one of these drives."""
    looked_at, declared = set[str](), set[str]()
    for variant in WATCHED:
        scenario = changed_by(VARIANTS[variant])
        scenario = scenario.model_copy(update={"speed": scenario.speed.model_copy(update={"policy": policy})})
        assert undeclared_reads(scenario, STRATEGIES[strategy]) == []
        result, names = record_accesses(scenario, lambda recording: simulate(recording, strategy))
        assert same(result, simulate(scenario, strategy)), "recording changes nothing"
        looked_at |= names
        declared |= set(reads_in(scenario, STRATEGIES[strategy]))
    leaves = set(LEAVES)
    assert {each for each in leaves if any(is_within(each, part) for part in declared)} == looked_at & leaves
    assert all(any(is_within(each, part) for part in reads(STRATEGIES[strategy], policy)) for each in declared)


@pytest.mark.parametrize("file", sorted((ROOT / "examples" / "controllers").glob("*.py")), ids=lambda file: file.stem)
def test_examples_look_at_no_field_that_is_not_declared(file: Path) -> None:
    for kind in load_controllers(file).values():
        for variant in WATCHED:
            assert undeclared_reads(changed_by(VARIANTS[variant]), kind) == []


def test_the_check_names_a_field_that_a_controller_looks_at_and_does_not_declare() -> None:
    class Peeks(Controller):
        """Looks at what is no field of its own."""

        id, label = "peeks", "Peeks"
        gain: float

        def for_scenario(self, scenario: Scenario) -> Self:
            ready = super().for_scenario(scenario)
            ready.gain = scenario.hook.alpha + sum(scenario.lqr.model_dump()["weights"])
            return ready

        def force(self, seen: Seen) -> Any:
            return self.gain * seen.state[:2]

    said = check_controller(Peeks)
    fields = [f"lqr.{name}" for name in ("deflection_weight", "preview", "preview_horizon", "weights")]
    assert [each.partition(" without ")[0] for each in said] == [
        f"It reads scenario field {name}" for name in ("hook.alpha", *fields)
    ]
    assert 'scenario_field("hook.alpha")' in said[0]
    declared = {"alpha": scenario_field("hook.alpha"), "weighs": scenario_field("lqr"), "__doc__": "Looks."}
    assert check_controller(type("Declares", (Peeks,), declared)) == []
