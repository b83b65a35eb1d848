"""A dense QP by non-negative least squares (Lawson and Hanson 1974, chapter 23), and its optimality residual."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

Array = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class QpSolution:
    """Minimiser, and the largest residual of the optimality conditions, each relative to its own scale."""

    x: Array
    residual: float


def solve(H: Array, g: Array, A: Array, b: Array) -> QpSolution:
    """min ½ x'Hx + g'x subject to A x ≤ b with H > 0: the limits that bind by SciPy's NNLS, then the exact optimum."""
    root, unconstrained = np.linalg.cholesky(H), np.linalg.solve(H, -g)
    problem = np.vstack([-np.linalg.solve(root, A.T), A @ unconstrained - b])
    shares, _ = nnls(problem, np.eye(len(problem))[-1])
    binding = np.flatnonzero(shares)
    moved = np.linalg.solve(H, A[binding].T)
    multipliers = np.zeros(len(b))
    multipliers[binding] = np.linalg.solve(A[binding] @ moved, (A @ unconstrained - b)[binding])
    x = unconstrained - moved @ multipliers[binding]
    return QpSolution(x=x, residual=_residual(H, g, A, b, x, multipliers))


def _residual(H: Array, g: Array, A: Array, b: Array, x: Array, multipliers: Array) -> float:
    """Stationarity, feasibility, sign of the multipliers, complementarity."""
    scale_dual = 1 + max(np.abs(H @ x).max(), np.abs(g).max(), np.abs(A.T @ multipliers).max())
    excess = A @ x - b
    return float(
        max(
            np.abs(H @ x + g + A.T @ multipliers).max() / scale_dual,
            np.max(excess / (1 + np.abs(b)), initial=0),
            np.max(-multipliers, initial=0) / scale_dual,
            np.abs(multipliers * excess).max(initial=0) / (1 + abs(g @ x)),
        )
    )
