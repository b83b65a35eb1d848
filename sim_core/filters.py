"""Recursive filters of low order, as the banded triangular systems they are.

y[k] + a1 y[k-1] + … = v[k] is L y = v with a lower triangular band; LAPACK's forward substitution is the
recursion. SciPy's own filters come with scipy.signal, which takes longer to import than all the rest of the core.
"""

import numpy as np
from scipy.linalg.lapack import dtbtrs

from sim_core.result import FloatArray

Quadratic = tuple[float, float, float]  # coefficients, highest power first
Quotient = tuple[Quadratic, Quadratic]  # numerator and denominator


def recursion(inputs: FloatArray, *feedback: float) -> FloatArray:
    """The y (n,) with y[k] = inputs[k] - Σ feedback[i] y[k-1-i], zero before the start."""
    band = np.empty((1 + len(feedback), len(inputs)))
    band[0] = 1.0
    band[1:] = np.array(feedback)[:, None]
    solution, _ = dtbtrs(band, inputs[:, None], uplo="L", diag="U")
    return np.asarray(solution[:, 0], dtype=np.float64)


def bilinear(polynomial: Quadratic, step: float) -> FloatArray:
    """A quadratic in s under s = 2 (z - 1) / (step (z + 1)), times (z + 1)²: coefficients (3,) in z."""
    b2, b1, b0 = polynomial
    c = 2 / step
    return np.array([b2 * c * c + b1 * c + b0, 2 * (b0 - b2 * c * c), b2 * c * c - b1 * c + b0])


def filtered(inputs: FloatArray, quotient: Quotient, step: float) -> FloatArray:
    """Samples (n,), `step` [s] apart, through a quotient in s, made discrete by the bilinear transform."""
    numerator, denominator = (bilinear(polynomial, step) for polynomial in quotient)
    forward = np.convolve(inputs, numerator / denominator[0])[: len(inputs)]
    return recursion(forward, *(denominator[1:] / denominator[0]))
