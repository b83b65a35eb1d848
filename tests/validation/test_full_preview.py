"""No linear law costs less than the forces that are best for the whole road, found by least squares from scratch.

That is the bound of every preview: the regulator told of the whole road reaches it, others do not fall below.
"""

import numpy as np
import pytest

from sim_core import FloatArray, LinearLaw, Scenario, feedforward, regulator
from sim_core.control.cost import KILO, CostTerms, stage_cost
from sim_core.simulate import prepare
from sim_core.vehicle.half_car import FORCES, STATES, discrete

STEPS, SPEED, SAMPLE_TIME = 140, 14.0, 0.01
SETTLING = 40  # the last steps have a smooth road
TERMS = CostTerms(
    vehicle=Scenario().vehicle,
    speed=SPEED,
    sample_time=SAMPLE_TIME,
    weights=(8, 1, 1),
    deflection_weight=3.0,
    deflection_limit=0.08,
    force_weight=1e-9,
)
LAWS = ("passive", "skyhook", "groundhook", "hybrid", "lqr", "lv", "suspension_only")


def road() -> FloatArray:
    """Disturbances (STEPS, 3): white road velocities, at the rear axle later by the wheelbase; no deceleration."""
    front = np.random.default_rng(1).normal(0, 0.3, STEPS)
    front[-SETTLING:] = 0
    delay = round(Scenario().vehicle.wheelbase / SPEED / SAMPLE_TIME)
    assert delay < SETTLING
    return np.column_stack([front, np.r_[np.zeros(delay), front[:-delay]], np.zeros(STEPS)])


def outputs(forces: FloatArray, disturbances: FloatArray) -> FloatArray:
    """Whose sum of squares is the cost, of forces (STEPS, 2, n) [kN]: (13 STEPS + 8, n); what comes after is in it."""
    model = discrete(TERMS.vehicle, SAMPLE_TIME)
    root, last = (_root(matrix) for matrix in (stage_cost(TERMS), regulator(TERMS).P))
    state, rows = np.zeros((STATES, forces.shape[2])), []
    for force, disturbance in zip(forces, disturbances, strict=True):
        known = np.repeat(disturbance[:, None], forces.shape[2], axis=1)
        rows.append(root @ np.vstack([state, force, known]))
        state = model.A @ state + model.B @ force * KILO + model.E @ known
    return np.vstack([*rows, last @ state])


def _root(matrix: FloatArray) -> FloatArray:
    values, vectors = np.linalg.eigh(matrix)
    return np.asarray(np.sqrt(np.maximum(values, 0))[:, None] * vectors.T)


def least_cost(disturbances: FloatArray) -> float:
    """Over all forces there are."""
    alone = outputs(np.zeros((STEPS, FORCES, 1)), disturbances)
    impulses = np.eye(STEPS * FORCES).reshape(STEPS, FORCES, -1)
    effect = outputs(impulses, np.zeros_like(disturbances))
    best, *_ = np.linalg.lstsq(effect, -alone[:, 0])
    return float(np.sum((effect @ best + alone[:, 0]) ** 2))


def cost(law: LinearLaw, disturbances: FloatArray) -> float:
    """Of a law that is told as much of the road as it asks for."""
    model = discrete(TERMS.vehicle, SAMPLE_TIME)
    ahead = 0 if law.preview_gain is None else law.preview_gain.shape[1] // 3
    told = np.vstack([disturbances, np.zeros((ahead, 3))])
    state, force, forces = np.zeros(STATES), np.zeros(FORCES), []
    for step, disturbance in enumerate(disturbances):
        force = law.force(state, force, told[step : step + ahead].T)
        forces.append(force / KILO)
        state = model.A @ state + model.B @ force + model.E @ disturbance
    return float(np.sum(outputs(np.array(forces)[:, :, None], disturbances) ** 2))


def law_of(name: str, preview: str, horizon: int) -> LinearLaw:
    """Return a strategy's law with the weights of TERMS."""
    weights, mpc = TERMS.weights, {"preview": preview, "prediction_horizon": horizon, "control_horizon": horizon}
    stages = {"stage_weights": dict.fromkeys(("cruise", "brake", "bump"), weights)}
    stages["road_weights"] = dict.fromkeys(("rough", "bump"), weights)
    run = prepare(
        Scenario.model_validate(
            {
                "mpc": {**mpc, **stages},
                "lqr": {"weights": weights, "preview": preview, "preview_horizon": horizon},
                "speed": {"initial_speed_kmh": 3.6 * SPEED, "policy": "constant"},
            }
        ),
        name,
    )
    run.controller.start(run.setup())
    law = run.controller.linear_law("bump")
    assert law is not None
    return law


@pytest.fixture(scope="module")
def least() -> float:
    return least_cost(road())


def test_the_regulator_that_is_told_of_the_whole_road_reaches_it(least: float) -> None:
    law = LinearLaw(gain=law_of("lqr", "none", 1).gain, preview_gain=feedforward(TERMS, STEPS))
    assert cost(law, road()) == pytest.approx(least, rel=1e-9)  # rounding of 140 steps


@pytest.mark.parametrize("name", LAWS)
def test_no_law_costs_less(name: str, least: float) -> None:
    costs = {horizon: cost(law_of(name, "lookahead", horizon), road()) for horizon in (10, 40)}
    assert min(costs.values()) >= least * (1 - 1e-9)
    if name in ("lqr", "lv", "suspension_only"):  # told of 0.4 s they come near: the bound is no empty one
        assert costs[40] < 1.01 * least < costs[10]
