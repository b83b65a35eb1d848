"""Model predictive suspension control: the law where it holds, else a QP (mpc_design.py has what both are made of)."""

from collections.abc import Mapping

import numpy as np

from sim_core.arrays import BoolArray, FloatArray
from sim_core.control.controller import WITHIN, Controller
from sim_core.control.cost import KILO
from sim_core.control.mpc_design import CENTI, SLACK_LINEAR, MpcDesign
from sim_core.control.qp import MAX_EFFORT, SOLVERS, QpProblem, QpSolver
from sim_core.errors import TooExpensiveError
from sim_core.kernel import prepared
from sim_core.loop.preview import Forecast, flattened
from sim_core.scenario import Mpc
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES
from sim_core.vehicle.model import LAW_INPUTS, LinearLaw

_BOUND_MARGIN = 0.99  # of a limit; the bound is in single precision, whose rounding is 1e-6 of the terms added
_MIN_BOUND_STEPS = 128  # so few cross the bump or follow a limit: most are near one, and the bound rules few out
_COSTLY_FIELDS = "mpc.control_horizon", "mpc.prediction_horizon", "mpc.sample_time", "road.length"


class StageQp:
    """One stage's QPs in one run, in arrays of its own.

    Args:
        design: Of the stage.
        windows: Preview at each control step (3, steps, Np).
    """

    def __init__(self, design: MpcDesign, windows: FloatArray) -> None:
        self.problem = QpProblem(design.shape)
        self.problem.f[-2:] = SLACK_LINEAR / CENTI
        rows, inputs = design.affine.shape
        self._parameters, self._values, self._windows = np.empty(inputs), np.empty(rows), windows
        self._window = self._parameters[LAW_INPUTS:].reshape(DISTURBANCES, -1)
        sizes = len(design.checks), len(design.linear), len(design.travel)
        columns, b = design.affine.T, self.problem.b
        self._set = prepared.qp_at(
            columns, self._parameters, sizes, design.travel_limit, self._values, self.problem.f, b
        )
        self._solvers: dict[str, QpSolver] = {}

    def forces(self, step: int, state: FloatArray, previous: FloatArray) -> tuple[FloatArray, float]:
        """The law's first forces (2,) over their limit, and the largest of the design's checks: above 1 a limit binds.

        The problem is the QP of that control step from now on.
        """
        self._parameters[:STATES] = state
        self._parameters[STATES:LAW_INPUTS] = previous
        self._window[:] = self._windows[:, step]
        return self._values[:FORCES], self._set()

    def solve(self, name: str) -> FloatArray | None:
        """A solver's answer to the problem: its minimiser, if that holds up."""
        solver = self._solvers.get(name)
        if solver is None:
            solver = self._solvers[name] = SOLVERS[name](self.problem)
        return solver.solve()


class MpcController(Controller):
    """MPC over a known preview: the law where it holds, else a QP, verified; else the other solver; else hold."""

    def __init__(self, designs: Mapping[str, MpcDesign], preview: Forecast, mpc: Mpc) -> None:
        super().__init__()
        self._designs = designs
        self._windows = preview.windows
        self._sums = np.vstack([preview.braking, preview.spread])
        self._limit = mpc.force_limit
        self._order = (mpc.solver, *(name for name in SOLVERS if name != mpc.solver))
        self._qps: dict[str, StageQp] = {}
        faster = () if mpc.solver == "daqp" else ("mpc.solver",)
        self._costly_fields = (*faster, *_COSTLY_FIELDS)

    def law(self, stage: str) -> LinearLaw:
        """The stage's unconstrained optimum."""
        return self._designs[stage].law

    def feed(self, stage: str, first: int, last: int) -> FloatArray:
        """Preview's part of the force."""
        return np.asarray(flattened(self._windows[:, first:last]) @ self._designs[stage].feed.T)

    def holds(self, first: int, stage: str, measured: FloatArray, commands: FloatArray) -> BoolArray:
        """Where every force and deflection of the horizon is within its limit.

        A bound rules most steps out; those near a limit are judged by the checks themselves.
        """
        design, steps = self._designs[stage], slice(first, first + len(measured))
        if len(measured) < _MIN_BOUND_STEPS:
            inputs = np.hstack([measured, flattened(self._windows[:, steps])])
            return np.asarray((np.abs(inputs @ design.checks.T) <= WITHIN).all(axis=1))  # a NaN is within nothing
        with np.errstate(over="ignore", invalid="ignore"):  # a loop that diverges is within no limit
            bound = design.bound @ np.concatenate([measured.T, self._sums[:, steps]], dtype=np.float32)
            within = np.asarray(bound.max(axis=0) <= _BOUND_MARGIN)
        near = np.flatnonzero(~within)
        if len(near):
            inputs = np.hstack([measured[near], flattened(self._windows[:, first + near])])
            within[near] = (np.abs(inputs @ design.checks.T) <= WITHIN).all(axis=1)
        return within

    def step(self, step: int, stage: str, state: FloatArray, previous: FloatArray) -> tuple[FloatArray, bool]:
        """The first force of the constrained optimum, and whether it differs from the law's.

        Raises:
            TooExpensiveError: The run's QPs have taken all that one run's may.
        """
        qp = self._qps.get(stage)
        if qp is None:
            qp = self._qps[stage] = StageQp(self._designs[stage], self._windows)
        forces, largest = qp.forces(step, state, previous)
        if largest <= WITHIN:
            return forces * self._limit, False
        if sum([each.problem.spent for each in self._qps.values()]) > MAX_EFFORT:
            raise TooExpensiveError("The run's QPs take too many iterations", fields=self._costly_fields)
        self.report.solves += 1
        for attempt, name in enumerate(self._order):
            y = qp.solve(name)
            if y is not None:
                self.report.fallbacks += attempt
                self.report.max_slack = max(self.report.max_slack, y.item(-2) / CENTI, y.item(-1) / CENTI)
                return self._within_limit(y.item(0) * KILO, y.item(1) * KILO), True
        self.report.failures += 1
        return self._within_limit(*previous), True

    def _within_limit(self, front: float, rear: float) -> FloatArray:
        """The command (2,) for these forces [N]: a few numbers, for which NumPy's own functions take longer."""
        limit = self._limit
        return np.array([min(max(front, -limit), limit), min(max(rear, -limit), limit)])
