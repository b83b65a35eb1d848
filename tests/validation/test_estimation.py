"""The Kalman filter: its gain, its covariance on a road, its recursion, and the loop around it."""

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

from sim_core.car.half_car import discrete, measurement
from sim_core.car.linear import closed_loop_matrix, control_step
from sim_core.car.plant import plant
from sim_core.control.cost import CostTerms
from sim_core.control.estimator import _accumulated, kalman_filter, make_estimator
from sim_core.control.lqr import LqrController, regulator
from sim_core.drive.sampling import fine_step, sample_road
from sim_core.drive.speed_profile import drive
from sim_core.errors import RidelabError
from sim_core.scenario import Actuator, Bump, Estimation, Mismatch, Road, Scenario, Speed, Vehicle
from sim_core.simulate import simulate
from sim_core.strategies import SpeedPolicy, strategy_named
from sim_core.study.stability import least_damping
from tests.validation.reference import adaptive
from tests.validation.reference.sampled import to_deflections
from tests.validation.reference.vehicle import state_space

KALMAN = Estimation(kind="kalman")
CAR = Vehicle(cg_to_front=1.2, cg_to_rear=1.5, front_wheel_mass=40)
STEP, INTENSITY = 0.01, (2 * np.pi * 0.1) ** 2 * 64e-6 * 13.9 / 2
LONG = Scenario(road=Road(length=1500, bump=Bump(height=0)), estimation=KALMAN, speed=Speed(target_speed_kmh=50))
CONTROLLERS = ("lv", "lv_hil", "lqr", "skyhook")


def test_measured_are_deflections_body_acceleration_and_pitch_rate() -> None:
    """By the reference's matrices in absolute coordinates."""
    reference, T = state_space(CAR), to_deflections(CAR)
    x, u = np.linspace(-0.02, 0.03, 8), np.array([300.0, -200.0])
    acceleration = reference.A[4] @ x + reference.B[4] @ u
    travels = x[0] + np.array([-1.2, 1.5]) * x[1] - x[2:4]
    sensors = measurement(CAR)
    np.testing.assert_allclose(sensors.C @ (T @ x) + sensors.D @ u, [*travels, acceleration, x[5]], rtol=1e-9)


def test_gain_and_covariance_are_those_of_the_riccati_equation() -> None:
    """SciPy solves it by another method."""
    A, C = discrete(CAR, STEP).A, measurement(CAR).C
    R = np.diag(np.square([5e-4, 5e-4, 0.05, 0.002]))
    predicted = solve_discrete_are(A.T, C.T, _accumulated(CAR, STEP, INTENSITY), R)
    gain = predicted @ C.T @ np.linalg.inv(C @ predicted @ C.T + R)
    ours = kalman_filter(CAR, KALMAN, STEP, INTENSITY)
    np.testing.assert_allclose(ours.gain, gain, rtol=1e-6, atol=1e-9 * np.abs(gain).max())
    np.testing.assert_allclose(ours.covariance, (np.eye(8) - gain @ C) @ predicted, rtol=1e-5, atol=1e-12)


def test_a_step_adds_the_roads_noise() -> None:
    """∫ e^{As} E W E' e^{A's} ds, summed in ten thousand parts."""
    fine = discrete(CAR, STEP / 10_000)
    total, through = np.zeros((8, 8)), np.eye(8)
    for _ in range(10_000):
        part = through @ (fine.E[:, :2] / (STEP / 10_000))
        total += INTENSITY * part @ part.T * (STEP / 10_000)
        through = fine.A @ through
    np.testing.assert_allclose(_accumulated(CAR, STEP, INTENSITY), total, rtol=2e-3, atol=1e-4 * np.abs(total).max())


@pytest.mark.parametrize("strategy", ["lqr", "suspension_only"])
def test_the_error_on_a_road_is_the_filters_own_covariance(strategy: str) -> None:
    """A minute and a half of class B road, on which the road's velocity is nearly white."""
    run = adaptive.run(LONG, strategy)
    estimate, state = run.trajectory.states[:, :8], run.trajectory.states[:, 8:]
    speed = LONG.speed.initial_speed_kmh / 3.6
    intensity = (2 * np.pi * 0.1) ** 2 * LONG.road.roughness * speed / 2
    expected = np.sqrt(np.diag(kalman_filter(LONG.vehicle, KALMAN, LONG.mpc.sample_time, intensity).covariance))
    error = (estimate - state)[200:].std(axis=0)
    # The road's velocity is not quite white: the body's, the slowest state, is known better than the filter expects.
    np.testing.assert_allclose(np.delete(error, 4), np.delete(expected, 4), rtol=0.05)
    assert 0.6 * expected[4] < error[4] < expected[4]
    assert (error < 0.7 * state[200:].std(axis=0)).sum() >= 6


def test_the_estimate_follows_the_textbooks_recursion() -> None:
    """Predict with the model and the command, correct with what is measured; the noise is what remains."""
    scenario = Scenario(estimation=KALMAN, road=Road(length=120, bump=Bump(start=80)))
    run = adaptive.run(scenario, "lv")
    motion = drive(scenario, SpeedPolicy.PLANNED)
    longest = fine_step(scenario, strategy_named("lv"))
    road_input = sample_road(scenario.road, scenario.vehicle.wheelbase, motion, 0.01, longest)
    estimate, state, commands = run.trajectory.states[:, :8], run.trajectory.states[:, 8:], run.commands
    model, sensors = discrete(scenario.vehicle, 0.01), measurement(scenario.vehicle)
    intensity = (2 * np.pi * 0.1) ** 2 * 64e-6 * motion.initial_speed / 2
    gain = kalman_filter(scenario.vehicle, KALMAN, 0.01, intensity).gain
    braking = road_input.disturbance.reshape(len(estimate), -1, 3)[:, :, 2].mean(axis=1)
    predicted = estimate @ model.A.T + commands @ model.B.T + np.outer(braking, model.E[:, 2])
    innovation = (state[1:] - predicted[:-1]) @ sensors.C.T
    noise = np.linalg.lstsq(gain, (estimate[1:] - predicted[:-1] - innovation @ gain.T).T, rcond=None)[0]
    np.testing.assert_allclose(predicted[:-1] + (innovation + noise.T) @ gain.T, estimate[1:], atol=1e-9)
    np.testing.assert_allclose(noise.std(axis=1), [5e-4, 5e-4, 0.05, 0.002], rtol=0.1)
    assert np.abs(np.corrcoef(noise)[np.triu_indices(4, 1)]).max() < 0.1


def test_the_loop_has_the_regulators_poles_and_the_filters() -> None:
    """Separation: with the model it believes in, neither moves the other's (Åström and Wittenmark 1997, 11.4)."""
    terms = CostTerms(
        vehicle=CAR,
        speed=13.9,
        sample_time=STEP,
        weights=(1, 1, 1),
        deflection_weight=3,
        deflection_limit=0.08,
        force_weight=1e-9,
    )
    design, model = regulator(terms), discrete(CAR, STEP)
    scenario = Scenario(vehicle=CAR, estimation=KALMAN)
    estimate = make_estimator(scenario, STEP, 13.9, np.zeros((1, 3)))
    assert estimate is not None
    loop = closed_loop_matrix(
        control_step(plant(CAR, Actuator(), STEP, 1), CAR, estimate), LqrController(design, 1e4).law("cruise")
    )
    poles = np.concatenate(
        [np.linalg.eigvals(model.A - model.B @ design.K * 1000), np.linalg.eigvals(estimate.state), np.zeros(2)]
    )
    ours = np.linalg.eigvals(loop)
    for pole in poles:
        assert np.abs(ours - pole).min() < 1e-5, pole


@pytest.mark.parametrize("actuator", [Actuator(), Actuator(bandwidth=10)], ids=["ideal", "lagging"])
@pytest.mark.parametrize("strategy", CONTROLLERS)
def test_it_is_the_same_stepped_in_c(strategy: str, actuator: Actuator) -> None:
    links = Vehicle(anti_dive=0.6, anti_lift=0.4)  # so that braking is in the measured acceleration
    scenario = Scenario(vehicle=links, estimation=KALMAN, actuator=actuator, road=Road(length=120, bump=Bump(start=80)))
    exact = simulate(scenario, strategy)
    never_met = links.model_copy(update={"bump_stop_clearance": 1.0})
    in_c = simulate(scenario.model_copy(update={"vehicle": never_met}), strategy)
    for name in ("body_acceleration", "front_tyre_load", "front_force"):
        values = exact.series[name]
        # The ECU's converters turn a difference of 1e-8 into a whole code.
        assert np.std(in_c.series[name] - values) <= (2e-2 if strategy == "lv_hil" else 1e-4) * np.std(values), name


def test_a_filter_with_another_cars_model_gets_no_hint_of_it() -> None:
    """Its matrices are the believed car's: only what it is fed differs."""
    heavy = Scenario(estimation=KALMAN, mismatch=Mismatch(body_mass=1.3))
    one, two = (make_estimator(each, STEP, 13.9, np.zeros((5, 3))) for each in (heavy, Scenario(estimation=KALMAN)))
    assert one is not None
    assert two is not None
    np.testing.assert_array_equal(one.state, two.state)
    np.testing.assert_array_equal(one.measurement, two.measurement)


def test_better_sensors_drive_better() -> None:
    """From bad sensors over good ones to the exact state, on a rough road."""
    rough = Road(roughness=256e-6, bump=Bump(height=0))
    bad = Estimation(kind="kalman", acceleration_noise=2.0, deflection_noise=0.02, pitch_rate_noise=0.1)
    pitch = [
        simulate(Scenario(estimation=each, road=rough), "lqr").metrics["whole"]["pitch_acceleration"]["rms"]
        for each in (bad, KALMAN, Estimation())
    ]
    assert pitch == sorted(pitch, reverse=True)


def test_margins_are_judged_with_the_filter_that_drives() -> None:
    """On a rougher road the filter trusts its sensors more, and the loop's margin is another."""
    noisy = Estimation(kind="kalman", deflection_noise=0.01)
    judged = [
        least_damping(Scenario(estimation=noisy, mismatch=Mismatch(body_mass=0.5), road=Road(roughness=each)), "lqr")
        for each in (64e-6, 1024e-6)
    ]
    assert judged[0] != pytest.approx(judged[1], rel=0.01)


def test_a_filter_that_is_not_stable_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Doubling may settle where rounding has the last word: here on a covariance below zero."""
    monkeypatch.setattr("sim_core.control.estimator.riccati", lambda *_: -0.9999 * np.eye(8) * 0.002**2)
    with pytest.raises(RidelabError, match="No stable Kalman filter"):
        kalman_filter(CAR, KALMAN, STEP, 2 * INTENSITY)
