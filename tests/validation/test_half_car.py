"""The half-car model against Newton's second law in absolute coordinates, energy, statics and exact stepping."""

import numpy as np
from hypothesis import given, settings
from scipy.integrate import solve_ivp

from sim_core.scenario import Vehicle
from sim_core.scenario.vehicle import GRAVITY
from sim_core.vehicle.half_car import OUTPUTS, discrete, half_car
from tests.validation.reference.sampled import to_deflections
from tests.validation.reference.vehicle import OUTPUTS as REFERENCE_OUTPUTS
from tests.validation.reference.vehicle import state_space
from tests.validation.strategies import vehicles

ROWS = [OUTPUTS.index(name) for name in REFERENCE_OUTPUTS]


@given(vehicles)
def test_matrices_are_newtons_law_in_other_coordinates(car: Vehicle) -> None:
    mine, theirs, T = state_space(car), half_car(car), to_deflections(car)
    back = np.linalg.inv(T)
    scale = np.abs(theirs.A).max()
    np.testing.assert_allclose(T @ mine.A @ back, theirs.A, atol=1e-12 * scale)
    np.testing.assert_allclose(T @ mine.B, theirs.B, atol=1e-15)
    np.testing.assert_allclose(mine.C @ back, theirs.C[ROWS], atol=1e-12 * np.abs(theirs.C).max())
    np.testing.assert_allclose(mine.F, theirs.D[ROWS], atol=1e-15)
    np.testing.assert_allclose(mine.H, theirs.F[ROWS, 2], atol=1e-12)
    np.testing.assert_allclose(T @ mine.D, theirs.E[:, 2], atol=1e-12)


@given(vehicles)
def test_static_loads_balance_forces_and_moments(car: Vehicle) -> None:
    front, rear = car.static_loads
    np.testing.assert_allclose(front + rear, (car.body_mass + car.front_wheel_mass + car.rear_wheel_mass) * GRAVITY)
    # Moments about the centre of gravity: only the wheels' own weight acts off the body's axle loads.
    arm_front = (front - car.front_wheel_mass * GRAVITY) * car.cg_to_front
    arm_rear = (rear - car.rear_wheel_mass * GRAVITY) * car.cg_to_rear
    np.testing.assert_allclose(arm_front, arm_rear)


def test_links_may_carry_all_of_the_load_transfer() -> None:
    """The body then neither dives nor lifts (Gillespie 1992, chapter 7), and the tyres carry the whole transfer."""
    full = Vehicle(front_brake_share=0.6, anti_dive=1 / 0.6, anti_lift=1 / 0.4)
    model = half_car(full)
    np.testing.assert_allclose(model.F[:2, 2], 0, atol=1e-12)
    rest = np.linalg.solve(model.A, -5.0 * model.E[:, 2])
    loads = model.C[2:4] @ rest
    transfer = 5.0 * full.body_mass * full.cg_height / full.wheelbase
    np.testing.assert_allclose(loads, [transfer, -transfer], rtol=1e-9)
    np.testing.assert_allclose(rest[:2], 0, atol=1e-12)


@settings(max_examples=25)
@given(vehicles)
def test_one_exact_step_equals_an_adaptive_solver(car: Vehicle) -> None:
    """Force, road velocity and deceleration held for 10 ms; Radau-free DOP853 at 1e-12 is the judge, 1e-8 relative."""
    model, step = half_car(car), discrete(car, 0.01)
    x, u, w = (
        np.array([0.05, -0.03, 0.01, 0.02, 0.5, -0.3, 1, -1]),
        np.array([800.0, -1500]),
        np.array([1.2, -0.7, 3.0]),
    )
    forcing = model.B @ u + model.E @ w
    reference = solve_ivp(lambda _, y: model.A @ y + forcing, (0, 0.01), x, "DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
    np.testing.assert_allclose(step.A @ x + step.B @ u + step.E @ w, reference, atol=1e-8 * np.abs(reference).max())
