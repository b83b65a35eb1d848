"""The interval cost equals the integral for every car a slider can make."""

from itertools import product

import numpy as np
import pytest
from scipy.integrate import quad_vec
from scipy.linalg import expm

from sim_core.car.half_car import half_car
from sim_core.control.cost import KILO, CostTerms, passive_rms, stage_cost
from sim_core.scenario import Vehicle


@pytest.mark.parametrize(("wheel", "damping", "step"), list(product((20.0, 150.0), (500.0, 10_000.0), (0.005, 0.02))))
def test_quadrature_equals_an_adaptive_integral(wheel: float, damping: float, step: float) -> None:
    car = Vehicle(
        front_wheel_mass=wheel,
        rear_wheel_mass=wheel,
        front_damping=damping,
        rear_damping=damping,
        front_tyre_stiffness=500_000,
        body_mass=300,
    )
    terms = CostTerms(
        vehicle=car,
        speed=10.0,
        sample_time=step,
        weights=(8.0, 1.0, 6.0),
        deflection_weight=3.0,
        deflection_limit=0.08,
        force_weight=1e-9,
    )
    model, sigma = half_car(car), np.array(passive_rms(car, 10.0))
    scale = np.concatenate([np.array([8.0, 1.0, 6.0, 6.0]) / sigma**2, np.full(2, 3.0 / 0.08**2)])
    flow = np.zeros((13, 13))
    flow[:8] = np.hstack([model.A, model.B * KILO, model.E])
    output = np.sqrt(scale)[:, None] * np.hstack([model.C, model.D * KILO, model.F])[:6]

    def square(time: float) -> np.ndarray:
        y = output @ expm(flow * time)
        return y.T @ y

    integral, _ = quad_vec(square, 0.0, step, epsrel=1e-12, epsabs=0.0)
    expected = integral / step + np.diag([0.0] * 8 + [1e-9 * KILO**2] * 2 + [0.0] * 3)
    # 1e-9 of the largest entry: six points, used at first, were 1e-3 off at these corners.
    assert np.abs(stage_cost(terms) - expected).max() <= 1e-9 * np.abs(expected).max()
