"""A real car and real sensors other than the controllers believe."""

import numpy as np
import pytest

from sim_core.drive.preview import preview_windows
from sim_core.drive.sampling import sample_road
from sim_core.drive.speed_profile import drive
from sim_core.scenario import Actuator, Bump, Lqr, Mismatch, Mpc, Road, Scenario, Speed, Vehicle
from sim_core.simulate import simulate
from sim_core.strategies import SpeedPolicy

SHORT = Scenario(road=Road(length=60, bump=Bump(start=40, width=3)), speed=Speed(detection_distance=30))


def test_a_passive_car_with_other_parameters_is_that_other_car() -> None:
    """Nothing controls it, so what is believed cannot matter: mismatch and vehicle are two ways to say the same."""
    mismatch = Mismatch(body_mass=1.2, springs=0.9, damping=0.7, tyres=1.1)
    believed = simulate(SHORT.model_copy(update={"mismatch": mismatch}), "passive")
    real = simulate(SHORT.model_copy(update={"vehicle": mismatch.real(Vehicle())}), "passive")
    for signal, values in real.series.items():
        assert np.array_equal(believed.series[signal], values), signal
    assert believed.reference["front_static_load"] == real.reference["front_static_load"]


def test_a_controller_keeps_its_beliefs() -> None:
    """LQR's gains stay those of the believed car: the loop over the real one is that gain on its states."""
    real = simulate(SHORT.model_copy(update={"mismatch": Mismatch(damping=0.6)}), "lqr")
    real_run = simulate(SHORT.model_copy(update={"vehicle": Mismatch(damping=0.6).real(Vehicle())}), "lqr")
    assert not np.array_equal(real.series["front_force"], real_run.series["front_force"])


@pytest.mark.parametrize("strategy", ["lv", "lqr"])
def test_a_saturated_actuator_gives_no_more(strategy: str) -> None:
    saturated = simulate(SHORT.model_copy(update={"actuator": Actuator(saturation=700)}), strategy)
    forces = np.concatenate([saturated.series["front_force"], saturated.series["rear_force"]])
    assert np.abs(forces).max() == 700
    # One that never binds changes nothing.
    ample = simulate(SHORT.model_copy(update={"actuator": Actuator(saturation=1e6)}), strategy)
    assert ample.metrics == simulate(SHORT, strategy).metrics


def windows(mismatch: Mismatch, road: Road = SHORT.road) -> np.ndarray:
    scenario = SHORT.model_copy(update={"road": road})
    motion = drive(scenario, SpeedPolicy.CONSTANT)
    road_input = sample_road(road, scenario.vehicle.wheelbase, motion, 0.01, 0.001)
    return preview_windows("lookahead", road, motion, road_input, 10, scenario.vehicle.wheelbase, mismatch)


def test_preview_offset_and_delay_show_the_road_elsewhere() -> None:
    """At constant speed v an offset of v·Ts is one control step, and so is a delay of Ts: the true window, shifted."""
    exact, speed = windows(Mismatch()), SHORT.speed.initial_speed_kmh / 3.6
    late = windows(Mismatch(preview_offset=speed * 0.01))
    assert np.allclose(late[1:], exact[:-1], atol=1e-9)
    assert np.allclose(windows(Mismatch(preview_delay=0.01)), late, atol=1e-9)


def test_preview_gain_and_noise_scale_the_heights() -> None:
    exact = windows(Mismatch())
    assert np.allclose(windows(Mismatch(preview_gain=0.8)), 0.8 * exact)
    noisy = windows(Mismatch(preview_noise=0.001), Road(roughness=0, length=60, bump=Bump(height=0, start=40, width=3)))
    # A velocity is the difference of two heights over Ts: √2 times the noise. 5 standard errors of some 700 samples.
    assert noisy[:, 0].std() == pytest.approx(np.sqrt(2) * 0.001 / 0.01, rel=0.15)


def test_preview_lqr_is_the_mpc_without_limits() -> None:
    """With Nc = Np, no Δu weight and limits out of reach, MPC and LQR with the same preview command the same forces."""
    free = {"deflection_limit": 1.0, "force_limit": 1e6, "deflection_weight": 3.0}
    scenario = SHORT.model_copy(
        update={
            "mpc": Mpc(
                **free,
                prediction_horizon=25,
                control_horizon=25,
                force_change_weight=0,
                stage_weights={"cruise": (2, 1, 3), "brake": (2, 1, 3), "bump": (2, 1, 3)},
            ),
            "lqr": Lqr(weights=(2, 1, 3), preview="lookahead", preview_horizon=25),
        }
    )
    lqr, lv = simulate(scenario, "lqr"), simulate(scenario, "lv")
    assert np.abs(lv.series["front_force"]).max() > 500
    for force in ("front_force", "rear_force"):
        # Both solve the same problem, by factorising once and by recursion: rounding only.
        assert np.allclose(lqr.series[force], lv.series[force], rtol=0, atol=1e-5), force
