"""Small matrices: exponentials and Lyapunov equations against SciPy's; the Riccati equation has tests of its own."""

import numpy as np
import pytest
from scipy import linalg

from sim_core import RidelabError, Vehicle
from sim_core.matrices import exponential, gauss_legendre, lyapunov, solve
from sim_core.vehicle.half_car import half_car


def relative(ours: np.ndarray, theirs: np.ndarray) -> float:
    return float(np.abs(ours - theirs).max() / np.abs(theirs).max())


@pytest.mark.parametrize("step", [0.0, 1e-4, 1e-3, 0.01, 0.05, 0.5, 5.0])
def test_exponentials_are_scipys(step: float) -> None:
    """Each squaring may double the rounding: ten of them from 1e-16."""
    A = half_car(Vehicle()).A * step
    assert relative(exponential(A), linalg.expm(A)) < 1e-12
    several = np.stack([A, -A / 100, A / 3])
    np.testing.assert_allclose(exponential(several), linalg.expm(several), rtol=0, atol=1e-12 * np.abs(several).max())


def test_lyapunov_equations_are_solved_as_by_scipy() -> None:
    A = half_car(Vehicle()).A
    rng = np.random.default_rng(2)
    Q = rng.standard_normal(A.shape)
    X = lyapunov(A, Q)
    assert relative(X, linalg.solve_continuous_lyapunov(A, Q)) < 1e-11
    assert relative(A @ X + X @ A.T, Q) < 1e-9  # A's entries reach 1e4


def test_a_singular_system_is_an_error_of_the_core() -> None:
    with pytest.raises(RidelabError):
        solve(np.zeros((2, 2)), np.ones((2, 1)))


@pytest.mark.parametrize("points", [1, 2, 16, 24])
def test_nodes_and_weights_are_numpys(points: int) -> None:
    for ours, theirs in zip(gauss_legendre(points), np.polynomial.legendre.leggauss(points), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-14)
