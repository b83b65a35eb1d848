"""LV control as one usually writes it: condensed once, then per step a warm-started OSQP solve and ten plant steps.

Its problem is data, so that what sim_core is measured against never changes with sim_core: the paper's scenario on the
road of seed 1000, in plain_osqp_loop.npz. The core 0.4.0 wrote that file once, at commit d2e4bd1b58cd, by
`python -m benchmarks.freeze_baseline` (`git show d2e4bd1b58cd:benchmarks/freeze_baseline.py`).

What the loop lacks is what sim_core adds: skipping the solver where no limit binds, driving many steps at once, and
keeping what runs share.
"""

from dataclasses import dataclass
from pathlib import Path
from time import process_time

import numpy as np
import osqp
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, triu

Array = NDArray[np.float64]
SEED = 1000  # of the road
STAGES = ("cruise", "brake", "bump")
NEWTON_PER_KILO, CM_PER_M = 1000.0, 100.0  # forces in kN and slacks in cm: fairly scaled
SLACK_PRICE = 1e5 / CM_PER_M  # linear
SETTINGS = {"eps_abs": 1e-5, "eps_rel": 1e-5, "max_iter": 10_000, "verbose": False}


@dataclass(frozen=True, kw_only=True)
class PlainRun:
    """Outputs on the fine grid from x = 0 on (n, 8), control steps, how many OSQP left unsolved, processor time [s]."""

    output: Array
    steps: int
    unsolved: int
    seconds: float


class OsqpStage:
    """One stage's QP, set up once and updated in every step."""

    def __init__(self, data: dict[str, Array], stage: str) -> None:
        self.linear, self.travel = data[f"{stage}_linear"], data["travel"]
        self.high, self.travel_limit = data["high"], float(data["travel_limit"])
        hessian, rows = data[f"{stage}_hessian"], data["rows"]
        self.lower = np.concatenate([data["low"], np.full(len(rows), -np.inf)])
        self.q = np.zeros(len(hessian))
        self.q[-2:] = SLACK_PRICE
        self.solver = osqp.OSQP()
        upper = np.concatenate([self.high, np.full(len(rows), self.travel_limit)])
        on_all = csc_matrix(np.vstack([np.eye(len(hessian)), rows]))
        self.solver.setup(P=csc_matrix(triu(hessian)), q=self.q, A=on_all, l=self.lower, u=upper, **SETTINGS)

    def force(self, parameters: Array) -> tuple[Array, bool]:
        """First force [N] for [state; previous command; preview], and whether OSQP calls it solved."""
        self.q[:-2] = self.linear @ parameters
        travel = self.travel @ parameters
        upper = np.concatenate([self.high, self.travel_limit - travel, self.travel_limit + travel])
        self.solver.update(q=self.q, l=self.lower, u=upper)
        result = self.solver.solve()
        return result.x[:2] * NEWTON_PER_KILO, result.info.status_val == osqp.SolverStatus.OSQP_SOLVED


def load() -> dict[str, Array]:
    """The problem: each stage's cost, limits, plant, and over the drive the road, its preview and the stage."""
    with np.load(Path(__file__).with_suffix(".npz"), allow_pickle=False) as stored:
        return dict(stored)


def run(data: dict[str, Array]) -> PlainRun:
    """LV over the stored road; setting the solvers up is included in the time."""
    begin = process_time()
    problems = [OsqpStage(data, stage) for stage in STAGES]
    A, B, E, C, D, F = (data[f"plant_{name}"] for name in "ABECDF")
    road_preview, disturbance, limit = data["road_ahead"], data["disturbance"], float(data["force_limit"])
    horizon = road_preview.shape[1] - len(disturbance) + 1

    x, u, unsolved, outputs = np.zeros(8), np.zeros(2), 0, []
    for k, stage in enumerate(data["stages"].astype(int)):
        u, solved = problems[stage].force(np.concatenate([x, u, road_preview[:, k : k + horizon].ravel()]))
        u = np.clip(u, -limit, limit)
        unsolved += not solved
        for w in disturbance[k]:
            outputs.append(C @ x + D @ u + F @ w)
            x = A @ x + B @ u + E @ w
    return PlainRun(
        output=np.array(outputs)[slice(*data["on_record"].astype(int))],
        steps=len(disturbance),
        unsolved=unsolved,
        seconds=process_time() - begin,
    )
