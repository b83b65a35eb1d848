"""The Kalman filter: its gain, its covariance on a road, what it is told of that, its recursion, the loop around it."""

import numpy as np
import pytest
from scipy.linalg import expm, solve_continuous_lyapunov, solve_discrete_are

from sim_core.arrays import FloatArray
from sim_core.catalogue import PAPER_SIGNALS
from sim_core.frequency.sampled_loop import sampled_loop, stage_law
from sim_core.loop.closed_loop import ClosedLoop, Trajectory
from sim_core.loop.run import Run
from sim_core.road.profile import road_profile
from sim_core.road.sensed import ExpectedErrors, expected_errors
from sim_core.scenario import Bump, Estimation, Mismatch, Mpc, Preview, Road, Scenario, Speed, Vehicle
from sim_core.scenario.presets import preset
from sim_core.simulate import prepare, simulate
from sim_core.speed.profile import SpeedProfile
from sim_core.vehicle.estimator import (
    KalmanFilter,
    _accumulated,
    _unseen,
    kalman_filter,
    unseen_share,
)
from sim_core.vehicle.half_car import discrete, half_car, measurement
from tests.validation.caught import returned
from tests.validation.reference.sampled import to_deflections
from tests.validation.reference.vehicle import state_space
from tests.validation.strategies import some

KALMAN = Estimation(kind="kalman")
CAR = Vehicle(cg_to_front=1.2, cg_to_rear=1.5, front_wheel_mass=40)
UNTOLD = Estimation(kind="kalman", knows_preview=False)
NOISES = np.array([5e-4, 5e-4, 0.05, 0.002])
STEP, INTENSITY = 0.01, (2 * np.pi * 0.1) ** 2 * 64e-6 * 13.9 / 2
BOTH = INTENSITY * np.eye(2)
LONG = Scenario(road=Road(length=1500, bump=Bump(height=0)), estimation=KALMAN, speed=Speed(target_speed_kmh=50))
TOGETHER = LONG.model_copy(update={"road": LONG.road.model_copy(update={"rear_axle": "together"})})


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
    R = np.diag(np.square(NOISES))
    predicted = solve_discrete_are(A.T, C.T, _accumulated(CAR, STEP, BOTH), R)
    gain = predicted @ C.T @ np.linalg.inv(C @ predicted @ C.T + R)
    ours = kalman_filter(CAR, KALMAN, STEP, INTENSITY)
    np.testing.assert_allclose(ours.gain, gain, rtol=1e-6, atol=1e-9 * np.abs(gain).max())
    np.testing.assert_allclose(ours.covariance, (np.eye(8) - gain @ C) @ predicted, rtol=1e-5, atol=1e-12)


@pytest.mark.parametrize("car", [CAR, Vehicle(front_wheel_mass=5.0, front_damping=100_000.0)], ids=["paper", "stiff"])
def test_a_step_adds_what_is_missing_to_the_covariance_of_a_long_drive(car: Vehicle) -> None:
    """X - e^{Ah} X e^{A'h}, where A X + X A' = -E W E'; a mode that decays within a thousandth of a step too."""
    model, step = half_car(car), 0.05
    decay = expm(model.A * step)
    whole = solve_continuous_lyapunov(model.A, -INTENSITY * model.E[:, :2] @ model.E[:, :2].T)
    exact = whole - decay @ whole @ decay.T
    size = np.sqrt(np.outer(np.diag(exact), np.diag(exact)))
    assert np.all(np.abs(_accumulated(car, step, BOTH) - exact) < 1e-8 * size)


def with_preview(scenario: Scenario, mode: Preview) -> Scenario:
    return scenario.model_copy(update={"mpc": Mpc(preview=mode)})


def filter_of(scenario: Scenario, mode: Preview) -> KalmanFilter:
    """The one that is told of that much."""
    speed = scenario.speed.initial_speed_kmh / 3.6
    intensity = (2 * np.pi * 0.1) ** 2 * scenario.road.roughness * speed / 2
    unseen = _unseen(scenario, mode, speed)
    return kalman_filter(
        scenario.vehicle, scenario.estimation, STEP, intensity, unseen, rear_axle=scenario.road.rear_axle
    )


def seen_by_sensors(scenario: Scenario, time: FloatArray, speed_profile: SpeedProfile) -> FloatArray:
    """Mean velocity of the road under both axles over each step, as the sensors report it (steps, 2) [m/s]."""
    mode, mismatch, road, wheelbase = scenario.mpc.preview, scenario.mismatch, scenario.road, scenario.rear_axle_offset
    if mode == "none":
        return np.zeros((len(time) - 1, 2))
    if mode == "wheelbase":  # the rear axle meets what the front one has passed, at the speed of now
        position, speed = speed_profile.at(time[:-1])
        ends = road_profile(road).height(np.stack([position, position + speed * STEP]) - wheelbase)
        return np.column_stack([np.zeros(len(position)), (ends[1] - ends[0]) / STEP])
    if mode == "obstacle":
        road = road.model_copy(update={"roughness": 0.0})
    position = speed_profile.at(time - mismatch.preview_delay)[0] - mismatch.preview_offset
    heights = road_profile(road).height(np.stack([position, position - wheelbase]))
    return np.asarray(mismatch.preview_gain * np.diff(heights, axis=1).T / STEP)


def driven(scenario: Scenario, strategy: str) -> tuple[Run, Trajectory]:
    """A run, its states [estimate; car] and its commands at the control instants."""
    run = prepare(scenario, strategy)
    with returned(ClosedLoop, "run") as runs:
        run.drive()
    return run, runs[0][1]


def predicted(run: Run, trajectory: Trajectory) -> FloatArray:
    """By the textbook: x̂⁻ = A x̂ + B u + E_b braking + E_r velocity of the road seen; but for the last step."""
    scenario, excitation, commands = run.scenario, run.excitation, trajectory.loop[1:, -2:]
    braking = excitation.grid.braking.reshape(len(commands), -1).mean(axis=1)
    seen, model = seen_by_sensors(scenario, excitation.grid.time, run.speed_profile), discrete(scenario.vehicle, STEP)
    by_model = trajectory.loop[:-1, :8] @ model.A.T + commands @ model.B.T
    return np.asarray(by_model + np.outer(braking, model.E[:, 2]) + seen @ model.E[:, :2].T)[:-1]


@pytest.mark.parametrize(
    ("scenario", "mode"),
    [
        *((LONG, mode) for mode in ("none", "obstacle", "wheelbase", "lookahead")),
        *((TOGETHER, mode) for mode in ("none", "wheelbase", "lookahead")),
    ],
)
def test_the_error_on_a_road_is_the_filters_own_covariance(scenario: Scenario, mode: Preview) -> None:
    """A minute and a half of class B road, on which the road's velocity is nearly white.

    Where both axles meet it together the front one tells of nothing to come.
    """
    _, trajectory = driven(with_preview(scenario, mode), "suspension_only")
    estimate, state = trajectory.loop[:-1, :8], trajectory.loop[:-1, 8:-2]
    expected = np.sqrt(np.diag(filter_of(scenario, mode).covariance))
    error = (estimate - state)[200:].std(axis=0)
    unknown = mode in ("none", "obstacle") or (mode == "wheelbase" and scenario is TOGETHER)
    slow = [4, 6, 7] if unknown and scenario is TOGETHER else [4]
    # Of 10,600 steps some thousand are independent in the slow states: 5 % is two deviations of such a scatter.
    np.testing.assert_allclose(np.delete(error, slow), np.delete(expected, slow), rtol=0.05)
    # The road's velocity is not quite white: where its long waves are not known, the body's velocity, the slowest
    # state, is known better than the filter expects; the wheels' too where both rise with the body.
    least = 0.6 if unknown else 0.9
    assert np.all(least * expected[slow] < error[slow])
    assert np.all(error[slow] < 1.05 * expected[slow])
    assert (error < 0.7 * state[200:].std(axis=0)).sum() >= 6


def test_road_beyond_the_detection_distance_is_unknown_to_the_filter() -> None:
    """A control step is 1.25 m, sensors see 1 m: the front axle's road is unknown, the rear one's has been passed.

    The body is then known as well as with wheelbase preview, and not worse, as where all counted as seen.
    """
    speed = Speed(initial_speed_kmh=90, detection_distance=1, policy="constant")
    errors = {}
    for mode in ("lookahead", "wheelbase"):
        mpc = Mpc(preview=mode, sample_time=0.05)
        _, trajectory = driven(LONG.model_copy(update={"speed": speed, "mpc": mpc}), "suspension_only")
        errors[mode] = (trajectory.loop[:-1, :8] - trajectory.loop[:-1, 8:-2])[200:].std(axis=0)
    np.testing.assert_allclose(errors["lookahead"], errors["wheelbase"], rtol=0.05)


@pytest.mark.parametrize(("offset", "noise"), [(0.3, 0.0), (0.0, 0.003), (0.2, 0.002)])
def test_where_sensors_err_as_expected_the_body_is_known_as_well_as_claimed(offset: float, noise: float) -> None:
    """Its velocity is what the unseen part of the road is measured by; the wheels are known less well than claimed."""
    expected = Mpc(expected_offset=offset, expected_noise=noise)
    actual = Mismatch(preview_offset=offset, preview_noise=noise)
    scenario = LONG.model_copy(update={"mpc": expected, "mismatch": actual})
    _, trajectory = driven(scenario, "suspension_only")
    estimate, state = trajectory.loop[200:-1, :8], trajectory.loop[200:-1, 8:-2]
    error = (estimate - state).std(axis=0) / np.sqrt(np.diag(filter_of(scenario, "lookahead").covariance))
    assert 0.75 < error[4] < 1
    assert error.max() < 3.5


@pytest.mark.parametrize("mode", ["none", "obstacle", "wheelbase", "lookahead"])
def test_the_estimate_follows_the_textbooks_recursion(mode: Preview) -> None:
    """Predict with the model, the command and the road as its sensors report it; the sensors' noise is what remains."""
    wrong = Mismatch(preview_offset=0.2, preview_gain=1.1, preview_delay=0.02)
    road = Road(length=120, bump=Bump(start=80))
    scenario = Scenario(estimation=KALMAN, road=road, mismatch=wrong, mpc=Mpc(preview=mode))
    run, trajectory = driven(scenario, "lv")
    prediction, gain = predicted(run, trajectory), filter_of(scenario, mode).gain
    corrections = (trajectory.loop[1:-1, :8] - prediction).T
    innovation = np.linalg.lstsq(gain, corrections, rcond=None)[0]
    np.testing.assert_allclose(gain @ innovation, corrections, atol=1e-9)
    error = trajectory.loop[1:-1, 8:-2] - prediction
    noise: FloatArray = innovation - measurement(scenario.vehicle).C @ error.T
    np.testing.assert_allclose(np.std(noise, axis=1), NOISES, rtol=0.1)
    alike = np.asarray(np.corrcoef(noise))
    assert np.abs(alike[np.triu_indices(4, 1)]).max() < 0.1


@pytest.mark.parametrize("noise", [0.0005, 0.002, 0.01])
def test_the_unseen_share_moves_the_body_as_the_unseen_road_does(noise: float) -> None:
    """Of noise alone the Wiener estimate leaves S n²/(n² + c/N): white velocity through a first-order high-pass.

    So the body's velocity follows from Lyapunov's equation of the car behind two such filters.
    """
    speed, roughness, model = 13.9, 64e-6, half_car(CAR)
    corner = 2 * np.pi * speed * np.sqrt(roughness * 0.1**2 / (2 * noise**2 * 0.01))
    A = np.zeros((10, 10))
    A[:8, :8], A[:8, 8:], A[8:, 8:] = model.A, -corner * model.E[:, :2], -corner * np.eye(2)
    G = np.vstack([model.E[:, :2], np.eye(2)])
    behind, all_of_it = (solve_continuous_lyapunov(a, -g @ g.T)[4, 4] for a, g in ((A, G), (model.A, model.E[:, :2])))
    # The road's cutoff at 0.01/m and the frequencies beyond 0.05 to 50 Hz make the difference.
    assert unseen_share(CAR, roughness, speed, ExpectedErrors(noise=noise)) == pytest.approx(
        behind / all_of_it, rel=0.05
    )


def test_the_unseen_share_goes_from_nothing_to_all() -> None:
    shares = [unseen_share(CAR, 64e-6, 13.9, ExpectedErrors(offset=each)) for each in (0.0, 0.05, 0.2, 0.5, 2.0, 10.0)]
    assert shares[0] == 0
    assert shares == sorted(shares)
    assert shares[-1] > 0.95
    robust = preset("robust")
    speed, expected = robust.speed.initial_speed_kmh / 3.6, expected_errors(robust.mpc)
    of_robust = unseen_share(robust.vehicle, robust.road.roughness, speed, expected)
    assert of_robust == pytest.approx(0.15, abs=0.005), "as docs/explanation/estimation.md has it"
    assert unseen_share(CAR, 0.0, 13.9, ExpectedErrors(noise=0.001)) == pytest.approx(1)


@pytest.mark.parametrize("strategy", some(1, ["lv", "lv_hil"]))
def test_told_of_the_road_lv_loses_little_on_the_papers_bump(strategy: str) -> None:
    """Against the exact state, mean of five roads.

    Told, the peaks change by up to 2 % of a mean, whose standard deviation over roads is 1 to 3 %: 4 % is the limit.
    Untold, each of the four rises by more than 10 %.
    """

    def peaks(estimation: Estimation) -> FloatArray:
        runs = [simulate(Scenario(road=Road(seed=seed), estimation=estimation), strategy) for seed in range(1, 6)]
        return np.array([[run.metrics["bump"][signal]["peak"] for signal in PAPER_SIGNALS] for run in runs])

    exact = peaks(Estimation())
    told, untold = ((peaks(each) / exact - 1).mean(axis=0) for each in (KALMAN, UNTOLD))
    assert np.abs(told).max() < 0.04
    assert untold.min() > 0.1


def test_the_loop_has_the_regulators_poles_and_the_filters() -> None:
    """Separation: with the model it believes in, neither moves the other's (Åström and Wittenmark 1997, 11.4)."""
    run = prepare(Scenario(vehicle=CAR, estimation=KALMAN), "lqr")
    loop = sampled_loop(run, stage_law(run, "cruise"), CAR, run.speed_profile.initial_speed)
    assert loop.estimator is not None
    model, gain = discrete(CAR, STEP), loop.law.gain[:, :8]
    poles = np.concatenate(
        [np.linalg.eigvals(model.A + model.B @ gain), np.linalg.eigvals(loop.estimator.state), np.zeros(2)]
    )
    ours = np.linalg.eigvals(loop.closed)
    for pole in poles:
        assert np.abs(ours - pole).min() < 1e-5, pole
