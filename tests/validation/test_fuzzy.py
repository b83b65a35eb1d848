"""The speed controller's rule base against scikit-fuzzy's own control system, and Table 1."""

from typing import Any

import networkx
import numpy as np
import pytest
from pydantic import ValidationError
from skfuzzy import control

from sim_core import Fuzzy
from sim_core.scenario.fuzzy import TABLE_1 as RULES_OF_TABLE_1
from sim_core.scenario.fuzzy import FuzzySet
from sim_core.speed.fuzzy import memberships, torque_rules
from tests.validation.strategies import examples

# scikit-fuzzy's control module calls numpy with an argument form that numpy has deprecated.
pytestmark = pytest.mark.filterwarnings("ignore:Passing more than 2 positional:DeprecationWarning:skfuzzy")

SETS = ["O", "S", "M", "L", "V"]
# Table 1 of the paper: one row per distance e_s from O to V, one column per speed error e_v from O to V.
TABLE_1 = """
O M L V V
O M L V V
O S M L L
O S M M L
O S S M M
"""
UNIVERSES = {"speed_error": np.linspace(0, 30, 601), "distance": np.linspace(0, 80, 801)}
TORQUES = np.linspace(0, 1, 1001)


def control_system(fuzzy: Fuzzy) -> control.ControlSystemSimulation:
    """The same rule base as a plain scikit-fuzzy control system, torque as a share of its universe."""
    sets = {"speed_error": fuzzy.speed_errors, "distance": fuzzy.distances}
    inputs = {name: control.Antecedent(universe, name) for name, universe in UNIVERSES.items()}
    torque = control.Consequent(TORQUES, "torque", defuzzify_method="centroid")
    for variable, universe, of_variable in (
        *((inputs[name], UNIVERSES[name], sets[name]) for name in inputs),
        (torque, TORQUES, fuzzy.torques),
    ):
        for each, values in zip(of_variable, memberships(of_variable, universe), strict=True):
            variable[each.name] = values
    rules = []
    for rule in fuzzy.rules or RULES_OF_TABLE_1:
        asked = [inputs[name][of] for name, of in rule.condition.model_dump().items() if of is not None]
        rules.append(control.Rule(asked[0] & asked[1] if len(asked) == 2 else asked[0], torque[rule.then]))
    system = control.ControlSystem()
    system.graph = networkx.compose_all(rule.graph for rule in rules)  # one by one takes the square of their number
    return control.ControlSystemSimulation(system)


def directly(system: control.ControlSystemSimulation, error: float, distance: float) -> float:
    for name, value in (("speed_error", error), ("distance", distance)):
        if any(each.label == name for each in system.ctrl.antecedents):
            system.input[name] = value
    system.compute()
    return float(system.output["torque"])


def test_at_the_peaks_of_the_sets_the_surface_is_table_1() -> None:
    """At a peak one rule fires fully: its set's centroid, 1/12, 1/4, 1/2, 3/4 or 11/12 of the universe."""
    centroid = {"O": 1 / 12, "S": 1 / 4, "M": 1 / 2, "L": 3 / 4, "V": 11 / 12}
    for row, line in enumerate(TABLE_1.split("\n")[1:6]):
        for column, conclusion in enumerate(line.split()):
            share = torque_rules(Fuzzy()).share(7.5 * column, 20.0 * row)
            assert share == pytest.approx(centroid[conclusion], abs=1e-3), (row, column)


def test_inputs_are_clipped_to_their_universes() -> None:
    surface = torque_rules(Fuzzy())
    assert surface.share(300, -5) == surface.share(30, 0)
    assert surface.share(-3, 500) == surface.share(0, 80)


def drawn_set(rng: np.random.Generator, name: str, low: float, high: float) -> dict[str, Any]:
    """Any membership function, somewhere on the universe; as steep as a fifteenth of it."""
    least = (high - low) / 15
    function = str(rng.choice(["trimf", "trapmf", "gaussmf", "gauss2mf", "gbellmf", "sigmf", "smf", "zmf", "pimf"]))
    number = {"trimf": 3, "smf": 2, "zmf": 2}.get(function, 4)
    first, gaps = rng.uniform(low - least, high - 2 * least), rng.uniform(least, 5 * least, 3)
    corners = [first, *(first + np.cumsum(gaps))][:number]
    width, mean = rng.uniform(least, 5 * least), rng.uniform(low, high)
    match function:
        case "gaussmf":
            corners = [mean, width]
        case "gauss2mf":
            corners = [corners[0], width, corners[1], width / 2]
        case "gbellmf":
            corners = [width, rng.uniform(1, 4), mean]
        case "sigmf":
            corners = [mean, rng.choice([-1, 1]) * 2 / width]
    return {"name": name, "function": function, "corners": [float(each) for each in corners]}


def drawn(seed: int) -> Fuzzy:
    """A rule base: two to six sets of each, any of them perhaps Table 1's, and rules for one input or both."""
    rng = np.random.default_rng(seed)

    def sets(high: float) -> list[dict[str, Any]]:
        return [drawn_set(rng, f"set{i}", 0, high) for i in range(rng.integers(2, 7))]

    inputs = {"speed_error": sets(30), "distance": sets(80)} if rng.random() < 0.8 else None
    output = sets(1) if rng.random() < 0.8 else None
    errors, distances, torques = (
        [each["name"] for each in of] if of else SETS
        for of in (inputs and inputs["speed_error"], inputs and inputs["distance"], output)
    )
    rules = []
    for _ in range(rng.integers(3, 26)):
        asked = {"speed_error": str(rng.choice(errors)), "distance": str(rng.choice(distances))}
        if rng.random() < 0.2:
            del asked[str(rng.choice(list(asked)))]
        rules.append({"if": asked, "then": str(rng.choice(torques))})
    return Fuzzy.model_validate({"inputs": inputs, "output": output, "rules": rules})


def test_rule_bases_are_scikit_fuzzys() -> None:
    """Table 1 and random ones (200 in `make drill`), within 0.1 % of full scale at three points each."""
    compared = 0
    for number in range(examples(200)):
        fuzzy = drawn(number) if number else Fuzzy()
        own, direct = torque_rules(fuzzy), control_system(fuzzy)
        for error, distance in np.random.default_rng(number).uniform([0, 0], [30, 80], (3, 2)).tolist():
            share = own.share(error, distance)
            if share == 0:  # no rule holds, which scikit-fuzzy refuses
                continue
            assert share == pytest.approx(directly(direct, error, distance), abs=0.001), number
            compared += 1
    assert compared > 2 * examples(200)


def test_where_no_rule_holds_nothing_brakes() -> None:
    far_alone = torque_rules(Fuzzy.model_validate({"rules": [{"if": {"distance": "V"}, "then": "V"}]}))
    assert far_alone.share(20, 59.9) == 0
    assert far_alone.share(20, 80) == pytest.approx(11 / 12, abs=1e-3)


@pytest.mark.parametrize("corners", [(0, 0, 1, 1), (0, 1, 1, 2), (0, 0, 0, 1), (0, 1, 1, 1)])
def test_a_trapezoids_corners_may_coincide(corners: tuple[float, ...]) -> None:
    """Upright sides and a triangle are trapezoids; a single point is none, nor are corners that go back."""
    assert FuzzySet(name="set", function="trapmf", corners=corners).corners == corners
    for wrong in ((1, 1, 1, 1), (0, 2, 1, 3)):
        with pytest.raises(ValidationError):
            FuzzySet(name="set", function="trapmf", corners=wrong)
