"""Model predictive suspension control: the law where it holds, else a QP (mpc_design.py has what both are made of)."""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller, undefined
from sim_core.control.declared import scenario_field
from sim_core.control.law import LinearLaw
from sim_core.control.mpc_design import MpcDesign, condensed_mpc
from sim_core.control.mpc_plan import make_plan
from sim_core.control.plan import Plan
from sim_core.control.qp import SOLVERS, Qps
from sim_core.control.seen import Seen, Setup
from sim_core.errors import RidelabError, TooExpensiveError
from sim_core.kernel.qp import Qp
from sim_core.scenario import Preview, Weights

_COSTLY_FIELDS = "mpc.control_horizon", "mpc.prediction_horizon", "mpc.sample_time", "road.length"


class PredictiveController(Controller):
    """MPC with preview: a linear law while no limit binds, else a QP (docs/explanation/mpc.md).

    A QP's answer is verified. Where it fails the other solver is asked, and where both fail the previous force is held;
    from then on the dual method is asked alone: a loop that diverges has many QPs that OSQP takes long to give up.
    A subclass gives the weights of each driving stage.

    Example:
        >>> from sim_core import PredictiveController, Scenario, simulate
        >>> class Even(PredictiveController):
        ...     def weights(self, stage):
        ...         return (1, 1, 6) if stage == "bump" else (1, 1, 1)
        >>> result = simulate(Scenario(), Even)
        >>> result.events["qp_failures"]
        0
    """

    preview: Preview = scenario_field("mpc.preview")
    prediction_horizon: int = scenario_field("mpc.prediction_horizon")
    control_horizon: int = scenario_field("mpc.control_horizon")
    deflection_weight: float = scenario_field("mpc.deflection_weight")
    force_weight: float = scenario_field("mpc.force_weight")
    force_change_weight: float = scenario_field("mpc.force_change_weight")
    solver: str = scenario_field("mpc.solver")
    _qps: Qps | None = None  # of the present run
    _both_failed = False  # in one of its QPs

    def weights(self, stage: str) -> Weights:
        """Return the weights of body acceleration, pitch acceleration and tyre load in a driving stage.

        Raises:
            RidelabError: The class does not define it.
        """
        raise undefined(self, "weights(stage)")

    def designs(self, setup: Setup) -> dict[str, MpcDesign]:
        """Return the MPC of each driving stage.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller.
        """
        horizon = self.prediction_horizon, self.control_horizon, setup.force_limit, self.force_change_weight
        other = self.deflection_weight, self.force_weight
        return {stage: condensed_mpc(setup.cost(self.weights(stage), *other), *horizon) for stage in setup.stages}

    def start(self, setup: Setup) -> None:
        """Design each stage.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller.
        """
        self._designs = self.designs(setup)
        self._qps = Qps(self._designs[setup.stages[0]].qp)
        self._both_failed = False

    def end(self) -> None:
        """Report what the QPs took."""
        if self._qps is not None:  # else it did not start
            solved, _, _, most_slack = self._qps.counts.tolist()
            self.report.solves, self.report.max_slack = int(solved) + self.report.failures, most_slack

    def linear_law(self, stage: str) -> LinearLaw | None:
        """Return the stage's unconstrained optimum."""
        return self._designs[stage].law

    def qp(self, stage: str) -> Qp | None:
        """Return the stage's, where C solves it: none if a subclass decides these steps by a `force` of its own."""
        in_c = self.solver == "daqp" and type(self).force is PredictiveController.force
        return (self._designs[stage].qp, self._qps) if self._qps and in_c else None

    def force(self, seen: Seen) -> FloatArray | None:
        """Return the first forces of the constrained optimum (2,) [N].

        Raises:
            TooExpensiveError: The run's QPs have taken all that one run's may.
            RidelabError: No run has started.
        """
        qps = self._qps
        if qps is None:
            raise RidelabError(f"{type(self).__name__} has to be started before it is asked")
        _, spent, allowed, _ = qps.counts
        if spent > allowed:
            faster = () if self.solver == "daqp" else ("mpc.solver",)
            raise TooExpensiveError("The run's QPs take too many iterations", fields=(*faster, *_COSTLY_FIELDS))
        inputs = np.concatenate([seen.state, seen.previous_force, seen.disturbances.ravel()])
        for name in self._solvers():
            force = qps.solve(self._designs[seen.stage].qp, name, inputs)
            if force is not None:
                self.report.fallbacks += name != self.solver
                return force
        self._both_failed = True
        self.report.failures += 1
        return seen.previous_force

    def plan(self, seen: Seen) -> Plan | None:
        """Return the constrained optimum over the horizon; None where no solver proves one."""
        design = self._designs[seen.stage]
        return make_plan(design, self._solvers(), seen.state, seen.previous_force, seen.disturbances)

    def _solvers(self) -> tuple[str, ...]:
        """Both, the scenario's first; the dual method alone since both failed."""
        if self._both_failed:
            return ("daqp",)
        return (self.solver, *(name for name in SOLVERS if name != self.solver))
