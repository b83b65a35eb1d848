"""Sampled-data control of the half-car: exact discretisation, the normalised cost, Riccati and QP, all from scratch."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm, solve_discrete_are, solve_discrete_lyapunov

from sim_core.scenario import Vehicle
from tests.validation.reference.vehicle import StateSpace, stationary_rms

Array = NDArray[np.floating[Any]]


@dataclass(frozen=True)
class SampledInterval:
    """Linear maps over one interval from w = (x, u, z_start, z_end, a, command): state, force and OUTPUTS at time s.

    Command and deceleration are held, the road height is linear. x: 8, u: 2, z: 2 + 2, a: 1, command: 2; w: 17, or
    15 without an actuator lag: then u is held and nothing is commanded.
    """

    state: Array  # (8, 15 or 17)
    force: Array  # (2, 15 or 17)
    output: Array  # (6, 15 or 17)


def interval(model: StateSpace, length: float, at: float, corner: float = 0.0) -> SampledInterval:
    """The maps at time `at` within an interval of `length` [s], by one matrix exponential of the augmented system.

    corner: of the actuator's lag u̇ = corner (command − u) [rad/s]; 0 for an ideal actuator.
    """
    # Augmented state (x, u, z, ż, a, command) with z̈ = 0, ȧ = 0.
    n = 8 + 2 + 2 + 2 + 1 + (2 if corner else 0)
    generator = np.zeros((n, n))
    generator[:8, :8], generator[:8, 8:10], generator[:8, 10:12] = model.A, model.B, model.E
    generator[:8, 14] = model.D
    generator[10:12, 12:14] = np.eye(2)
    if corner:
        generator[8:10, 8:10], generator[8:10, 15:17] = -corner * np.eye(2), corner * np.eye(2)
    to_slope = np.eye(n)
    to_slope[12:14] = 0
    to_slope[12:14, 10:12], to_slope[12:14, 12:14] = -np.eye(2) / length, np.eye(2) / length
    evolved = expm(generator * at) @ to_slope
    read = np.hstack([model.C, model.F, model.G, np.zeros((6, 2)), model.H[:, None], np.zeros((6, n - 15))])
    return SampledInterval(state=evolved[:8], force=evolved[8:10], output=read @ evolved)


def weights(
    car: Vehicle,
    q: tuple[float, float, float],
    travel: float,
    limit: float,
    speed: float,
    distance: float | None = None,
) -> Array:
    """Diagonal weight of OUTPUTS: each squared term over its passive class B RMS squared, travel over its limit."""
    sigma = stationary_rms(car, speed, distance)
    q1, q2, q3 = q
    return np.array(
        [
            q1 / sigma[0] ** 2,
            q2 / sigma[1] ** 2,
            q3 / sigma[2] ** 2,
            q3 / sigma[3] ** 2,
            travel / limit**2,
            travel / limit**2,
        ]
    )


def mean_cost(
    model: StateSpace, weight: Array, length: float, force_weight: float, points: Array, share: Array
) -> Array:
    """Quadratic form in w (15, 15): Σ share · y' W y at `points` (fractions of the interval) + R u'u."""
    total = np.zeros((15, 15))
    for fraction, part in zip(points, share, strict=True):
        y = interval(model, length, fraction * length).output
        total += part * y.T @ (weight[:, None] * y)
    total[8:10, 8:10] += force_weight * np.eye(2)
    return total


def gauss(n: int = 10) -> tuple[Array, Array]:
    """Gauss-Legendre points and weights on [0, 1]: the exact mean to rounding for these smooth integrands."""
    points, share = np.polynomial.legendre.leggauss(n)
    return (points + 1) / 2, share / 2


@dataclass(frozen=True)
class SampledRegulator:
    """u = −K x and the cost-to-go x' P x, in absolute coordinates with the road at 0."""

    K: Array
    P: Array


def regulator(model: StateSpace, cost: Array, length: float) -> SampledRegulator:
    """Infinite-horizon optimum of the sampled-data cost, cross term included."""
    maps = interval(model, length, length).state
    A, B = maps[:, :8], maps[:, 8:10]
    Q, S, R = cost[:8, :8], cost[:8, 8:10], cost[8:10, 8:10]
    P = riccati(A, B, Q, R, S)
    K = np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A + S.T)
    return SampledRegulator(K=K, P=P)


def riccati(A: Array, B: Array, Q: Array, R: Array, S: Array) -> Array:
    """P = A'PA + Q − (A'PB + S)(R + B'PB)⁻¹(B'PA + S') by SciPy, in units in which diag(Q) is near 1."""
    unit = 1 / np.sqrt(np.maximum(np.diag(Q), 1e-12 * np.diag(Q).max()))
    scaled = A * unit / unit[:, None], B / unit[:, None], Q * np.outer(unit, unit)
    P: Array = solve_discrete_are(*scaled, R, s=S * unit[:, None])
    return P / np.outer(unit, unit)


def cost_to_go(model: StateSpace, cost: Array, length: float, K: Array) -> Array:
    """P of the closed loop u = −K x: summed cost from each state."""
    maps = interval(model, length, length).state
    closed = maps[:, :8] - maps[:, 8:10] @ K
    feed = np.vstack([np.eye(8), -K])
    return np.asarray(solve_discrete_lyapunov(closed.T, feed.T @ cost[:10, :10] @ feed))


def to_deflections(car: Vehicle) -> Array:
    """(8, 8): absolute state with the road at 0 → (d_1, d_2, t_1, t_2, ż_b, θ̇, ż_w1, ż_w2), the core's order."""
    a, b = car.cg_to_front, car.cg_to_rear
    rows = np.zeros((8, 8))
    rows[0, :4] = [1, -a, -1, 0]
    rows[1, :4] = [1, b, 0, -1]
    rows[2, 2] = rows[3, 3] = 1
    rows[4:, 4:] = np.eye(4)
    return rows
