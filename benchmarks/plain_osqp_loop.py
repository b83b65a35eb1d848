"""LV control as one usually writes it: condense once, then per step a warm-started OSQP solve and ten plant steps.

It solves sim_core's problem: equal matrices (forces in kN, slacks in cm: fairly scaled), road, speed plan,
preview, limits and weights by stage, and the same outputs on the same fine grid. What it lacks is what sim_core adds:
skipping the solver where no limit binds, driving many steps at once, and keeping what runs share.
"""

from dataclasses import dataclass
from time import perf_counter

import numpy as np
import osqp
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, triu

from sim_core.control.cost import CostTerms
from sim_core.control.mpc_design import SLACK_LINEAR, Horizon, MpcDesign, design
from sim_core.loop.excitation import excite, fine_step
from sim_core.loop.preview import preview_windows
from sim_core.scenario import Scenario
from sim_core.speed.profile import plan_speed
from sim_core.speed.stages import coordinated_weights, segments, spans
from sim_core.strategies import strategy_named
from sim_core.vehicle.half_car import discrete

Array = NDArray[np.float64]
NEWTON_PER_KILO, CM_PER_M = 1000.0, 100.0
SETTINGS = {"eps_abs": 1e-5, "eps_rel": 1e-5, "max_iter": 10_000, "verbose": False}


@dataclass(frozen=True, kw_only=True)
class PlainRun:
    """Outputs on the fine grid from x = 0 on (n, 8), control steps, how many OSQP left unsolved, and seconds taken."""

    output: Array
    steps: int
    unsolved: int
    seconds: float


class OsqpStage:
    """One stage's QP, set up once and updated in every step."""

    def __init__(self, design: MpcDesign) -> None:
        self.design, shape = design, design.shape
        rows = csc_matrix(np.vstack([np.eye(len(shape.H)), shape.A]))
        self.lower = np.concatenate([shape.low, np.full(len(shape.A), -np.inf)])
        self.q = np.zeros(len(shape.H))
        self.q[-2:] = SLACK_LINEAR / CM_PER_M
        self.solver = osqp.OSQP()
        upper = np.concatenate([shape.high, np.full(len(shape.A), design.travel_limit)])
        self.solver.setup(P=csc_matrix(triu(shape.H)), q=self.q, A=rows, l=self.lower, u=upper, **SETTINGS)

    def force(self, parameters: Array) -> tuple[Array, bool]:
        """First force [N] for [state; previous command; preview], and whether OSQP calls it solved."""
        design = self.design
        self.q[:-2] = design.linear @ parameters
        travel = design.travel @ parameters
        upper = np.concatenate([design.shape.high, design.travel_limit - travel, design.travel_limit + travel])
        self.solver.update(q=self.q, l=self.lower, u=upper)
        result = self.solver.solve()
        return result.x[:2] * NEWTON_PER_KILO, result.info.status_val == osqp.SolverStatus.OSQP_SOLVED


def run(scenario: Scenario) -> PlainRun:
    """LV over the scenario, set-up included in the time."""
    begin = perf_counter()
    strategy, mpc, car = strategy_named("lv"), scenario.mpc, scenario.vehicle
    motion = plan_speed(scenario, strategy.speed)
    excitation = excite(scenario.road, car.wheelbase, motion, mpc.sample_time, fine_step(scenario, strategy))
    windows = preview_windows(mpc.preview, scenario.road, motion, excitation, mpc.prediction_horizon, car.wheelbase)
    horizon = Horizon(
        prediction=mpc.prediction_horizon,
        control=mpc.control_horizon,
        force_limit=mpc.force_limit,
        force_change_weight=mpc.force_change_weight,
    )
    problems = {}
    for stage in ("cruise", "brake", "bump"):
        terms = CostTerms(
            vehicle=car,
            speed=motion.initial_speed,
            sample_time=mpc.sample_time,
            weights=coordinated_weights(scenario, strategy, stage),
            deflection_weight=mpc.deflection_weight,
            deflection_limit=mpc.deflection_limit,
            force_weight=mpc.force_weight,
        )
        problems[stage] = OsqpStage(design(terms, horizon))
    plant = discrete(car, excitation.fine_step)
    disturbance = excitation.disturbance.reshape(-1, excitation.fine, 3)

    x, u, unsolved, outputs = np.zeros(8), np.zeros(2), 0, []
    for stage, first, last in segments(spans(scenario, strategy, motion), excitation.position):
        for k in range(first, last):
            u, solved = problems[stage].force(np.concatenate([x, u, windows[k]]))
            u = np.clip(u, -mpc.force_limit, mpc.force_limit)
            unsolved += not solved
            for w in disturbance[k]:
                outputs.append(plant.C @ x + plant.D @ u + plant.F @ w)
                x = plant.A @ x + plant.B @ u + plant.E @ w
    return PlainRun(
        output=np.array(outputs)[excitation.on_record],
        steps=len(disturbance),
        unsolved=unsolved,
        seconds=perf_counter() - begin,
    )
