"""The discrete Riccati equation and small linear systems."""

import numpy as np
from scipy.linalg.lapack import dgesv

from sim_core.arrays import FloatArray
from sim_core.errors import RidelabError

_DOUBLINGS = 60
_SETTLED = 1e-9  # relative change of P in a last doubling: convergence is quadratic, the next would change rounding
NOT_STABILISABLE = "No stabilising controller was found for these weights and this vehicle"


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
    raise RidelabError(NOT_STABILISABLE)


def solve(a: FloatArray, b: FloatArray) -> FloatArray:
    """The x (n, k) of a·x = b, by LAPACK itself: for so small a system NumPy's own checks take three times as long.

    Raises:
        RidelabError: The matrix is singular.
    """
    _, _, x, singular = dgesv(a, b)
    if singular:
        raise RidelabError(NOT_STABILISABLE)
    return np.asarray(x)
