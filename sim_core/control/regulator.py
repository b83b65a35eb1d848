"""The discrete infinite-horizon regulator of the shared cost, cross term included (section 4.2.2)."""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import small_cached
from sim_core.control.cost import KILO, CostTerms, stage_cost
from sim_core.errors import RefusedError
from sim_core.matrices import NOT_STABILISABLE, riccati, solve
from sim_core.vehicle.half_car import FORCES, STATES, discrete


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Regulator:
    """The optimal force u = gain·x [N], and its cost.

    Attributes:
        gain: On the state (2, 8), as `LinearLaw.gain` begins.
        P: The cost [1] of all intervals to come is x'P x (8, 8).
    """

    gain: FloatArray
    P: FloatArray


@small_cached(512)
def regulator(terms: CostTerms) -> Regulator:
    """Return the LQR of that cost: P = A'PA + Q - (A'PB + N)(R + B'PB)⁻¹(B'PA + N').

    Returns:
        Its `gain` (2, 8), on the state and for forces in N, and its `P` (8, 8).

    Raises:
        RidelabError: No stabilising solution was found for these weights.

    Example:
        >>> import numpy as np
        >>> from sim_core import CostTerms, LinearLaw, Scenario, regulator
        >>> terms = CostTerms(
        ...     vehicle=Scenario().vehicle, speed=14.0, sample_time=0.01, weights=(1, 1, 1),
        ...     deflection_weight=3.0, deflection_limit=0.08, force_weight=1e-9,
        ... )
        >>> law = LinearLaw(gain=np.hstack([regulator(terms).gain, np.zeros((2, 2))]))
        >>> law.gain.shape
        (2, 10)
    """
    model = discrete(terms.vehicle, terms.sample_time)
    A, B = model.A, model.B * KILO
    S = stage_cost(terms)
    x, u = slice(0, STATES), slice(STATES, STATES + FORCES)
    Q, R, N = S[x, x], S[u, u], S[x, u]
    P = riccati(A, B, Q, R, N)
    K = solve(R + B.T @ P @ B, B.T @ P @ A + N.T)
    if not np.isfinite(K).all() or np.abs(np.linalg.eigvals(A - B @ K)).max() >= 1:
        raise RefusedError(NOT_STABILISABLE)
    return Regulator(gain=-KILO * K, P=P)


@small_cached(64)
def feedforward(terms: CostTerms, horizon: int) -> FloatArray:
    """Return what the LQR's force has beside -K x where disturbances to come are known: gains on them (2, 3 · horizon).

    For forces in N, as `LinearLaw.preview_gain`: on the front road velocity [m/s] in all steps, then on the rear one,
    then on the deceleration [m/s^2].

    Dynamic programming with cost to go x'Px + 2 x's (Tomizuka 1976, cross terms added): with w_i the disturbances of
    interval i and nothing known beyond the horizon,
    u = -K x - (R + B'PB)⁻¹ [(S_uw + B'PE) w_0 + B' s_1],  s_i = Σ_{j>=i} (A - BK)'^(j-i) L w_j,
    L = (A - BK)'PE + S_xw - K'S_uw.

    Example:
        >>> from sim_core import CostTerms, Scenario, feedforward
        >>> terms = CostTerms(
        ...     vehicle=Scenario().vehicle, speed=14.0, sample_time=0.01, weights=(1, 1, 1),
        ...     deflection_weight=3.0, deflection_limit=0.08, force_weight=1e-9,
        ... )
        >>> feedforward(terms, 30).shape  # 30 road velocities in front, 30 at the rear, 30 decelerations
        (2, 90)
    """
    model, design, S = discrete(terms.vehicle, terms.sample_time), regulator(terms), stage_cost(terms)
    A, B, E, K, P = model.A, model.B * KILO, model.E, -design.gain / KILO, design.P
    x, u, w = slice(0, STATES), slice(STATES, STATES + FORCES), slice(STATES + FORCES, None)
    closed = (A - B @ K).T
    curvature = S[u, u] + B.T @ P @ B
    L = closed @ P @ E + S[x, w] - K.T @ S[u, w]
    parts = [S[u, w] + B.T @ P @ E]
    for _ in range(1, horizon):
        parts.append(B.T @ L)
        L = np.asarray(closed @ L)
    return np.asarray(-KILO * np.linalg.solve(curvature, np.stack(parts, axis=-1).reshape(FORCES, -1)))
