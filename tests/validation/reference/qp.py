"""A dense interior-point solver of its own (Mehrotra's predictor-corrector) and a KKT check."""

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

Array = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class QpSolution:
    """Minimiser, multipliers of A x ≤ b, and the four KKT residuals, each relative to its own scale."""

    x: Array
    multipliers: Array
    residual: float


def solve(H: Array, g: Array, A: Array, b: Array, iterations: int = 60) -> QpSolution:
    """min ½ x'Hx + g'x subject to A x ≤ b with H > 0 (Nocedal & Wright, Algorithm 16.4)."""
    x = np.linalg.solve(H, -g)
    slack = np.maximum(np.abs(b - A @ x), 1.0)
    multiplier = np.full(len(b), max(1.0, float(np.abs(g).max())))
    for _ in range(iterations):
        dual = H @ x + g + A.T @ multiplier
        primal = A @ x + slack - b
        gap = slack @ multiplier / len(b)
        if residual(H, g, A, b, x, multiplier) < 1e-12:
            break
        try:
            factor = cho_factor(H + A.T @ ((multiplier / slack)[:, None] * A))
        except np.linalg.LinAlgError:  # as far as rounding lets the barrier go
            break

        step = partial(_newton_step, A, factor, dual, primal, slack, multiplier)
        _, ds, dm = step(slack * multiplier)
        affine_step = _longest(slack, ds, multiplier, dm, 1.0)
        centring = ((slack + affine_step * ds) @ (multiplier + affine_step * dm) / len(b) / gap) ** 3
        dx, ds, dm = step(slack * multiplier + ds * dm - centring * gap)
        length = _longest(slack, ds, multiplier, dm, 0.995)
        x, slack, multiplier = x + length * dx, slack + length * ds, multiplier + length * dm
    return _polished(H, g, A, b, x, multiplier, slack)


def _newton_step(
    A: Array, factor: Any, dual: Array, primal: Array, slack: Array, multiplier: Array, target: Array
) -> tuple[Array, Array, Array]:
    """The step in x, slack and multipliers towards complementary products of `target`."""
    dx = cho_solve(factor, -dual - A.T @ ((multiplier * primal - target) / slack))
    ds = -primal - A @ dx
    return dx, ds, -(target + multiplier * ds) / slack


def _polished(H: Array, g: Array, A: Array, b: Array, x: Array, multiplier: Array, slack: Array) -> QpSolution:
    """The exact optimum on the active set found, if it is at least as good a KKT point."""
    rough = QpSolution(x=x, multipliers=multiplier, residual=residual(H, g, A, b, x, multiplier))
    active = np.flatnonzero(multiplier > slack)
    n, m = len(g), len(active)
    kkt = np.block([[H, A[active].T], [A[active], np.zeros((m, m))]])
    inverse, right, exact = np.linalg.pinv(kkt), np.concatenate([-g, b[active]]), np.zeros(n + m)
    for _ in range(3):  # a slack's price is thousands of times a force's: one round alone leaves 1e-11 of it
        exact += inverse @ (right - kkt @ exact)
    multipliers = np.zeros(len(b))
    multipliers[active] = exact[n:]
    sharp = residual(H, g, A, b, exact[:n], multipliers)
    return QpSolution(x=exact[:n], multipliers=multipliers, residual=sharp) if sharp <= rough.residual else rough


def _longest(slack: Array, ds: Array, multiplier: Array, dm: Array, share: float) -> float:
    value, change = np.concatenate([slack, multiplier]), np.concatenate([ds, dm])
    falling = change < 0
    return min(1.0, share * float(np.min(-value[falling] / change[falling], initial=np.inf)))


def residual(H: Array, g: Array, A: Array, b: Array, x: Array, multipliers: Array) -> float:
    """Largest relative KKT residual: stationarity, feasibility, sign of the multipliers, complementarity."""
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
