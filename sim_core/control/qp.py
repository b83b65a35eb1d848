"""A predictive controller's QPs: min ½ y'Hy + f'y, low <= y <= high, A y <= b, in kN and cm, by two solvers.

One is a dual active-set method in C (kernel/qp.c), the other OSQP. An answer counts only if it is finite and its
residuals of the optimality conditions, which that C computes from the QP itself, are small; solvers may err.
"""

from typing import TYPE_CHECKING

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.cost import KILO
from sim_core.kernel.qp import QpDesign, QpMemory
from sim_core.vehicle.half_car import FORCES

if TYPE_CHECKING:
    import osqp

AXLES = 2
CENTI = 100.0  # deflections and slacks are in cm
TOLERANCE = 1e-6  # of the residuals
SOLVERS = "daqp", "osqp"  # a scenario's names for the dual active-set method and for OSQP
MOST_ITERATIONS = 1000  # of the dual method in one QP
MAX_EFFORT = 20.0  # of all QPs of one run, as kernel/qp.c and `osqp_effort` have it [s]
_OSQP_SETTINGS = {
    "eps_abs": 1e-6,
    "eps_rel": 1e-6,
    "max_iter": 2000,
    "polishing": True,  # exact once the active set is right: agrees with the dual method to 1e-13
    "scaled_termination": False,
    "verbose": False,
}


class Qps(QpMemory):
    """All QPs of a run, by either solver."""

    def __init__(self, design: QpDesign) -> None:
        super().__init__(design, MAX_EFFORT)
        self._osqp: dict[QpDesign, OsqpSolver] = {}

    def solve(self, design: QpDesign, solver: str, inputs: FloatArray) -> FloatArray | None:
        """Return the optimal forces (2,) [N] of a control step; None without a proven answer.

        Args:
            design: Of its driving stage.
            solver: One of SOLVERS.
            inputs: State, previous force [N], preview.
        """
        if solver == "daqp":
            return self.solve_in_c(design, inputs)
        self.pose(design, inputs)
        if design not in self._osqp:
            self._osqp[design] = OsqpSolver(design)
        answer, iterations = self._osqp[design].solve(self.f, self.b)
        self.counts[1] += osqp_effort(iterations, len(self.f), len(self.b))
        if answer is None:
            return None
        self.y[:], self.multipliers[:] = answer
        if not self.residual(design) <= TOLERANCE:
            return None
        self.counts[0] += 1
        self.counts[3] = max(self.counts[3], self.y[-AXLES:].max() / CENTI)
        return self.y[:FORCES] * KILO


class OsqpSolver:
    """Operator splitting (Stellato et al. 2020), in whitened variables v = L'y with H = L L' and unit rows."""

    def __init__(self, design: QpDesign) -> None:
        from scipy.sparse import csc_matrix, triu

        self._model: osqp.OSQP | None = None
        n, rows = design.columns.shape
        self._whiten = np.linalg.inv(np.linalg.cholesky(design.H)).T  # y = whiten v
        on_v = np.vstack([self._whiten, design.columns.T @ self._whiten])
        self._norm = np.linalg.norm(on_v, axis=1)
        self._rows = csc_matrix(on_v / self._norm[:, None])
        self._eye = csc_matrix(triu(np.eye(n)))
        self._lower = np.concatenate([design.low / self._norm[:n], np.full(rows, -1e30)])  # its infinity
        self._high = design.high

    def solve(self, f: FloatArray, b: FloatArray) -> tuple[tuple[FloatArray, FloatArray] | None, int]:
        """Y and multipliers, if it says solved, and its iterations."""
        import osqp  # a tenth of a second, and rarely asked for

        upper, q = np.concatenate([self._high, b]) / self._norm, self._whiten.T @ f
        if self._model is None:
            self._model = osqp.OSQP()
            self._model.setup(P=self._eye, q=q, A=self._rows, l=self._lower, u=upper, **_OSQP_SETTINGS)
        else:
            self._model.update(q=q, l=self._lower, u=upper)
        result = self._model.solve(raise_error=False)
        solved = result.info.status_val == osqp.SolverStatus.OSQP_SOLVED
        answer = (self._whiten @ result.x, result.y / self._norm) if solved else None
        return answer, int(result.info.iter)


def osqp_effort(iterations: float, free: int, rows: int) -> float:
    """About the time of one QP with so many unknowns and rows of A [s]; the same on every machine.

    Each iteration solves with a factor of the whole dense problem; polishing factors it anew.
    """
    return 6e-5 + 3e-9 * free**3 + 7.5e-10 * iterations * (free + 6) * (free + rows + 57)
