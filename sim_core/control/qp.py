"""Small dense QPs: min ½ y'Hy + f'y, low <= y <= high, A y <= b; DAQP and OSQP behind one face.

No solver's word is taken: an answer counts only if it is finite and its own optimality residuals, computed here, are
small. OSQP raises nothing by default and may return a huge y for an infeasible problem.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import daqp
import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel import prepared

if TYPE_CHECKING:
    import osqp

SolverName = Literal["daqp", "osqp"]
TOLERANCE = 1e-6  # of the residuals
MAX_EFFORT = 20.0  # of all QPs of one run, by `QpSolver.effort` [s]
_NO_LIMIT = 1e30  # what both solvers take as infinity
_OSQP_SETTINGS = {
    "eps_abs": 1e-6,
    "eps_rel": 1e-6,
    "max_iter": 2000,
    "polishing": True,  # exact once the active set is right: agrees with DAQP to 1e-13
    "scaled_termination": False,
    "verbose": False,
}


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class QpShape:
    """What stays the same from step to step: H (n, n) positive definite, A (m, n), low and high (n,)."""

    H: FloatArray
    A: FloatArray
    low: FloatArray
    high: FloatArray


class QpProblem:
    """QPs of one shape, one after another, as one run has them: `f` (n,) and `b` (m,) are written before each.

    `upper` (n + m,) is [high; b], of which `b` is a part, and `lower` is [low; none]. `spent` is what its solvers took
    so far, by `QpSolver.effort` [s].
    """

    def __init__(self, shape: QpShape) -> None:
        self.shape = shape
        self.spent = 0.0
        n, rows = len(shape.H), len(shape.A)
        self.f = np.zeros(n)
        self.upper = np.concatenate([shape.high, np.zeros(rows)])
        self.lower = np.concatenate([shape.low, np.full(rows, -_NO_LIMIT)])
        self.b = self.upper[n:]
        columns = np.ascontiguousarray(shape.A.T)
        self._solvers: dict[str, QpSolver] = {}
        self._y, self._multipliers = np.empty(n), np.empty(n + rows)
        self._violation = prepared.residual(
            np.ascontiguousarray(shape.H), columns, self.lower, self.upper, self.f, self._y, self._multipliers
        )

    def solve(self, solver: str) -> FloatArray | None:
        """The minimiser (n,) by one of `SOLVERS`, or None if it gave no answer that holds up."""
        if solver not in self._solvers:
            self._solvers[solver] = SOLVERS[solver](self)
        return self._solvers[solver].solve()

    def residual(self, y: FloatArray, multipliers: FloatArray) -> float:
        """Largest violation of the KKT conditions at y: of limits in kN and cm, of the others relative.

        NaN or infinity for an answer that is not finite.

        For a strictly convex QP zero means optimal (Boyd and Vandenberghe 2004, 5.5.3). `multipliers` (n + m,) are
        those of the box, then of A y <= b; positive at an upper limit, negative at a lower one. Each row of the
        gradient is judged by its own linear term: a slack's price, a thousand times a force's, would excuse any force.
        By the C of kernel/optimality.c.

        Raises:
            ValueError: The arrays do not fit the problem's.
        """
        self._y[:], self._multipliers[:] = y, multipliers
        return self._violation()


class QpSolver(ABC):
    """A solver set up once for a problem's shape and used by one run."""

    def __init__(self, problem: QpProblem) -> None:
        self._problem = problem

    @staticmethod
    @abstractmethod
    def effort(iterations: float, free: int, rows: int) -> float:
        """About the time of one QP with so many unknowns and rows of A [s]; the same on every machine."""

    def _spend(self, iterations: int) -> None:
        self._problem.spent += self.effort(iterations, len(self._problem.f), len(self._problem.b))

    def solve(self) -> FloatArray | None:
        """The minimiser (n,), or None if the solver gave no answer that holds up."""
        answer = self._attempt()
        if answer is None or not self._problem.residual(*answer) <= TOLERANCE:
            return None
        return answer[0]

    @abstractmethod
    def _attempt(self) -> tuple[FloatArray, FloatArray] | None:
        """The solver's y and multipliers if it says solved."""


class DaqpSolver(QpSolver):
    """Dual active set (Arnström, Bemporad, Axehill 2022), made for embedded MPC."""

    _model: daqp.Model | None = None

    @staticmethod
    def effort(iterations: float, free: int, rows: int) -> float:
        """Each iteration changes one limit in a factor of the binding ones."""
        return 6e-5 + 3e-8 * iterations * free

    def _attempt(self) -> tuple[FloatArray, FloatArray] | None:
        problem, shape = self._problem, self._problem.shape
        if self._model is None:
            self._model = daqp.Model()
            self._model.settings = {"primal_tol": 1e-9}
            # It takes no read-only arrays, and keeps their addresses.
            hessian, rows = self._matrices = shape.H.copy(), shape.A.copy()
            flag, _ = self._model.setup(hessian, problem.f, rows, problem.upper, problem.lower)
        else:
            flag = self._model.update(f=problem.f, bupper=problem.upper)
        if flag < 0:
            self._model = None
            return None
        y, _, flag, info = self._model.solve()
        self._spend(info["iterations"])
        return (y, info["lam"]) if flag > 0 else None


class OsqpSolver(QpSolver):
    """Operator splitting (Stellato et al. 2020), in whitened variables v = L'y with H = L L' and unit rows."""

    def __init__(self, problem: QpProblem) -> None:
        from scipy.sparse import csc_matrix, triu

        super().__init__(problem)
        self._model: osqp.OSQP | None = None
        shape = problem.shape
        n = len(shape.H)
        self._whiten = np.linalg.inv(np.linalg.cholesky(shape.H)).T  # y = whiten v
        rows = np.vstack([self._whiten, shape.A @ self._whiten])
        self._norm = np.linalg.norm(rows, axis=1)
        self._rows = csc_matrix(rows / self._norm[:, None])
        self._eye = csc_matrix(triu(np.eye(n)))
        self._lower = np.concatenate([shape.low / self._norm[:n], problem.lower[n:]])

    @staticmethod
    def effort(iterations: float, free: int, rows: int) -> float:
        """Each iteration solves with a factor of the whole dense problem; polishing factors it anew."""
        return 6e-5 + 3e-9 * free**3 + 7.5e-10 * iterations * (free + 6) * (free + rows + 57)

    def _attempt(self) -> tuple[FloatArray, FloatArray] | None:
        import osqp  # a tenth of a second, and rarely asked for

        upper = self._problem.upper / self._norm
        q = self._whiten.T @ self._problem.f
        if self._model is None:
            self._model = osqp.OSQP()
            self._model.setup(P=self._eye, q=q, A=self._rows, l=self._lower, u=upper, **_OSQP_SETTINGS)
        else:
            self._model.update(q=q, l=self._lower, u=upper)
        result = self._model.solve(raise_error=False)
        self._spend(result.info.iter)
        if result.info.status_val != osqp.SolverStatus.OSQP_SOLVED:
            return None
        return self._whiten @ result.x, result.y / self._norm


SOLVERS: dict[str, type[QpSolver]] = {"daqp": DaqpSolver, "osqp": OsqpSolver}
