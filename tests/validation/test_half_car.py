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
def test_undriven_energy_only_falls_and_at_the_dampers_rate(car: Vehicle) -> None:
    """E = ½ Σ k d² + ½ Σ k_t t² + ½ Σ m v²; Ė = −Σ c ḋ²: an identity of quadratic forms, tested as one."""
    k = [car.front_spring, car.rear_spring, car.front_tyre_stiffness, car.rear_tyre_stiffness]
    m = [car.body_mass, car.pitch_inertia, car.front_wheel_mass, car.rear_wheel_mass]
    energy = np.diag(k + m) / 2
    A = half_car(car).A
    a, b = car.cg_to_front, car.cg_to_rear
    speed = np.array([[0, 0, 0, 0, 1, -a, -1, 0], [0, 0, 0, 0, 1, b, 0, -1]], dtype=float)
    loss = speed.T @ np.diag([car.front_damping, car.rear_damping]) @ speed
    rate = energy @ A + A.T @ energy
    np.testing.assert_allclose(rate, -loss, atol=1e-9 * np.abs(energy @ A).max())
    assert np.linalg.eigvals(A).real.max() < 0

    step = discrete(car, 0.001)
    state = np.array([0.05, -0.03, 0.01, 0.02, 0.5, -0.3, 1, -1])
    energies = []
    for _ in range(300):
        energies.append(state @ energy @ state)
        state = step.A @ state
    assert np.all(np.diff(energies) <= 1e-12 * energies[0])
    assert energies[-1] < 0.9 * energies[0]


@given(vehicles)
def test_static_loads_balance_forces_and_moments(car: Vehicle) -> None:
    front, rear = car.static_loads
    np.testing.assert_allclose(front + rear, (car.body_mass + car.front_wheel_mass + car.rear_wheel_mass) * GRAVITY)
    # Moments about the centre of gravity: only the wheels' own weight acts off the body's axle loads.
    arm_front = (front - car.front_wheel_mass * GRAVITY) * car.cg_to_front
    arm_rear = (rear - car.rear_wheel_mass * GRAVITY) * car.cg_to_rear
    np.testing.assert_allclose(arm_front, arm_rear)


@given(vehicles)
def test_steady_braking_shifts_the_load_by_the_moment_over_the_wheelbase(car: Vehicle) -> None:
    """Settled under a held deceleration: ΔF = m_b a h_cg / L in front, minus that behind, no acceleration left."""
    model = half_car(car)
    w = np.array([0, 0, 3.0])
    state = np.linalg.solve(model.A, -model.E @ w)
    y = model.C @ state + model.F @ w
    transfer = car.body_mass * 3.0 * car.cg_height / (car.cg_to_front + car.cg_to_rear)
    np.testing.assert_allclose(y[:4], [0, 0, transfer, -transfer], atol=1e-7 * transfer)
    load_shares = car.front_brake_share * car.anti_dive, (1 - car.front_brake_share) * car.anti_lift
    assert (y[4] < 0) == (load_shares[0] < 1)  # dives, unless links carry more than all
    assert (y[5] > 0) == (load_shares[1] < 1)


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
