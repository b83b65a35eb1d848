"""`POST /fuzzy`: what the fuzzy speed controller's sets and rules come to, computed in a worker."""

from collections.abc import Sequence

import numpy as np
from pydantic import Field

from backend.models import Answer, RequestModel, SentScenario
from sim_core.scenario import Scenario
from sim_core.scenario.fuzzy import DISTANCE_MAX, SPEED_ERROR_MAX, TABLE_1, Fuzzy, FuzzyRule, FuzzySet
from sim_core.speed.fuzzy import TorqueRules, memberships

COST = 0.01  # [s of one core]
_ERROR_STEPS, _DISTANCE_STEPS, _TORQUE_STEPS, _CURVE_STEPS = 30, 40, 500, 120  # of the universes


class FuzzyRequest(RequestModel):
    """Whose speed controller; nothing but the scenario's `fuzzy` is read."""

    scenario: SentScenario = Scenario()


class FuzzyVariable(Answer):
    """An input or the output: its sets, and how far each value of its universe belongs to them."""

    unit: str
    universe: list[float] = Field(description="Values at which the memberships are, in the unit, the sets' corners too")
    sets: list[FuzzySet] = Field(description="The scenario's, or the paper's where it has none")
    memberships: list[list[float]] = Field(description="Of each set at each value [1]")


class Surface(Answer):
    """The braking torque over both inputs."""

    speed_error: list[float] = Field(description="[km/h]")
    distance: list[float] = Field(description="[m]")
    torque: list[list[float]] = Field(description="At each distance, of each speed error, as a share of the greatest")


class FuzzyAnswer(Answer):
    """A rule base written out, and what it comes to by Mamdani's minimum and maximum and the centroid."""

    speed_error: FuzzyVariable
    distance: FuzzyVariable
    torque: FuzzyVariable
    rules: list[FuzzyRule] = Field(description="The scenario's, or Table 1 where it has none")
    surface: Surface


def fuzzy_answer(fuzzy: Fuzzy) -> FuzzyAnswer:
    """The answer, computed."""
    surface = TorqueRules(fuzzy, _ERROR_STEPS, _DISTANCE_STEPS, _TORQUE_STEPS).surface()
    return FuzzyAnswer(
        speed_error=_variable("km/h", fuzzy.speed_errors, SPEED_ERROR_MAX),
        distance=_variable("m", fuzzy.distances, DISTANCE_MAX),
        torque=_variable("1", fuzzy.torques, 1.0),
        rules=list(fuzzy.rules or TABLE_1),
        surface=Surface(
            speed_error=np.linspace(0, SPEED_ERROR_MAX, _ERROR_STEPS + 1).tolist(),
            distance=np.linspace(0, DISTANCE_MAX, _DISTANCE_STEPS + 1).tolist(),
            torque=surface.tolist(),
        ),
    )


def _variable(unit: str, sets: Sequence[FuzzySet], end: float) -> FuzzyVariable:
    corners = [corner for each in sets for corner in each.corners if 0 < corner < end]
    universe = np.union1d(np.linspace(0, end, _CURVE_STEPS + 1), corners)
    return FuzzyVariable(
        unit=unit, universe=universe.tolist(), sets=list(sets), memberships=memberships(tuple(sets), universe).tolist()
    )
