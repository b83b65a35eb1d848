"""Discrete infinite-horizon LQR on the shared cost, cross term included (section 4.2.2)."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg.lapack import dgesv

from sim_core.arrays import BoolArray, FloatArray
from sim_core.car.driven_car import LinearLaw
from sim_core.car.half_car import FORCES, STATES, discrete
from sim_core.control.controller import WITHIN, Controller
from sim_core.control.cost import KILO, CostTerms, stage_cost
from sim_core.errors import RidelabError

_DOUBLINGS = 60
_SETTLED = 1e-9  # relative change of P in a last doubling: convergence is quadratic, the next would change rounding
_UNSTABLE = "No stabilising controller was found for these weights and this vehicle"


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Regulator:
    """u = -K x in kN: K (2, 8); P (8, 8) is the cost to go x'P x."""

    K: FloatArray
    P: FloatArray


@lru_cache(maxsize=512)
def regulator(terms: CostTerms) -> Regulator:
    """Solve P = A'PA + Q - (A'PB + N)(R + B'PB)⁻¹(B'PA + N').

    Raises:
        RidelabError: No stabilising solution was found for these weights.
    """
    model = discrete(terms.vehicle, terms.sample_time)
    A, B = model.A, model.B * KILO
    S = stage_cost(terms)
    x, u = slice(0, STATES), slice(STATES, STATES + FORCES)
    Q, R, N = S[x, x], S[u, u], S[x, u]
    P = riccati(A, B, Q, R, N)
    K = solve(R + B.T @ P @ B, B.T @ P @ A + N.T)
    if not np.isfinite(K).all() or np.abs(np.linalg.eigvals(A - B @ K)).max() >= 1:
        raise RidelabError(_UNSTABLE)
    return Regulator(K=K, P=P)


def riccati(A: FloatArray, B: FloatArray, Q: FloatArray, R: FloatArray, N: FloatArray) -> FloatArray:
    """Stabilising P (n, n) of the discrete Riccati equation with cross term N, by structured doubling.

    Chu, Fan, Lin and Wang 2004 (Int. J. Control 77): k passes cover 2^k steps. SciPy's solver reorders a Schur form,
    which fails for some ordinary cars with q4 = 0 (docs/decisions/0003-riccati-by-doubling.md).

    Raises:
        RidelabError: It did not settle.
    """
    into = solve(R, np.hstack([N.T, B.T]))
    n = len(A)
    A = A - B @ into[:, :n]
    G, H = B @ into[:, n:], Q - N @ into[:, :n]
    identity = np.eye(n)
    for _ in range(_DOUBLINGS):
        solved = solve(identity + G @ H, np.hstack([A, G]))
        grown = H + A.T @ H @ solved[:, :n]
        G = G + A @ solved[:, n:] @ A.T
        A = A @ solved[:, :n]
        G, grown = (G + G.T) / 2, (grown + grown.T) / 2
        change = np.abs(grown - H).max() / np.abs(grown).max()
        H = grown
        if change <= _SETTLED:
            return H
    raise RidelabError(_UNSTABLE)


def solve(a: FloatArray, b: FloatArray) -> FloatArray:
    """The x (n, k) of a·x = b, by LAPACK itself: for so small a system NumPy's own checks take three times as long.

    Raises:
        RidelabError: The matrix is singular.
    """
    _, _, x, singular = dgesv(a, b)
    if singular:
        raise RidelabError(_UNSTABLE)
    return np.asarray(x)


@lru_cache(maxsize=64)
def feedforward(terms: CostTerms, horizon: int) -> FloatArray:
    """The optimal force's part that a known future adds, in N: (2, 3 · horizon) on a preview window.

    Dynamic programming with cost to go x'Px + 2 x's (Tomizuka 1976, cross terms added): with w_i the disturbances of
    interval i and nothing known beyond the horizon,
    u = -K x - (R + B'PB)⁻¹ [(S_uw + B'PE) w_0 + B' s_1],  s_i = Σ_{j>=i} (A - BK)'^(j-i) L w_j,
    L = (A - BK)'PE + S_xw - K'S_uw.
    """
    model, design, S = discrete(terms.vehicle, terms.sample_time), regulator(terms), stage_cost(terms)
    A, B, E, K, P = model.A, model.B * KILO, model.E, design.K, design.P
    x, u, w = slice(0, STATES), slice(STATES, STATES + FORCES), slice(STATES + FORCES, None)
    closed = (A - B @ K).T
    curvature = S[u, u] + B.T @ P @ B
    L = closed @ P @ E + S[x, w] - K.T @ S[u, w]
    parts = [S[u, w] + B.T @ P @ E]
    for _ in range(1, horizon):
        parts.append(B.T @ L)
        L = np.asarray(closed @ L)
    return np.asarray(-KILO * np.linalg.solve(curvature, np.stack(parts, axis=-1).reshape(FORCES, -1)))


@lru_cache(maxsize=64)
def _law(design: Regulator) -> LinearLaw:
    """The regulator's forces [N]."""
    gain = np.zeros((FORCES, STATES + FORCES))
    gain[:, :STATES] = -design.K * KILO
    return LinearLaw(gain=gain)


class LqrController(Controller):
    """The regulator within the force limit; it does not know the travel limit, and of the road only its feedforward.

    `feed` (steps, 2) [N] is what preview adds in each control step; None is nothing.
    """

    def __init__(self, design: Regulator, force_limit: float, feed: FloatArray | None = None) -> None:
        super().__init__()
        self._law = _law(design)
        self._limit = force_limit
        self._feed = feed

    def law(self, stage: str) -> LinearLaw:
        """The same in every stage."""
        return self._law

    def feed(self, stage: str, first: int, last: int) -> FloatArray:
        """The feedforward."""
        return super().feed(stage, first, last) if self._feed is None else self._feed[first:last]

    def holds(self, first: int, stage: str, measured: FloatArray, commands: FloatArray) -> BoolArray:
        """Where its forces are within the limit."""
        return np.asarray((np.abs(commands) <= self._limit * WITHIN).all(axis=1))

    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> tuple[FloatArray, bool]:
        """The regulator's force, clipped."""
        force = self._law.gain[:, :STATES] @ state
        if self._feed is not None:
            force = force + self._feed[step]
        return np.clip(force, -self._limit, self._limit), not (np.abs(force) <= self._limit * WITHIN).all()
