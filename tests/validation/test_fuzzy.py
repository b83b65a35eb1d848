"""The fast torque surface against scikit-fuzzy's own control system and Table 1."""

import numpy as np
import pytest
from skfuzzy import control

from sim_core.speed.fuzzy import torque_surface

SETS = ["O", "S", "M", "L", "V"]
# Table 1 of the paper: one row per distance e_s from O to V, one column per speed error e_v from O to V.
TABLE_1 = """
O M L V V
O M L V V
O S M L L
O S M M L
O S S M M
"""


@pytest.fixture(scope="module")
def direct() -> control.ControlSystemSimulation:
    """Table 1 as a plain scikit-fuzzy control system, torque as a share of its universe."""
    error = control.Antecedent(np.linspace(0, 30, 121), "error")
    distance = control.Antecedent(np.linspace(0, 80, 161), "distance")
    torque = control.Consequent(np.linspace(0, 1, 401), "torque", defuzzify_method="centroid")
    for variable in (error, distance, torque):
        variable.automf(names=SETS)
    rules = [
        control.Rule(distance[row] & error[column], torque[conclusion])
        for row, line in zip(SETS, TABLE_1.split("\n")[1:6], strict=True)
        for column, conclusion in zip(SETS, line.split(), strict=True)
    ]
    return control.ControlSystemSimulation(control.ControlSystem(rules))


# scikit-fuzzy's control module calls numpy with an argument form that numpy has deprecated.
@pytest.mark.filterwarnings("ignore:Passing more than 2 positional:DeprecationWarning:skfuzzy")
@pytest.mark.parametrize(
    ("error", "distance"),
    [
        (0, 0),
        (30, 0),
        (30, 80),
        (0, 80),
        (15, 40),
        (27.5, 80),
        (27.5, 60),
        (3.3, 11.1),
        (9.9, 71.3),
        (22.2, 33.3),
        (7.5, 20),
    ],
)
def test_surface_equals_the_direct_evaluation(
    direct: control.ControlSystemSimulation, error: float, distance: float
) -> None:
    """Within 0.3 % of the universe: the surface's grid is 0.25 km/h x 0.5 m, its torque step 1/200."""
    direct.input["error"] = error
    direct.input["distance"] = distance
    direct.compute()
    assert torque_surface().share(error, distance) == pytest.approx(float(direct.output["torque"]), abs=0.003)


def test_at_the_peaks_of_the_sets_the_surface_is_table_1() -> None:
    """At a peak one rule fires fully: its set's centroid, 1/12, 1/4, 1/2, 3/4 or 11/12 of the universe."""
    centroid = {"O": 1 / 12, "S": 1 / 4, "M": 1 / 2, "L": 3 / 4, "V": 11 / 12}
    for row, line in enumerate(TABLE_1.split("\n")[1:6]):
        for column, conclusion in enumerate(line.split()):
            share = torque_surface().share(7.5 * column, 20.0 * row)
            assert share == pytest.approx(centroid[conclusion], abs=1e-3), (row, column)


def test_inputs_are_clipped_to_their_universes() -> None:
    surface = torque_surface()
    assert surface.share(300, -5) == surface.share(30, 0)
    assert surface.share(-3, 500) == surface.share(0, 80)
