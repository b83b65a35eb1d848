"""A result is a pure function of exactly the fields its strategy says it reads."""

import ast
import json
import re
from pathlib import Path
from typing import Any, Self

import numpy as np
import pytest

from sim_core import Controller, Seen, check_controller, load_controllers, scenario_field, strategies
from sim_core.check_controller import undeclared_reads
from sim_core.errors import RidelabError
from sim_core.result import StrategyResult
from sim_core.scenario import Bump, Estimation, Hil, Lqr, Mpc, Road, Scenario, Speed, Vehicle, dotted
from sim_core.scenario.access import record_accesses
from sim_core.scenario.dotted import is_within
from sim_core.scenario.measured import MeasuredRoad
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES, reads, reads_in, values_read
from sim_core.strategies.effects import conditional_reads
from tests.servers.process import ROOT

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


def leaves(value: Any, path: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """Paths of all fields that hold a plain value."""
    if isinstance(value, dict):
        return [leaf for key, item in value.items() for leaf in leaves(item, (*path, key))]
    return [path]


def altered(value: Any) -> Any:
    """Another value of the same kind, within every limit."""
    if isinstance(value, str):
        return OTHER[value]
    if isinstance(value, bool):
        return not value
    if isinstance(value, list):
        return [altered(item) for item in value]
    if value is None:
        return 5000.0
    if value == 0:
        return 0.01
    return value - 1 if isinstance(value, int) else value * 0.93


def with_leaf(path: tuple[str, ...], base: Scenario = BASE) -> Scenario:
    """The base scenario with that one field changed."""
    document = json.loads(base.model_dump_json())
    if path == ("road", "profile"):
        document["road"]["profile"] = MEASURED.id
        return Scenario.model_validate(document).on(MEASURED)
    place = document
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = altered(place[path[-1]])
    if path[0] == "actuator":
        place[path[-1]] = {"bandwidth": 8.0, "rate_limit": 5000.0, "saturation": 300.0}[path[-1]]
    if path in (("vehicle", "bump_stop_clearance"), ("mismatch", "preview_resolution")):
        place[path[-1]] = {"bump_stop_clearance": 0.02, "preview_resolution": 0.2}[path[-1]]
    if path[-1].endswith("damper_curve"):
        place[path[-1]] = [[-1, -3000], [1, 5000]]
    if path[0] == "fuzzy":
        place[path[-1]] = OWN_RULES[path[-1]]
    if path == ("speed", "detection_distance"):  # within the horizon, of which preview sees no more then
        place[path[-1]] = 1.0
    if path == ("hil", "jitter"):  # whole milliseconds count
        place[path[-1]] = 0.006
    changed = Scenario.model_validate(document)
    return changed.on(MEASURED) if changed.road.profile else changed


def triangles(*peaks: float) -> list[dict[str, object]]:
    """Fuzzy sets of Table 1's names."""
    ends = [2 * peaks[0] - peaks[1], *peaks, 2 * peaks[-1] - peaks[-2]]
    corners = zip(ends, ends[1:], ends[2:], strict=False)
    return [{"name": name, "function": "trimf", "corners": each} for name, each in zip("OSMLV", corners, strict=True)]


OWN_RULES = {
    "inputs": {"speed_error": triangles(0, 5, 11, 20, 30), "distance": triangles(0, 10, 30, 55, 80)},
    "output": triangles(0, 0.2, 0.45, 0.7, 1),
    "rules": [{"if": {"distance": "V"}, "then": "V"}, {"if": {"distance": "S"}, "then": "S"}],
}
POLICY = ("speed", "policy")  # says what else is read: its own test
LEAVES = [path for path in leaves(json.loads(BASE.model_dump_json())) if path != POLICY]


def is_read(strategy: str, path: tuple[str, ...]) -> bool:
    return any(is_within(".".join(path), part) for part in reads(STRATEGIES[strategy]))


def same(one: StrategyResult, two: StrategyResult) -> bool:
    """Bit for bit: every figure and every sample."""
    # By their texts: without a bump the speed there is not a number, which equals nothing.
    return repr(one.summary()) == repr(two.summary()) and all(
        np.array_equal(one.series[name], two.series[name]) for name in one.series
    )


@every_strategy
def test_fields_not_read_change_nothing_at_all(strategy: str) -> None:
    base = simulate(BASE, strategy)
    unread = [path for path in LEAVES if not is_read(strategy, path)]
    assert unread
    for path in unread:
        changed = with_leaf(path)
        assert changed != BASE
        assert values_read(changed, STRATEGIES[strategy]) == values_read(BASE, STRATEGIES[strategy]), path
        assert same(simulate(changed, strategy), base), path


# Fields that are read but need not show in this scenario.
SILENT = {
    ("speed", "controller"),  # the guard only acts where fuzzy alone would be late
    ("brake", "threshold_speed"),  # tanh is 1 to the last bit at any speed driven here
    ("mpc", "solver"),  # either finds the same optimum
    ("road", "seed"),
    ("vehicle", "bump_stop_stiffness"),  # there are no stops
    ("estimation", "acceleration_noise"),  # the state is told exactly
    ("estimation", "deflection_noise"),
    ("estimation", "pitch_rate_noise"),
    ("estimation", "knows_preview"),
    ("hook", "min_damping"),  # no damper is semi-active
    ("hook", "max_damping"),
}


@every_strategy
def test_a_part_read_whole_has_the_key_of_its_fields(strategy: str, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = values_read(BASE, STRATEGIES[strategy])
    # A field that is added to the part, and that nobody reads, splits its name into those of the others.
    names = [".".join(path) for path in LEAVES if is_read(strategy, path)]
    monkeypatch.setattr(strategies, "dependencies", lambda *_: names)
    assert values_read(BASE, STRATEGIES[strategy]) == whole


@every_strategy
def test_fields_read_change_the_key_and_the_result(strategy: str) -> None:
    base = simulate(BASE, strategy)
    silent = []
    for path in LEAVES:
        if not is_read(strategy, path):
            continue
        changed = with_leaf(path)
        assert values_read(changed, STRATEGIES[strategy]) != values_read(BASE, STRATEGIES[strategy]), path
        if path not in SILENT and same(simulate(changed, strategy), base):
            silent.append(".".join(path))
    # Parts are read whole; these of their fields do nothing for these strategies here.
    only_braking = {f"vehicle.{name}" for name in ("cg_height", "anti_dive", "anti_lift", "front_brake_share")}
    allowed = only_braking if STRATEGIES[strategy].speed_plan != "planned" else set()
    assert set(silent) <= allowed


@every_strategy
def test_whether_the_filter_knows_the_preview_is_read_by_those_who_look_ahead(strategy: str) -> None:
    told, untold = (
        BASE.model_copy(update={"estimation": Estimation(kind="kalman", knows_preview=each)}) for each in (True, False)
    )
    looks_ahead = is_read(strategy, ("mismatch", "preview_offset"))
    assert is_read(strategy, ("estimation", "knows_preview")) == looks_ahead
    assert (values_read(told, STRATEGIES[strategy]) == values_read(untold, STRATEGIES[strategy])) == (not looks_ahead)
    assert same(simulate(told, strategy), simulate(untold, strategy)) == (not looks_ahead)


@every_strategy
def test_the_speed_policy_changes_the_key_exactly_where_it_changes_the_result(strategy: str) -> None:
    base, own = simulate(BASE, strategy), STRATEGIES[strategy].speed_plan
    for policy in ("planned", "constant"):
        changed = BASE.model_copy(update={"speed": BASE.speed.model_copy(update={"policy": policy})})
        result = simulate(changed, strategy)
        assert same(result, base) == (policy == own)
        assert (values_read(changed, STRATEGIES[strategy]) == values_read(BASE, STRATEGIES[strategy])) == (
            policy == own
        )
        # What is read follows the speed that is driven: a target matters where somebody slows down.
        slower = changed.model_copy(update={"speed": changed.speed.model_copy(update={"target_speed_kmh": 19.0})})
        assert (values_read(slower, STRATEGIES[strategy]) == values_read(changed, STRATEGIES[strategy])) == (
            policy == "constant"
        )
        assert same(simulate(slower, strategy), result) == (policy == "constant")


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


def scenario_of(variant: str) -> Scenario:
    scenario = Scenario.model_validate(dotted.with_changes(BASE.model_dump(mode="json"), VARIANTS[variant]))
    return scenario.on(MEASURED) if scenario.road.profile else scenario


@every_strategy
def test_a_field_has_an_effect_only_where_the_conditions_of_its_reading_hold(strategy: str) -> None:
    """Under each variant what has no effect changes nothing at all, and each field has one under some variant."""
    groups = conditional_reads(STRATEGIES[strategy])
    always = {name for group in groups if not group.conditions for name in group.fields}
    silent, effective = set[str](), set[str]()
    for variant in VARIANTS:
        scenario = scenario_of(variant)
        plain, base = scenario.model_dump(mode="json"), simulate(scenario, strategy)
        for path in LEAVES:
            name = ".".join(path)
            covering = [group for group in groups if any(is_within(name, each) for each in group.fields)]
            if not covering or any(is_within(name, each) for each in always):
                continue
            has_effect = any(all(each.is_met(plain) for each in group.conditions) for group in covering)
            if has_effect and name in effective:
                continue
            if variant == "no bump" and name in ONLY_WITH_A_BUMP:
                assert not has_effect, name
            unchanged = same(simulate(with_leaf(path, scenario), strategy), base)
            assert unchanged or has_effect, (variant, name)
            (silent if unchanged else effective).add(name)
    assert silent - effective <= {".".join(path) for path in SILENT}


@every_strategy
def test_runs_leave_no_trace_in_each_other(strategy: str) -> None:
    """Results cached between runs change none of them, in any order and whatever a caller does with them."""
    first = simulate(BASE, strategy)
    copies = {name: values.copy() for name, values in first.series.items()}
    simulate(with_leaf(("road", "bump", "height")), strategy)
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
        scenario = scenario_of(variant)
        scenario = scenario.model_copy(update={"speed": scenario.speed.model_copy(update={"policy": policy})})
        assert undeclared_reads(scenario, STRATEGIES[strategy]) == []
        result, names = record_accesses(scenario, lambda recording: simulate(recording, strategy))
        assert same(result, simulate(scenario, strategy)), "recording changes nothing"
        looked_at |= names
        declared |= set(reads_in(scenario, STRATEGIES[strategy]))
    leaves = {".".join(path) for path in LEAVES}
    assert {each for each in leaves if any(is_within(each, part) for part in declared)} == looked_at & leaves
    assert all(any(is_within(each, part) for part in reads(STRATEGIES[strategy], policy)) for each in declared)


def classes_of(file: Path) -> list[type[Controller]]:
    """The controllers of an example, or those that the Python of a page of the manual defines."""
    if file.suffix == ".py":
        return list(load_controllers(file).values())
    names: dict[str, Any] = {"__name__": file.stem}
    for block in re.findall(r"```python\n(.*?)```", file.read_text(), flags=re.DOTALL):
        kinds = ast.ClassDef | ast.Import | ast.ImportFrom
        defining: list[ast.stmt] = [node for node in ast.parse(block).body if isinstance(node, kinds)]
        exec(compile(ast.Module(defining, []), str(file), "exec"), names)  # noqa: S102 - ours
    return [each for each in names.values() if isinstance(each, type) and issubclass(each, Controller) and each.id]


EXAMPLES = [
    *sorted((ROOT / "examples" / "controllers").glob("*.py")),
    ROOT / "sim_core" / "README.md",
    *sorted(file for file in (ROOT / "docs").rglob("*.md") if "\nclass " in file.read_text()),
]


@pytest.mark.parametrize("file", EXAMPLES, ids=lambda file: file.stem)
def test_examples_look_at_no_field_that_is_not_declared(file: Path) -> None:
    classes = classes_of(file)
    assert classes
    for kind in classes:
        for variant in WATCHED:
            try:
                assert undeclared_reads(scenario_of(variant), kind) == []
            except RidelabError:
                assert kind.__name__ in ("Forgetful", "Blind"), "an example of what the check finds"


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
