"""The QP solvers: no answer counts without its optimality residuals, and failures are counted, never hidden."""

from collections.abc import Iterator
from dataclasses import replace

import daqp
import numpy as np
import pytest

from sim_core import STRATEGIES, Actuator, Bump, FloatArray, Mpc, PredictiveController, Road, Scenario
from sim_core.control import mpc_design
from sim_core.control.qp import SOLVERS, TOLERANCE, Qps
from sim_core.kernel.qp import QpDesign
from sim_core.simulate import prepare, simulate
from tests.results import event

HARD = Scenario(road=Road(bump=Bump(height=0.14)), mpc=Mpc(deflection_limit=0.05, force_limit=2500))
LONG = HARD.model_copy(update={"mpc": Mpc(prediction_horizon=60, control_horizon=40, force_limit=800)})


def designs(scenario: Scenario) -> list[QpDesign]:
    controller = STRATEGIES["lv"]().for_scenario(scenario)
    assert isinstance(controller, PredictiveController)
    return [each.qp for each in controller.designs(prepare(scenario, "lv").setup()).values()]


def random_inputs(inputs: int, number: int) -> Iterator[FloatArray]:
    """States, previous forces and previews, small ones and such as break every limit."""
    rng = np.random.default_rng(4)
    each = np.repeat([0.03, 0.005, 0.3, 0.5, 1000.0, 0.3], [2, 2, 2, 2, 2, inputs - 10])
    for _ in range(number):
        yield each * rng.standard_normal(inputs) * rng.uniform(0.3, 3)


@pytest.mark.parametrize("scenario", [HARD, pytest.param(LONG, marks=pytest.mark.thorough)], ids=["hard", "long"])
def test_solvers_agree_with_each_other_and_with_daqp(scenario: Scenario) -> None:
    """All three are exact once they know which limits bind; measured 1e-10 N, and 4e-5 N between OSQP's and ours."""
    binding, answered = list[int](), 0
    for design in designs(scenario):
        qps = Qps(design)
        lower = np.concatenate([design.low, np.full(design.columns.shape[1], -1e30)])
        for inputs in random_inputs(design.linear_term_gain.shape[1], 25):
            ours = qps.solve(design, "daqp", inputs)
            assert ours is not None
            binding.append(int(np.count_nonzero(qps.multipliers)))
            upper = np.concatenate([design.high, qps.b])
            y, _, flag, _ = daqp.solve(design.H.copy(), qps.f.copy(), design.columns.T.copy(), upper, lower)
            assert flag == 1
            np.testing.assert_allclose(ours, 1000 * y[:2], atol=1e-8)
            by_osqp = qps.solve(design, "osqp", inputs)
            if by_osqp is not None:  # beyond its iterations, where very many limits bind
                answered += 1
                np.testing.assert_allclose(by_osqp, 1000 * y[:2], atol=1e-3)
    assert answered > 0.7 * len(binding)
    assert max(binding) > 30


def test_a_tenth_of_a_newton_off_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    """In every QP of a run at its limits, although a slack's price is a thousand in the same gradient."""
    residuals = []
    solve = Qps.solve

    def spied(qps: Qps, design: QpDesign, solver: str, inputs: FloatArray) -> FloatArray | None:
        force = solve(qps, design, solver, inputs)
        for number in (0, 1):
            qps.y[number] += 1e-4  # kN
            residuals.append(qps.residual(design))
            qps.y[number] -= 1e-4
        return force

    monkeypatch.setattr(Qps, "solve", spied)
    monkeypatch.setattr(PredictiveController, "qp", lambda self, stage: None)
    simulate(HARD, "lv")
    assert len(residuals) > 20
    assert min(residuals) > TOLERANCE


@pytest.mark.parametrize(("off", "answers"), [(1e-8, True), (1e-5, False)])
def test_c_answers_only_where_its_answer_is_that_of_the_qp(off: float, answers: bool) -> None:
    """The QP's linear term is larger by that share than the one from which the answer is made: so is the residual."""
    design = designs(HARD)[0]
    larger = np.where(np.arange(len(design.linear_term_gain)) < design.moves, 1 + off, 1.0)
    other = replace(design, linear_term_gain=design.linear_term_gain * larger[:, np.newaxis])
    for inputs in random_inputs(design.linear_term_gain.shape[1], 3):
        assert (Qps(other).solve(other, "daqp", inputs) is not None) == answers


def test_limits_of_the_actuator_alone_need_no_qp() -> None:
    """Forces and travel far from the controller's limits, changes of force slower than it asks for."""
    result = simulate(
        Scenario(actuator=Actuator(rate_limit=20_000), mpc=Mpc(force_limit=1e5, deflection_limit=1)), "lv"
    )
    assert event(result, "limited_steps") > 100
    assert event(result, "qp_solves") == 0


def _refuse(monkeypatch: pytest.MonkeyPatch, *solvers: str) -> None:
    solve = Qps.solve

    def refusing(qps: Qps, design: QpDesign, solver: str, inputs: FloatArray) -> FloatArray | None:
        return None if solver in solvers else solve(qps, design, solver, inputs)

    monkeypatch.setattr(Qps, "solve", refusing)
    monkeypatch.setattr(PredictiveController, "qp", lambda self, stage: None)


def test_the_other_solver_steps_in_and_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    normal = simulate(HARD, "lv")
    _refuse(monkeypatch, "daqp")
    fallen = simulate(HARD, "lv")
    assert normal.events["qp_fallbacks"] == 0
    assert event(normal, "qp_solves") > 10
    assert fallen.events["qp_fallbacks"] == fallen.events["qp_solves"]
    assert fallen.events["qp_failures"] == 0
    assert fallen.series["front_force"] == pytest.approx(normal.series["front_force"], abs=0.1)


def test_a_qp_that_c_cannot_prove_is_the_other_solvers(monkeypatch: pytest.MonkeyPatch) -> None:
    """The dual method stops after one iteration: it may answer a QP of one limit alone."""
    normal = simulate(HARD, "lv")
    monkeypatch.setattr(mpc_design, "MOST_ITERATIONS", 1)
    uncached = HARD.mpc.model_copy(update={"force_weight": HARD.mpc.force_weight * (1 + 1e-12)})
    fallen = simulate(HARD.model_copy(update={"mpc": uncached}), "lv")
    assert 0 < event(fallen, "qp_fallbacks") < event(fallen, "qp_solves")
    assert fallen.events["qp_failures"] == 0
    assert fallen.series["front_force"] == pytest.approx(normal.series["front_force"], abs=0.1)


def test_when_no_solver_answers_the_last_force_is_held_and_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    _refuse(monkeypatch, *SOLVERS)
    result = simulate(HARD, "lv")
    assert result.events["qp_failures"] == result.events["qp_solves"]
    assert event(result, "qp_failures") > 0
    for name in ("front_force", "rear_force"):
        assert np.isfinite(result.series[name]).all()
        assert np.abs(result.series[name]).max() <= HARD.mpc.force_limit
