"""Discrete infinite-horizon LQR on the shared cost, cross term included (section 4.2.2)."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from sim_core.controller import Controller, LinearLaw
from sim_core.cost import KILO, CostTerms, stage_cost
from sim_core.errors import RidelabError
from sim_core.half_car import FORCES, STATES, discrete
from sim_core.result import FloatArray

_DOUBLINGS = 60


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
    K = np.asarray(np.linalg.solve(R + B.T @ P @ B, B.T @ P @ A + N.T), dtype=np.float64)
    if not np.isfinite(K).all() or np.abs(np.linalg.eigvals(A - B @ K)).max() >= 1:
        raise RidelabError("No stabilising controller was found for these weights and this vehicle")
    return Regulator(K=K, P=P)


def riccati(A: FloatArray, B: FloatArray, Q: FloatArray, R: FloatArray, N: FloatArray) -> FloatArray:
    """Stabilising P (n, n) of the discrete Riccati equation with cross term N, by structured doubling.

    Chu, Fan, Lin and Wang 2004 (Int. J. Control 77): k passes cover 2^k steps. SciPy's solver reorders a Schur form,
    which fails for some ordinary cars with q4 = 0 (docs/decisions/0003-riccati-by-doubling.md).
    """
    into = np.linalg.solve(R, np.hstack([N.T, B.T]))
    n = len(A)
    A = A - B @ into[:, :n]
    G, H = B @ into[:, n:], Q - N @ into[:, :n]
    for _ in range(_DOUBLINGS):
        solved = np.linalg.solve(np.eye(n) + G @ H, np.hstack([A, G]))
        grown = H + A.T @ H @ solved[:, :n]
        G = G + A @ solved[:, n:] @ A.T
        A = A @ solved[:, :n]
        G, grown = (G + G.T) / 2, (grown + grown.T) / 2
        still = np.abs(grown - H).max() <= 1e-15 * np.abs(grown).max()
        H = grown
        if still:
            break
    return H


class LqrController(Controller):
    """The regulator within the force limit; it knows neither the road ahead nor the travel limit."""

    def __init__(self, design: Regulator, force_limit: float) -> None:
        super().__init__()
        gain = np.zeros((FORCES, STATES + FORCES))
        gain[:, :STATES] = -design.K * KILO
        self._law = LinearLaw(gain=gain, checks=gain, bounds=np.full(FORCES, force_limit))
        self._limit = force_limit

    def law(self, stage: str) -> LinearLaw:
        """The same in every stage."""
        return self._law

    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> FloatArray:
        """The regulator's force, clipped."""
        return np.clip(self._law.gain[:, :STATES] @ state, -self._limit, self._limit)
