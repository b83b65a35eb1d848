"""The QP solvers: no answer counts without its optimality residuals, and failures are counted, never hidden."""

import numpy as np
import pytest

from sim_core.arrays import FloatArray
from sim_core.control.qp import SOLVERS, TOLERANCE, QpProblem, QpShape, QpSolver
from sim_core.scenario import Actuator, Bump, Mpc, Road, Scenario
from sim_core.simulate import simulate
from tests.results import event


def _problem(shape: QpShape, f: FloatArray, b: FloatArray) -> QpProblem:
    problem = QpProblem(shape)
    problem.f[:], problem.b[:] = f, b
    return problem


def _random_problem(rng: np.random.Generator) -> QpProblem:
    n, m = 6, 9
    root = rng.normal(size=(n, n))
    shape = QpShape(
        H=root @ root.T + 0.1 * np.eye(n), A=rng.normal(size=(m, n)), low=np.full(n, -1.0), high=np.full(n, 1.0)
    )
    return _problem(shape, rng.normal(size=n) * 5, rng.uniform(0.1, 1, size=m))  # y = 0 is feasible


@pytest.mark.parametrize("name", SOLVERS)
def test_solvers_agree_and_their_multipliers_prove_it(name: str) -> None:
    rng = np.random.default_rng(4)
    for _ in range(30):
        problem = _random_problem(rng)
        answers = {key: solver(problem).solve() for key, solver in SOLVERS.items()}
        assert answers[name] is not None
        for other in answers.values():
            assert other == pytest.approx(answers[name], abs=1e-7)


def test_a_tenth_of_a_newton_off_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    """In every QP of a run at its limits, although a slack's price is a thousand in the same gradient."""
    residuals = []
    residual = QpProblem.residual

    def spied(problem: QpProblem, y: FloatArray, multipliers: FloatArray) -> float:
        for force in (0, 1):
            off = y.copy()
            off[force] += 1e-4  # kN
            residuals.append(residual(problem, off, multipliers))
        return residual(problem, y, multipliers)

    monkeypatch.setattr(QpProblem, "residual", spied)
    simulate(HARD, "lv")
    assert len(residuals) > 20
    assert min(residuals) > TOLERANCE


class _Refusing(QpSolver):
    @staticmethod
    def effort(iterations: float, free: int, rows: int) -> float:
        return 0.0

    def _attempt(self) -> None:
        return None


HARD = Scenario(road=Road(bump=Bump(height=0.14)), mpc=Mpc(deflection_limit=0.05, force_limit=2500))


def test_limits_of_the_actuator_alone_need_no_qp() -> None:
    """Forces and travel far from the controller's limits, changes of force slower than it asks for."""
    result = simulate(
        Scenario(actuator=Actuator(rate_limit=20_000), mpc=Mpc(force_limit=1e5, deflection_limit=1)), "lv"
    )
    assert event(result, "limited_steps") > 100
    assert event(result, "qp_solves") == 0


def test_the_other_solver_steps_in_and_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    normal = simulate(HARD, "lv")
    monkeypatch.setitem(SOLVERS, "daqp", _Refusing)
    fallen = simulate(HARD, "lv")
    assert normal.events["qp_fallbacks"] == 0
    assert event(normal, "qp_solves") > 10
    assert fallen.events["qp_fallbacks"] == fallen.events["qp_solves"]
    assert fallen.events["qp_failures"] == 0
    assert fallen.series["front_force"] == pytest.approx(normal.series["front_force"], abs=0.1)


def test_when_no_solver_answers_the_last_force_is_held_and_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in list(SOLVERS):
        monkeypatch.setitem(SOLVERS, name, _Refusing)
    result = simulate(HARD, "lv")
    assert result.events["qp_failures"] == result.events["qp_solves"]
    assert event(result, "qp_failures") > 0
    for name in ("front_force", "rear_force"):
        assert np.isfinite(result.series[name]).all()
        assert np.abs(result.series[name]).max() <= HARD.mpc.force_limit
