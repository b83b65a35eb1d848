"""Semi-active dampers: they take energy out in every substep, within their range, and are an adaptive solver's."""

from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim_core.arrays import FloatArray
from sim_core.loop.run import Run
from sim_core.result import StrategyResult
from sim_core.scenario import Actuator, Bump, Estimation, Hook, Mismatch, Mpc, Road, Scenario, Speed, Vehicle
from sim_core.simulate import simulate
from tests.validation.caught import returned
from tests.validation.nonlinear_loops import errors, worst
from tests.validation.strategies import between, examples

LAWS = ("skyhook", "groundhook", "hybrid")
SHORT = Road(length=30, roughness=256e-6, bump=Bump(start=15))


def recorded(scenario: Scenario, law: str) -> tuple[FloatArray, StrategyResult]:
    """The samples of a run in which every substep is one: fine steps of 0.1 ms."""
    with (
        returned(Run, "drive") as drives,
        patch("sim_core.loop.excitation.longest_fine_step", lambda *_, **__: 1e-4),
    ):
        result = simulate(scenario, law)
    run, trajectory = drives[0]
    return trajectory.sample(run.first_step, len(trajectory.loop) - 1), result


def damper(scenario: Scenario, law: str) -> tuple[FloatArray, FloatArray]:
    """Speed of travel [m/s] and force of damper and control together [N], (2, commands, samples of each)."""
    table, car = recorded(scenario, law)[0], scenario.real_vehicle
    speed, control = table[:2], table[-2:]
    ratio = car.rebound_ratio
    mean = np.array([car.front_damping, car.rear_damping]).reshape(2, 1, 1)
    passive = mean * 2 / (1 + ratio) * np.where(speed > 0, ratio, 1.0)
    return speed, passive * speed - control


damping = between(0, 10_000) | between(0, 500_000)  # the sliders' range, and the fields'
ranges = st.tuples(damping, st.none() | damping).filter(lambda both: both[1] is None or both[1] >= max(both[0], 10))
semi_active = st.builds(
    lambda least_and_most, **others: Hook(
        semi_active=True, min_damping=least_and_most[0], max_damping=least_and_most[1], **others
    ),
    ranges | st.just((0.0, None)),
    skyhook_damping=damping,
    groundhook_damping=damping,
    alpha=between(0, 1),
)
scenarios = st.builds(
    Scenario,
    vehicle=st.builds(
        Vehicle,
        front_damping=between(500, 10_000),
        rear_damping=between(500, 10_000),
        rebound_ratio=st.just(1.0) | between(0.1, 10),
    ),
    road=st.just(SHORT),
    speed=st.builds(Speed, initial_speed_kmh=between(20, 90)),
    actuator=st.builds(
        Actuator,
        bandwidth=st.none() | between(0.5, 50),
        rate_limit=st.none() | between(1000, 500_000),
        saturation=st.none() | between(100, 10_000),
    ),
    mismatch=st.builds(Mismatch, damping=between(0.5, 1.5)),
    estimation=st.builds(Estimation, kind=st.sampled_from(["exact", "kalman"])),
    mpc=st.builds(Mpc, sample_time=st.sampled_from([0.002, 0.01, 0.02]), force_limit=between(100, 10_000)),
    hook=semi_active,
)


def assert_takes_energy_out(scenario: Scenario, law: str) -> None:
    """At every sample; and as a whole it is what it can be set to."""
    speed, force = damper(scenario, law)
    power = force * speed
    assert power.max() > 0
    assert power.min() >= -1e-9 * power.max()
    hook = scenario.hook
    # Force and speed are rounded to some 1e-13 of the largest.
    scale = 1e-9 * np.abs(force).max()
    assert (np.abs(force) >= hook.min_damping * np.abs(speed) - scale).all()
    if hook.max_damping is not None:
        assert (np.abs(force) <= hook.max_damping * np.abs(speed) + scale).all()


@settings(max_examples=examples(90))
@given(scenarios, st.sampled_from(LAWS))
def test_damper_and_control_take_energy_out_in_every_substep(scenario: Scenario, law: str) -> None:
    assert_takes_energy_out(scenario, law)


@settings(max_examples=examples(15))
@given(scenarios, st.sampled_from(LAWS))
def test_forces_stay_within_the_limits_where_the_passive_damper_is_within_the_range(
    scenario: Scenario, law: str
) -> None:
    scenario = scenario.model_copy(update={"hook": scenario.hook.model_copy(update={"min_damping": 0.0})})
    if scenario.hook.max_damping is not None:
        scenario = scenario.model_copy(update={"hook": scenario.hook.model_copy(update={"max_damping": 500_000.0})})
    most = min(scenario.mpc.force_limit, scenario.actuator.saturation or np.inf)
    series = recorded(scenario, law)[1].series
    assert max(np.abs(series[f"{axle}_force"]).max() for axle in ("front", "rear")) <= most


def constant_speed(hook: Hook, kmh: float = 60, **parts: object) -> Scenario:
    return Scenario(
        hook=hook,
        road=Road(length=24, roughness=256e-6, bump=Bump(start=10)),
        speed=Speed(policy="constant", initial_speed_kmh=kmh),
        **parts,  # type: ignore[arg-type]
    )


LIMITED = Hook(semi_active=True, min_damping=500, max_damping=15_000)
UNEQUAL = Vehicle(rebound_ratio=2.5, bump_stop_clearance=0.06)


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("scenario", "law"),
    [
        (constant_speed(LIMITED, vehicle=UNEQUAL, actuator=Actuator(bandwidth=10)), "skyhook"),
        (constant_speed(LIMITED, vehicle=UNEQUAL), "groundhook"),
        (
            constant_speed(Hook(semi_active=True, skyhook_damping=10_000), vehicle=UNEQUAL, mpc=Mpc(force_limit=1500)),
            "skyhook",
        ),
        (constant_speed(LIMITED, kmh=47), "skyhook"),  # the car is linear but for its dampers
    ],
)
def test_metrics_are_an_adaptive_solvers(scenario: Scenario, law: str) -> None:
    rms, peak = worst(errors(scenario, law))
    assert rms < 0.001
    assert peak < 0.004
