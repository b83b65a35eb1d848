"""Converters, delay, jitter, losses and noise of the loop around an ECU."""

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim_core import Actuator, Bump, FloatArray, Hil, Mpc, Road, Scenario, Speed, StrategyResult, simulate
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import convert, highest_code
from sim_core.ecu.program import Connect, Ecu, Frame, Reply
from sim_core.strategies.lv_hil import LvHil
from tests.results import event

SHORT = Scenario(
    road=Road(length=12, bump=Bump(start=4, width=3, height=0.05)),
    speed=Speed(initial_speed_kmh=40, target_speed_kmh=40),
    mpc=Mpc(prediction_horizon=8, control_horizon=4),
)


def scenario(**hil: object) -> Scenario:
    return SHORT.model_copy(update={"hil": Hil(**hil)})  # type: ignore[arg-type]  # pydantic checks them


class Scripted(Ecu):
    """Answers step k with the front code k + 1, and keeps the frames."""

    def __init__(self) -> None:
        self.frames: list[Frame] = []

    def exchange(self, frame: Frame) -> Reply | None:
        self.frames.append(frame)
        return Reply(commands=(frame.step + 1, 0), limited=False, iterations=0, unfinished=False, slack=0.0)


def scripted(ecu: Ecu) -> Connect:
    @contextmanager
    def connect(_: Calibration) -> Iterator[Ecu]:
        yield ecu

    return connect


def commanded(of: Scenario, ecu: Ecu) -> tuple[FloatArray, StrategyResult]:
    """The front actuator's force in codes, millisecond by millisecond from x = 0, and the result."""
    result = simulate(of, LvHil(connect=scripted(ecu)))
    step = of.mpc.force_limit / highest_code(of.hil.bits)
    every = round(0.001 / result.series["time"][1])
    return result.series["front_force"][::every] / step, result


@given(
    st.lists(st.floats(-20, 20), min_size=1, max_size=20).map(np.array),
    st.floats(0.01, 10),
    st.integers(4, 24),
)
def test_a_converter_rounds_to_its_nearest_step_and_clips(values: FloatArray, full_scale: float, bits: int) -> None:
    codes, clipped = convert(values, full_scale, bits)
    step = full_scale / (2 ** (bits - 1) - 1)
    inside = np.abs(values) <= full_scale
    assert clipped == np.count_nonzero(np.abs(values) > full_scale + step / 2)
    # Half a step, and rounding of the quotient, which has at most 24 bits before the point.
    assert np.abs(codes * step - values)[inside].max(initial=0) <= step / 2 * (1 + 1e-6)
    assert np.abs(codes).max() <= 2 ** (bits - 1) - 1
    assert np.array_equal(convert(-values, full_scale, bits)[0], -codes), "both sides alike"
    assert convert(np.zeros(3), full_scale, bits)[0].tolist() == [0, 0, 0]


def test_a_command_takes_effect_one_control_step_after_its_measurement() -> None:
    """Step k's answer, code k + 1, is in force from the instant of step k + 1 on, for a whole step."""
    ecu = Scripted()
    codes, result = commanded(scenario(), ecu)
    before = round(codes[0])  # the run-in's steps
    expected = before + np.arange(len(codes)) // 10
    np.testing.assert_allclose(codes, expected, atol=1e-6)
    assert result.events["ecu_held_commands"] == 0
    # At x = 0 the answer to the frame before is in force.
    assert before == len(ecu.frames) - (len(codes) - 1) // 10 - 1


def test_jitter_delays_by_whole_milliseconds_up_to_its_limit_and_never_hurries() -> None:
    codes, _ = commanded(scenario(jitter=0.004), Scripted())
    on_time, _ = commanded(scenario(), Scripted())
    behind = np.round(on_time - codes)
    assert set(behind.tolist()) == {0.0, 1.0}, "late commands come within the step"
    delays = [int(behind[first : first + 10].sum()) for first in range(0, len(behind) - 10, 10)]
    assert set(delays) == {0, 1, 2, 3, 4}
    assert all(
        sorted(behind[i * 10 : i * 10 + 10])[::-1] == behind[i * 10 : i * 10 + 10].tolist() for i in range(len(delays))
    )


def test_a_lost_command_leaves_the_last_one_in_force() -> None:
    ecu = Scripted()
    codes, result = commanded(scenario(packet_loss=0.3, seed=4), ecu)
    on_time, _ = commanded(scenario(), Scripted())
    held = np.round(codes[::10]) < np.round(on_time[::10])
    assert (np.round(codes) <= np.round(on_time)).all()
    # Each control step with an old command is one lost: those of the run-in are not on record.
    assert 0.15 < held.mean() < 0.45
    assert held.sum() <= result.events["ecu_held_commands"] <= held.sum() + len(ecu.frames) - len(held) + 1


def test_noise_has_the_share_of_the_range_that_was_asked_for() -> None:
    """With a car at rest on a level road only noise is measured; 3 % is five deviations of that estimate."""
    level = Scenario(
        road=Road(length=30, roughness=0, bump=Bump(start=20, width=2, height=0)),
        speed=Speed(initial_speed_kmh=30, target_speed_kmh=30),
        mpc=Mpc(prediction_horizon=8, control_horizon=4),
        hil=Hil(noise=0.01, bits=16),
    )

    class Silent(Scripted):
        def exchange(self, frame: Frame) -> Reply | None:
            super().exchange(frame)
            return None

    ecu = Silent()
    simulate(level, LvHil(connect=scripted(ecu)))
    measured = np.stack([frame.codes for frame in ecu.frames]) / highest_code(16)
    assert measured.size > 10_000
    assert measured.std() == pytest.approx(0.01, rel=0.03)
    assert abs(measured.mean()) < 0.0005


def test_values_beyond_a_range_are_counted() -> None:
    wall = SHORT.model_copy(update={"road": Road(length=12, bump=Bump(start=4, width=0.2, height=0.5))})
    assert event(simulate(wall, "lv_hil"), "ecu_clipped_values") > 0
    assert event(simulate(SHORT, "lv_hil"), "ecu_clipped_values") == 0


def test_the_actuators_limits_hold_between_control_steps_too() -> None:
    limited = SHORT.model_copy(update={"actuator": Actuator(rate_limit=20_000, saturation=300)})
    series = simulate(limited, "lv_hil").series
    for axle in ("front", "rear"):
        every = round(0.001 / series["time"][1])
        force = series[f"{axle}_force"][::every]
        assert np.abs(force).max() == 300
        assert np.abs(np.diff(force)).max() <= 20.000001


def test_control_steps_in_which_an_actuators_limit_binds_are_counted() -> None:
    """Step k + 1 has the command of k + 1 codes: from step 11 on, 10.5 codes are not enough."""
    code = SHORT.mpc.force_limit / highest_code(SHORT.hil.bits)
    saturated = SHORT.model_copy(update={"actuator": Actuator(saturation=10.5 * code)})
    for driven, free_steps in ((saturated, 11), (SHORT, None)):
        ecu = Scripted()
        limited = event(commanded(driven, ecu)[1], "limited_steps")
        assert limited == (0 if free_steps is None else len(ecu.frames) - free_steps)
