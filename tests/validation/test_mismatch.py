"""A real car and real sensors other than the controllers believe."""

import numpy as np
import pytest

from sim_core import Bump, Mismatch, Preview, Road, Scenario, Speed, Vehicle, simulate
from sim_core.loop.excitation import excite
from sim_core.loop.preview import preview
from sim_core.road import profile as road
from sim_core.road.sensed import ExpectedErrors, sensed_road, trusted
from sim_core.speed.profile import make_speed_profile

SHORT = Scenario(road=Road(length=60, bump=Bump(start=40, width=3)), speed=Speed(detection_distance=30))


def test_a_passive_car_with_other_parameters_is_that_other_car() -> None:
    """Nothing controls it, so what is believed cannot matter: mismatch and vehicle are two ways to say the same."""
    mismatch = Mismatch(body_mass=1.2, springs=0.9, damping=0.7, tyres=1.1)
    believed = simulate(SHORT.model_copy(update={"mismatch": mismatch}), "passive")
    real = simulate(SHORT.model_copy(update={"vehicle": mismatch.real(Vehicle())}), "passive")
    for signal, values in real.series.items():
        assert np.array_equal(believed.series[signal], values), signal
    assert believed.reference["front_static_load"] == real.reference["front_static_load"]


def expected(mismatch: Mismatch, driven: Road = SHORT.road, mode: Preview = "lookahead") -> np.ndarray:
    scenario = SHORT.model_copy(update={"road": driven, "mismatch": mismatch})
    return previewed(scenario, mode, 0.01, 10)


def previewed(scenario: Scenario, mode: Preview, step: float, horizon: int) -> np.ndarray:
    """The disturbances expected in each control step [s], those of one kind after another (steps, 3 · horizon)."""
    speed_profile = make_speed_profile(scenario, "constant")
    excitation = excite(scenario.road, scenario.rear_axle_offset, speed_profile, step, 10)
    expected = preview(mode, scenario, speed_profile, excitation, horizon).disturbances
    return expected.transpose(1, 0, 2).reshape(expected.shape[1], -1)


def test_the_rear_axles_road_is_known_as_far_as_the_front_one_has_driven() -> None:
    """Twelve control steps of a 128th of a second at 72 km/h are a wheelbase of 1.875 m, without any rounding."""
    vehicle = Vehicle(cg_to_front=0.9375, cg_to_rear=0.9375)
    scenario = SHORT.model_copy(update={"vehicle": vehicle, "speed": Speed(initial_speed_kmh=72)})
    front, rear, _ = np.split(previewed(scenario, "wheelbase", 2.0**-7, 14), 3, axis=1)
    assert not front.any()
    assert rear[:, :12].all(axis=0).all()
    assert not rear[:, 12:].any()


@pytest.mark.parametrize("mode", ["lookahead", "obstacle", "wheelbase"])
def test_sensors_see_as_far_as_they_detect_the_bump(mode: Preview) -> None:
    """16 control steps of a 128th of a second at 72 km/h are 2.5 m; the rear axle's road is seen 12 steps longer."""
    wheelbase = {"vehicle": Vehicle(cg_to_front=0.9375, cg_to_rear=0.9375)}
    near, far = (
        np.split(previewed(SHORT.model_copy(update=wheelbase | {"speed": speed}), mode, 2.0**-7, 30), 3, axis=1)
        for speed in (Speed(initial_speed_kmh=72, detection_distance=distance) for distance in (2.5, 80))
    )
    for within, whole, last in zip(near, far, (30, 30, 30) if mode == "wheelbase" else (16, 28, 30), strict=True):
        np.testing.assert_array_equal(within[:, :last], whole[:, :last])
        assert not within[:, last:].any()
    assert near[1].any()
    assert far[0][:, 16:].any() == (mode != "wheelbase")


@pytest.mark.parametrize("mode", ["lookahead", "obstacle", "wheelbase"])
def test_where_both_axles_meet_the_road_together_they_see_the_same_and_behind_the_front_there_is_nothing(
    mode: Preview,
) -> None:
    scenario = SHORT.model_copy(update={"road": SHORT.road.model_copy(update={"rear_axle": "together"})})
    front, rear, _ = np.split(previewed(scenario, mode, 0.01, 10), 3, axis=1)
    np.testing.assert_array_equal(front, rear)
    assert front.any() == (mode != "wheelbase")


def test_preview_offset_and_delay_show_the_road_elsewhere() -> None:
    """At constant speed v an offset of v·Ts is one control step, and so is a delay of Ts: the true window, shifted."""
    exact, speed = expected(Mismatch()), SHORT.speed.initial_speed_kmh / 3.6
    late = expected(Mismatch(preview_offset=speed * 0.01))
    assert np.allclose(late[1:], exact[:-1], atol=1e-9)
    assert np.allclose(expected(Mismatch(preview_delay=0.01)), late, atol=1e-9)


def test_preview_gain_and_noise_scale_the_heights() -> None:
    exact = expected(Mismatch())
    assert np.allclose(expected(Mismatch(preview_gain=0.8)), 0.8 * exact)
    noisy = expected(
        Mismatch(preview_noise=0.001), Road(roughness=0, length=60, bump=Bump(height=0, start=40, width=3))
    )
    # A velocity is the difference of two heights over Ts, each linear between two samples: √(2 · 2/3) times the noise.
    assert noisy[:, 0].std() == pytest.approx(np.sqrt(4 / 3) * 0.001 / 0.01, rel=0.15)  # 5 standard errors of some 700


def test_noise_lies_in_the_road() -> None:
    """Both axles get the same noise at the same position, at any speed."""
    flat = Road(roughness=0, length=60, bump=Bump(height=0, start=40, width=3))
    car, noise = Vehicle(cg_to_front=1.0, cg_to_rear=1.0), Mismatch(preview_noise=0.002)
    scenario = SHORT.model_copy(update={"road": flat, "vehicle": car, "mismatch": noise})
    speed = SHORT.speed.initial_speed_kmh / 3.6
    step = 2.0 / speed / 12  # the wheelbase is twelve control steps long
    seen = previewed(scenario, "lookahead", step, 5)
    front, rear = seen[:, 0], seen[:, 5]
    assert np.abs(front).max() > 0.05
    np.testing.assert_allclose(rear[12:], front[:-12], atol=1e-9)


@pytest.mark.parametrize("resolution", [1e-9, 0.004, 0.01, 0.03, 0.035, 0.05, 0.1, 2.0])
def test_resolution_averages_over_its_true_length(resolution: float) -> None:
    """The mean of |x| over a length L about x is L/4 + x²/L within L/2 of the kink, and |x| beyond."""
    x = road.GRID * np.arange(-400, 401)
    roof = road.rough_profile(np.abs(x), Bump(height=0))
    errors = Mismatch(preview_resolution=resolution)
    sensed = sensed_road(roof, Road(), errors, ExpectedErrors(), obstacle_alone=False).roughness
    within = np.abs(x) < resolution / 2
    expected = np.where(within, resolution / 4 + x**2 / resolution, np.abs(x))
    inner = slice(110, -110)  # beyond its ends the road is level
    np.testing.assert_allclose(sensed[inner], expected[inner], atol=1e-12)


def test_obstacle_is_the_bump_without_the_roughness() -> None:
    smooth = SHORT.road.model_copy(update={"roughness": 0.0})
    errors = Mismatch(preview_offset=0.1, preview_gain=0.9, preview_delay=0.01)
    alone = expected(errors, smooth)
    assert np.abs(alone[:, :20]).max() > 0.1
    np.testing.assert_allclose(expected(errors, mode="obstacle"), alone, atol=1e-12)


def test_trust_is_the_best_linear_estimate() -> None:
    """Its mean square error is ∫ S N / (S + N) dn (Wiener): less than all trust and than none leave."""
    roughness, noise, count = 64e-6, 0.003, 2**16
    true, _ = road._roughness(roughness, 7, count * road.GRID - 47)
    rng = np.random.default_rng(3)
    seen = true + noise * rng.standard_normal(len(true))
    estimate = trusted(seen, roughness, ExpectedErrors(noise=noise))
    n = np.linspace(0, 0.5 / road.GRID, 200_001)
    S, N = roughness * 0.01 / (n**2 + 0.011**2), 2 * noise**2 * road.GRID
    best = np.trapezoid(S * N / (S + N), n)
    error = np.mean((estimate - true)[1000:-1000] ** 2)
    assert error == pytest.approx(best, rel=0.1)
    assert error < 0.3 * np.mean((seen - true) ** 2)
    assert trusted(seen, roughness, ExpectedErrors()) is seen
    assert np.isfinite(trusted(seen, 0.0, ExpectedErrors(noise=1e-170))).all()


def test_the_more_offset_is_expected_the_less_of_the_short_waves_is_trusted() -> None:
    """A sine of wave number n keeps exp(-(2π n s)²/2) of its height: the mean of a sine seen at a normal offset."""
    position = road.GRID * np.arange(20_000)
    for wavelength in (1.0, 2.0, 10.0):
        sine = np.sin(2 * np.pi * position / wavelength)
        estimate = trusted(sine, 64e-6, ExpectedErrors(offset=0.3))
        assert estimate[5000:15_000].std() / sine[5000:15_000].std() == pytest.approx(
            np.exp(-((2 * np.pi * 0.3 / wavelength) ** 2) / 2), abs=0.01
        )
