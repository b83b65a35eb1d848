"""Speculative blocks change nothing but the time a run takes."""

import numpy as np
import pytest

from sim_core import closed_loop
from sim_core.control import mpc
from sim_core.scenario import Actuator, Bump, Mpc, Road, Scenario, Speed
from sim_core.simulate import simulate

PAPER = Scenario()
HARD = Scenario(road=Road(bump=Bump(height=0.14)), mpc=Mpc(deflection_limit=0.05, force_limit=2500))
LAGGING = Scenario(actuator=Actuator(bandwidth=10, rate_limit=40_000))


@pytest.mark.parametrize("scenario", [PAPER, HARD, LAGGING], ids=["paper", "hard", "lagging"])
@pytest.mark.parametrize("strategy", ["lv", "suspension_only", "lqr", "passive"])
def test_blocks_equal_single_steps(scenario: Scenario, strategy: str, monkeypatch: pytest.MonkeyPatch) -> None:
    fast = simulate(scenario, strategy)
    for name in ("_LONGEST_BLOCK", "_BLOCK_AFTER_LIMIT"):
        monkeypatch.setattr(closed_loop, name, 1)
    single = simulate(scenario, strategy)
    assert fast.events == pytest.approx(single.events, abs=1e-9)
    for name, values in fast.series.items():
        scale = np.abs(single.series[name]).max() or 1.0
        # Rounding only: a prefix sum adds in another order than single steps.
        assert np.abs(values - single.series[name]).max() <= 1e-9 * scale, name


def test_limits_of_the_actuator_alone_need_no_qp() -> None:
    """Forces and travel far from the controller's limits, changes of force slower than it asks for."""
    slow = Scenario(actuator=Actuator(rate_limit=20_000), mpc=Mpc(force_limit=1e5, deflection_limit=1))
    events = simulate(slow, "lv").events
    assert events["limited_steps"] > 100
    assert events["qp_solves"] == 0


@pytest.mark.parametrize("strategy", ["lv", "suspension_only"])
def test_solver_always_on_equals_solver_only_at_limits(strategy: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The unconstrained optimum that meets every limit is the QP's solution."""
    scenario = Scenario(road=Road(length=112, bump=Bump(start=30)), speed=Speed(detection_distance=20))
    sometimes = simulate(scenario, strategy)
    for name in ("WITHIN", "_BOUND_MARGIN"):
        monkeypatch.setattr(mpc, name, -1.0)
    always = simulate(scenario, strategy)
    assert always.events["qp_solves"] > 10 * max(1, sometimes.events["qp_solves"])
    assert always.events["qp_failures"] == always.events["qp_fallbacks"] == 0
    for name in ("front_force", "rear_force"):
        # 5 mN on some kN: what the QP's tolerance of 1e-6 in kN leaves.
        assert np.abs(always.series[name] - sometimes.series[name]).max() <= 5e-3


def test_rate_limit_holds() -> None:
    limited = simulate(Scenario(actuator=Actuator(rate_limit=40_000)), "lv")
    free = simulate(PAPER, "lv")
    most = 40_000 * PAPER.mpc.sample_time  # per control step [N]
    assert np.abs(np.diff(limited.series["front_force"])).max() <= most * (1 + 1e-9)
    assert np.abs(np.diff(free.series["front_force"])).max() > most
    assert limited.events["limited_steps"] > free.events["limited_steps"]


def test_a_lagging_actuator_follows_its_command_at_first_order() -> None:
    """Within a control step the command is held, so the force approaches it by e^(-2π f h) each fine step."""
    result = simulate(Scenario(actuator=Actuator(bandwidth=10)), "lqr")
    h = result.series["time"][1]
    fine = round(PAPER.mpc.sample_time / h)
    force = result.series["rear_force"][: 200 * fine].reshape(200, fine)
    steps = np.diff(force, axis=1)
    assert steps[:, 1:] == pytest.approx(steps[:, :-1] * np.exp(-2 * np.pi * 10 * h), abs=1e-6)
