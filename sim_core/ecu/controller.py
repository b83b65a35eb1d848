"""The MPC as an ECU drives it: a program apart from the car, behind converters, with delay, jitter and losses.

The ECU measures at the control instants; its answer to instant k takes effect at instant k + 1, later by the jitter, or
never. What its program is, `connect` says.
"""

from contextlib import ExitStack
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.control.cost import KILO
from sim_core.control.declared import scenario_field
from sim_core.control.law import LinearLaw
from sim_core.control.mpc import PredictiveController
from sim_core.control.mpc_plan import make_plan
from sim_core.control.plan import Plan
from sim_core.control.qp import CENTI
from sim_core.control.seen import Seen, Setup
from sim_core.ecu.calibration import Calibration, Checked, calibrate
from sim_core.ecu.channels import STAGES, Codes, convert, full_scales, highest_code
from sim_core.ecu.program import Connect, Frame, Reply, in_process
from sim_core.scenario import Hil
from sim_core.vehicle.half_car import DISTURBANCES, STATES, discrete

_NOISE, _JITTER, _LOSS = 3, 4, 5  # generators of their own beside the road's and the preview's


class EcuController(PredictiveController):
    """A predictive controller whose forces a program gives, in whole steps of its converters.

    A subclass gives the weights of each driving stage.

    Example:
        >>> from sim_core import EcuController, Scenario, simulate
        >>> class EvenEcu(EcuController):
        ...     def weights(self, stage):
        ...         return (1, 1, 6) if stage == "bump" else (1, 1, 1)
        >>> result = simulate(Scenario(), EvenEcu)
        >>> result.events["ecu_clipped_values"]
        0
    """

    delayed = True
    solver = "ecu"  # the program's, whatever `mpc.solver` says
    hil: Hil = scenario_field("hil")

    def __init__(self, *, connect: Connect = in_process, checked: Checked = "all", **values: Any) -> None:
        """Drive with the program that `connect` leads to, which checks all limits of the horizon or a few."""
        super().__init__(**values)
        self._connect = connect
        self._checked = checked

    @property
    def preview_steps(self) -> int:
        """The prediction horizon, and one more where the first step is spent on predicting."""
        return self.prediction_horizon + (self.hil.compensation == "predict")

    def calibration(self, setup: Setup) -> Calibration:
        """Return what the ECU's program knows in such a run.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller.
        """
        model = discrete(setup.vehicle, setup.sample_time)
        return calibrate(self.designs(setup), model, self.hil, setup.force_limit, self._checked)

    def start(self, setup: Setup) -> None:
        """Connect to the program.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller.
        """
        self._connection = ExitStack()
        self._designs = self.designs(setup)
        self._calibration = calibration = self.calibration(setup)
        self._full_scale = full_scales(calibration.preview_length)
        self._noise = self._draw_noise(setup)
        self.report.most_iterations = self.report.clipped_values = 0
        self._ecu = self._connection.enter_context(self._connect(calibration))

    def end(self) -> None:
        """Leave the program."""
        self._connection.close()

    def linear_law(self, stage: str) -> LinearLaw | None:
        """None: its forces are in whole steps of the converters."""
        return None

    def plan(self, seen: Seen) -> Plan | None:
        """The optimum of the QP that the program solves, of what its converters gave, but in double precision."""
        calibration = self._calibration
        values = self._codes(seen)[0] * self._full_scale / highest_code(calibration.bits)
        state, disturbances = values[:STATES], values[STATES:].reshape(DISTURBANCES, -1)
        if calibration.predicts:
            now = calibration.B @ (seen.previous_force / KILO) + calibration.E @ disturbances[:, 0]
            state, disturbances = calibration.A @ state + now, disturbances[:, 1:]
        design = self._designs[self._stage(seen)]
        plan = make_plan(design, self._solvers(), state, seen.previous_force, disturbances)
        return plan and replace(plan, begins=int(calibration.predicts))

    def force(self, seen: Seen) -> FloatArray | None:
        """Return what the program answers; None where nothing came in time."""
        codes, clipped = self._codes(seen)
        self.report.clipped_values = (self.report.clipped_values or 0) + clipped
        reply = self._ecu.exchange(Frame(step=seen.step, stage=STAGES.index(self._stage(seen)), codes=codes))
        if reply is None:
            return None
        self._count(reply)
        return np.array(reply.commands) * (self._calibration.command_step * KILO)

    def _codes(self, seen: Seen) -> tuple[Codes, int]:
        """Return what its converters give, and how many values were beyond their range."""
        values = np.concatenate([seen.state, seen.disturbances.ravel()]) + self._noise[seen.step]
        return convert(values, self._full_scale, self._calibration.bits)

    def _stage(self, seen: Seen) -> str:
        """In which the command takes effect."""
        return seen.next_stage if self._calibration.predicts else seen.stage

    def arrivals(self, setup: Setup) -> NDArray[np.intp]:
        """Return a control step later, and by the jitter; one after the end of the run where it is lost."""
        steps, n = setup.steps, setup.short_steps
        latest = round(self.hil.jitter / setup.short_step)
        delays = np.random.default_rng((self.hil.seed, _JITTER)).integers(0, latest, size=steps, endpoint=True)
        lost = np.random.default_rng((self.hil.seed, _LOSS)).random(steps) < self.hil.packet_loss
        return np.where(lost, steps * n, (np.arange(steps) + 1) * n + delays)

    def _draw_noise(self, setup: Setup) -> FloatArray:
        """Return what noise adds to the inputs in each control step (steps, 8 + 3 · preview_steps)."""
        shape = (setup.steps, len(self._full_scale))
        if not self.hil.noise:
            return np.broadcast_to(0.0, shape)
        generator = np.random.default_rng((self.hil.seed, _NOISE))
        return self.hil.noise * self._full_scale * generator.standard_normal(shape)

    def _count(self, reply: Reply) -> None:
        """Take an answer in."""
        report = self.report
        report.solves += reply.limited
        report.limited_steps += reply.limited
        report.failures += reply.unfinished
        report.most_iterations = max(report.most_iterations or 0, reply.iterations)
        report.max_slack = max(report.max_slack, reply.slack / CENTI)
