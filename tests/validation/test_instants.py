"""Instants: what a controller planned against what is then driven, and the price of limits against optimality."""

import re
from typing import Any

import daqp
import numpy as np
import pytest

from sim_core import STRATEGIES, Controller, FloatArray, RidelabError, Scenario, Seen, option, simulate
from sim_core.control.mpc_design import MpcDesign
from sim_core.control.plan import Plan
from sim_core.control.qp import CENTI, Qps
from sim_core.instant import instant
from sim_core.scenario.measured import MeasuredRoad
from sim_core.simulate import prepare
from sim_core.strategies.suspension_only import SuspensionOnly
from tests.there import there

BUMP = {"bump": {"start": 40, "height": 0.1}, "length": 60}
BOUND = Scenario.model_validate({"road": BUMP, "mpc": {"force_limit": 1500, "deflection_limit": 0.03}})
AT_BUMP = 40.3  # where limits of both kinds bind
LIMITS = ["front_force", "rear_force", "front_deflection", "rear_deflection"]
LAGGING = {"estimation": {"kind": "kalman"}, "actuator": {"bandwidth": 10, "rate_limit": 20_000, "saturation": 1000}}


@pytest.mark.parametrize("parts", [{}, LAGGING, {"hook": {"semi_active": True}}])
@pytest.mark.parametrize("strategy", STRATEGIES)
def test_an_instant_is_of_the_run_that_simulate_drives(strategy: str, parts: dict[str, Any]) -> None:
    """State and force are the recorded ones; time and position find the same step.

    A held force is the next sample's too; one that lags, or is a damper's, has moved on by 2 % of its limit at most.
    """
    scenario = Scenario.model_validate({**BOUND.model_dump(), **parts})
    series = simulate(scenario, strategy).series
    at = instant(scenario, strategy, position=AT_BUMP)
    again = instant(scenario, strategy, time=at.time)
    assert (again.step, again.position) == (at.step, at.position)
    before, after = np.flatnonzero(np.abs(series["time"] - at.time) < 1e-9)[[0, -1]]
    for axle, where in enumerate(("front", "rear")):
        assert series[f"{where}_deflection"][before] == pytest.approx(at.state[axle], abs=1e-9)
        force = series[f"{where}_force"][after + 1]
        assert force == pytest.approx(at.acting[axle], abs=0.02 * BOUND.mpc.force_limit if parts else 1e-6)
    asked = there(at.asked)
    if not at.limits:
        assert strategy in ("passive", "speed_only")
    elif all(limit.distance > 0 for limit in at.limits) and strategy != "lv_hil":
        np.testing.assert_allclose(at.command, asked, atol=1e-6)
    assert (at.plan is None) == (strategy not in ("lv", "lv_hil", "suspension_only"))
    assert (at.estimated_state is None) == (not parts.get("estimation") or not STRATEGIES[strategy].actuated)


class Follows(Controller):
    """Commands given forces from one control step on, none before."""

    id, label = "follows", "Follows a plan"

    def __init__(self, first: int = 0, forces: FloatArray | None = None) -> None:
        super().__init__()
        self._first, self._forces = first, np.zeros((0, 2)) if forces is None else forces

    def force(self, seen: Seen) -> FloatArray:
        """Those."""
        later = seen.step - self._first
        return self._forces[later] if 0 <= later < len(self._forces) else np.zeros(2)


def planned(scenario: Scenario, controller: Controller, step: int, state: FloatArray, previous: FloatArray) -> Plan:
    """A controller's plan at a step of a run, from any state."""
    run = prepare(scenario, controller)
    run.controller.start(run.setup())
    forecast = run.forecast(run.preview, run.preview_steps)
    return there(run.controller.plan(Seen(run.inputs(forecast), run.car(), step, step, state, previous)))


def test_a_plan_that_is_followed_with_a_perfect_model_is_what_the_simulation_does() -> None:
    """To 1e-9 of the largest number: the road bends at control instants alone, where the plan takes it to bend.

    At 10 m/s the front axle passes a kink each 10 cm at the end of a control step of 10 ms; so does the rear one, 29 of
    them later.
    """
    kinks = 0.02 * np.random.default_rng(7).standard_normal(601).round(2)
    road = MeasuredRoad.of(np.interp(np.arange(0, 60.005, 0.01), 0.1 * np.arange(601), kinks))
    scenario = Scenario.model_validate(
        {
            "vehicle": {"cg_to_front": 1.0, "cg_to_rear": 1.9},
            "road": {"profile": road.id, "length": 60, "roughness": 0.001, "bump": {"height": 0, "start": 50}},
            "speed": {"initial_speed_kmh": 36, "policy": "constant"},
            "mpc": {"force_limit": 800, "deflection_limit": 0.02},
        }
    ).on(road)
    without = prepare(scenario, Follows())
    first = without.first_step + 200
    now = without.drive().loop[first]
    plan = planned(scenario, SuspensionOnly(), first, now[:8], now[8:])
    assert any(limit.multiplier for limit in plan.limits), "a limit binds"
    driven = prepare(scenario, Follows(first, plan.forces)).drive().loop
    there = driven[first : first + len(plan.states), :8]
    np.testing.assert_allclose(there, plan.states, atol=1e-9 * np.abs(plan.states).max())


def by_daqp(design: MpcDesign, inputs: FloatArray, without: str | None) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return forces [N] of the QP without the rows of one limit; multipliers of moves and of deflections."""
    qps = Qps(design.qp)
    qps.pose(design.qp, inputs)
    n, rows = design.qp.columns.shape
    low, high = np.append(design.qp.low, np.full(rows, -1e30)), np.append(design.qp.high, qps.b)
    upper, lower = np.arange(n, n + rows).reshape(2, 2, rows // 4)
    of_limit = dict(
        zip(LIMITS, (np.arange(0, n - 2, 2), np.arange(1, n - 2, 2), *np.hstack([upper, lower])), strict=True)
    )
    if without:
        low[of_limit[without]], high[of_limit[without]] = -1e30, 1e30
    y, _, flag, info = daqp.solve(design.qp.H.copy(), qps.f, design.qp.columns.T.copy(), high, low, primal_tol=1e-10)
    assert flag == 1
    above, below = info["lam"][n:].reshape(2, -1)
    return y[:2] * 1000, info["lam"][: n - 2] / 1000, (above - below) * CENTI


def test_forces_without_a_limit_and_all_multipliers_are_those_of_daqp() -> None:
    """To 1e-6 of the largest: two solvers of one QP, the one without a limit being the QP without its rows."""
    at = instant(BOUND, "suspension_only", position=AT_BUMP)
    run = prepare(BOUND, "suspension_only")
    run.controller.start(run.setup())
    assert isinstance(run.controller, SuspensionOnly)
    disturbances = run.forecast(run.preview, run.preview_steps).disturbances[:, at.step]
    design = run.controller.designs(run.setup())[at.stage]
    inputs = np.concatenate([at.state, at.previous, disturbances.ravel()])
    force, of_moves, of_travel = by_daqp(design, inputs, None)
    np.testing.assert_allclose(at.command, force, atol=1e-6 * BOUND.mpc.force_limit)
    ours = {limit.name: limit for limit in at.limits}
    assert list(ours) == LIMITS
    assert sum(bool(limit.multiplier) for limit in ours.values()) >= 3
    theirs = dict(zip(LIMITS, (of_moves[::2], of_moves[1::2], *np.split(of_travel, 2)), strict=True))
    plan, travel, forces = there(at.plan), BOUND.mpc.deflection_limit, BOUND.mpc.force_limit
    limited = dict(zip(LIMITS, (*plan.forces.T, *plan.states[1:, :2].T), strict=True))
    for name, limit in ours.items():
        np.testing.assert_allclose(limit.values, limited[name][: len(limit.values)], rtol=1e-9)
        assert limit.bound == pytest.approx(travel if limit.unit == "m" else forces)
        assert limit.multipliers is not None
        np.testing.assert_allclose(limit.multipliers, theirs[name], atol=1e-6 * np.abs(theirs[name]).max(initial=1e-3))
        freed = by_daqp(design, inputs, name)[0]
        np.testing.assert_allclose(there(limit.force_without), freed, atol=1e-6 * np.abs(freed).max())
    assert "limit shapes it" in at.why


@pytest.mark.parametrize("compensation", ["predict", "none"])
def test_an_ecus_plan_begins_with_the_command_that_its_program_gives(compensation: str) -> None:
    """To half a code of a command: the program solves the same QP in float32, of the same codes.

    The travel predicted for when it takes effect is what is then driven, to three of its codes of 0.07 mm.
    """
    hil = {"compensation": compensation, "iterations": 60}
    scenario = Scenario.model_validate({**BOUND.model_dump(), "hil": hil})
    codes = 2 ** (scenario.hil.bits - 1) - 1
    for position in np.arange(38, 44, 0.2):
        at = instant(scenario, "lv_hil", position=float(position))
        assert at.plan is not None
        np.testing.assert_allclose(at.plan.forces[0], there(at.asked), atol=0.51 * BOUND.mpc.force_limit / codes)
        begins = instant(scenario, "lv_hil", time=at.time + at.plan.begins * at.sample_time)
        np.testing.assert_allclose(at.plan.states[0, :2], begins.state[:2], atol=3 * 0.15 / codes)
        assert begins.step - at.step == (compensation == "predict")
    assert "limit shapes it" in instant(scenario, "lv_hil", position=AT_BUMP).why


def test_the_sentence_accounts_for_the_whole_force() -> None:
    """To the newton that each number is rounded to; a law without parts says what it saw, and none says minus zero."""
    linear = instant(Scenario(), "lv", position=99.5).why
    whole, *terms = (float(number) for number in re.findall(r"([-+]\d+) N", linear))
    assert len(terms) == 3
    assert whole == pytest.approx(sum(terms), abs=2)
    follows = instant(Scenario(), Follows(forces=np.full((5000, 2), -0.1)), position=60)
    assert f"front {1000 * follows.state[0]:+.1f} mm" in follows.why
    assert follows.why.endswith("front +0 N and rear +0 N.")


class Proportional(Controller):
    """Gives a force in proportion to the deflections."""

    id, label = "proportional", "Proportional"
    gain = 1000.0
    damping: float = option(0.0, unit="N s/m", ge=0, le=20_000)

    def force(self, seen: Seen) -> FloatArray:
        """Against them, and against the body's velocity."""
        force: FloatArray = -self.gain * seen.state[:2] - self.damping * seen.state[4]
        return force


@pytest.mark.parametrize("field", ["gain", "damping"])
def test_an_instant_is_of_the_object_and_the_class_as_they_are_now(field: str) -> None:
    """Also where they were changed since an instant of theirs was asked for: in an attribute or in an option."""
    kind: type[Proportional] = type("Changed", (Proportional,), {})
    controller, place = kind(), {"position": 41.0}
    before = instant(BOUND, controller, **place)
    setattr(controller, field, 9000.0)
    after, driven = instant(BOUND, controller, **place), simulate(BOUND, controller).series
    sample = np.flatnonzero(np.abs(driven["time"] - after.time) < 1e-9)[-1] + 1
    np.testing.assert_allclose(after.command, [driven[f"{axle}_force"][sample] for axle in ("front", "rear")])
    assert np.abs(after.command - before.command).max() > 100
    instant(BOUND, kind, **place)
    setattr(kind, field, 9000.0)
    np.testing.assert_array_equal(instant(BOUND, kind, **place).command, after.command)
    assert simulate(BOUND, kind).summary() == simulate(BOUND, controller).summary()


def test_a_place_beside_the_road_is_refused() -> None:
    for place in ({"position": -1.0}, {"position": 60.1}, {"time": 1e4}, {}, {"position": 1.0, "time": 1.0}):
        with pytest.raises(RidelabError, match=r"The drive goes from 0 to|at a position or at a time"):
            instant(BOUND, "passive", **place)
