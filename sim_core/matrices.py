"""Equations of small matrices: exponentials, Lyapunov, Riccati, linear systems.

By NumPy alone: importing scipy.linalg takes as long as all else that a first run needs.
"""

from math import ceil, factorial, log2

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.errors import RefusedError

NOT_STABILISABLE = "No stabilising controller was found for these weights and this vehicle"
_DOUBLINGS = 60
_TOLERANCE = 1e-9  # relative change of P in a last doubling: convergence is quadratic, the next would change rounding
_DEGREE = 13  # of Padé's approximation
_NORM = 5.37  # up to which it is exact to rounding
_PADE = [
    factorial(2 * _DEGREE - k) * factorial(_DEGREE) / (factorial(2 * _DEGREE) * factorial(k) * factorial(_DEGREE - k))
    for k in range(_DEGREE + 1)
]


def exponential(matrix: FloatArray) -> FloatArray:
    """Return e^A of one matrix (n, n) or of each of several (..., n, n).

    Padé's approximation of degree 13, with scaling and squaring (Higham 2005, SIAM J. Matrix Anal. Appl. 26).
    """
    norm = float(np.abs(matrix).sum(axis=-2).max())
    squarings = max(0, ceil(log2(norm / _NORM))) if norm > 0 else 0
    A = matrix / 2**squarings
    squared = A @ A
    even, odd, power = _PADE[0] * np.eye(A.shape[-1]), _PADE[1] * np.eye(A.shape[-1]), squared
    for k in range(2, _DEGREE, 2):
        even, odd = even + _PADE[k] * power, odd + _PADE[k + 1] * power
        power = power @ squared
    odd = A @ odd
    result = np.asarray(np.linalg.solve(even - odd, even + odd), dtype=np.float64)
    for _ in range(squarings):
        result = result @ result
    return result


def gauss_legendre(points: int) -> tuple[FloatArray, FloatArray]:
    """Return nodes (points,) between -1 and 1 and their weights, of sum 2 (Golub and Welsch 1969, Math. Comp. 23).

    NumPy's `leggauss` refines its nodes by a step of Newton: with it every number of an MPC would differ by rounding.
    """
    k = np.arange(1, points)
    beside = k / np.sqrt(4.0 * k * k - 1)
    nodes, vectors = np.linalg.eigh(np.diag(beside, 1) + np.diag(beside, -1))
    return nodes, 2 * vectors[0] ** 2


def lyapunov(A: FloatArray, Q: FloatArray) -> FloatArray:
    """Return the X (n, n) of A X + X Aᵀ = Q, as one linear system: for matrices of a few rows."""
    identity = np.eye(len(A))
    X = np.linalg.solve(np.kron(A, identity) + np.kron(identity, A), Q.ravel())
    return np.asarray(X, dtype=np.float64).reshape(Q.shape)


def riccati(A: FloatArray, B: FloatArray, Q: FloatArray, R: FloatArray, N: FloatArray) -> FloatArray:
    """Return the stabilising P (n, n) of the discrete Riccati equation with cross term N, by structured doubling.

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
        if change <= _TOLERANCE:
            return H
    raise RefusedError(NOT_STABILISABLE)


def solve(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the x (n, k) of a·x = b.

    Raises:
        RidelabError: The matrix is singular.
    """
    try:
        return np.asarray(np.linalg.solve(a, b), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise RefusedError(NOT_STABILISABLE) from None
