"""Model predictive suspension control: the law where it holds, else a QP (mpc_design.py has what both are made of)."""

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller, scenario_field, undefined
from sim_core.control.cost import KILO
from sim_core.control.mpc_design import CENTI, SLACK_LINEAR, MpcDesign, design
from sim_core.control.qp import MAX_EFFORT, SOLVERS, QpProblem
from sim_core.control.seen import Seen, Setup
from sim_core.errors import TooExpensiveError
from sim_core.scenario import Weights
from sim_core.vehicle.model import LinearLaw

_COSTLY_FIELDS = "mpc.control_horizon", "mpc.prediction_horizon", "mpc.sample_time", "road.length"


class StageQp(QpProblem):
    """One stage's QPs in one run."""

    def __init__(self, design: MpcDesign) -> None:
        super().__init__(design.shape)
        self.f[-2:] = SLACK_LINEAR / CENTI
        self._design = design

    def set(self, state: FloatArray, previous_force: FloatArray, disturbances: FloatArray) -> None:
        """Make it the QP of a control step: state (8,), previous force (2,) [N], disturbances (3, Np)."""
        parameters = np.concatenate([state, previous_force, disturbances.ravel()])
        values = self._design.by_parameters @ parameters
        free = len(self.f) - 2
        self.f[:-2], travel = values[:free], values[free:]
        self.b[: len(travel)] = self._design.travel_limit - travel
        self.b[len(travel) :] = self._design.travel_limit + travel


class PredictiveController(Controller):
    """MPC with preview: a linear law while no limit binds, else a QP (docs/physics.md, "MPC").

    A QP's answer is verified. Where it fails the other solver is asked, and where both fail the previous force is held.
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

    control_horizon: int = scenario_field("mpc.control_horizon")
    deflection_weight: float = scenario_field("mpc.deflection_weight")
    force_weight: float = scenario_field("mpc.force_weight")
    force_change_weight: float = scenario_field("mpc.force_change_weight")
    solver: str = scenario_field("mpc.solver")

    def weights(self, stage: str) -> Weights:
        """Of body acceleration, pitch acceleration and tyre load in a driving stage.

        Raises:
            RidelabError: The class does not define it.
        """
        raise undefined(self, "weights(stage)")

    def designs(self, setup: Setup) -> dict[str, MpcDesign]:
        """The MPC of each driving stage.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller.
        """
        horizon = self.prediction_horizon, self.control_horizon, setup.force_limit, self.force_change_weight
        other = self.deflection_weight, self.force_weight
        return {stage: design(setup.cost(self.weights(stage), *other), *horizon) for stage in setup.stages}

    def start(self, setup: Setup) -> None:
        """Design each stage.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller.
        """
        self._designs = self.designs(setup)
        self._order = (self.solver, *(name for name in SOLVERS if name != self.solver))
        self._qps: dict[str, StageQp] = {}

    def linear_law(self, stage: str) -> LinearLaw | None:
        """The stage's unconstrained optimum."""
        return self._designs[stage].law

    def force(self, seen: Seen) -> FloatArray | None:
        """The first forces of the constrained optimum (2,) [N].

        Raises:
            TooExpensiveError: The run's QPs have taken all that one run's may.
        """
        qp = self._qps.get(seen.stage)
        if qp is None:
            qp = self._qps[seen.stage] = StageQp(self._designs[seen.stage])
        if sum([each.spent for each in self._qps.values()]) > MAX_EFFORT:
            faster = () if self.solver == "daqp" else ("mpc.solver",)
            raise TooExpensiveError("The run's QPs take too many iterations", fields=(*faster, *_COSTLY_FIELDS))
        qp.set(seen.state, seen.previous_force, seen.disturbances)
        report = self.report
        report.solves += 1
        for attempt, name in enumerate(self._order):
            y = qp.solve(name)
            if y is not None:
                report.fallbacks += attempt
                report.max_slack = max(report.max_slack, y.item(-2) / CENTI, y.item(-1) / CENTI)
                return y[:2] * KILO
        report.failures += 1
        return seen.previous_force
