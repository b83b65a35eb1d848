"""The C's functions that are called at every step: their arrays are checked once, when a run begins.

Each raises ValueError then where sizes disagree, and TypeError where an array is of another type, is not
C-contiguous, or cannot be written into. The arrays live as long as what is called.
"""

from collections.abc import Callable

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.library import DOUBLE, INT, Array, CStruct, Function, Optional, require, size_of
from sim_core.kernel.qp import Qp
from sim_core.kernel.record import SIGNALS, Recorder

CAR, ESTIMATOR, _LAW_NUMBERS = map(size_of, ("vehicle", "estimator", "law_numbers"))
_STATES, _FORCES, _DISTURBANCES = map(size_of, ("state", "forces", "disturbances"))
CAUSES, NUMBERS, _MEASURED = map(size_of, ("causes", "lagging_state", "measured"))
_LAW_INPUTS, _GROUP = _STATES + _FORCES, size_of("bounded_rows")
_LINE, _TABLE = Array(ndim=1), Array(ndim=2)
_LINE_OUT, _TABLE_OUT, _LINES_OUT = (Array(ndim=ndim, written=True) for ndim in (1, 2, 3))

_prepare_law_design = Function("prepare_law_design", INT, INT, _TABLE, _TABLE, Array(_LAW_INPUTS), _TABLE)
_prepare_run_inputs = Function("prepare_run_inputs", Array(_LAW_NUMBERS), Array(), _TABLE, _LINE_OUT)
_prepare_car = Function(
    "prepare_car",
    *(Array(CAR), INT, INT, Array(CAUSES, NUMBERS), INT, Array(ESTIMATOR), _TABLE),
    *(_TABLE, _LINE, _TABLE, INT, INT, INT, DOUBLE, Optional),
)
_sample = Function("sample", CStruct, _TABLE, INT, INT, _TABLE_OUT, _LINES_OUT)
_follow_law = Function(
    "follow_law",
    *(CStruct, CStruct, _TABLE_OUT, Array(1, dtype=np.intc, written=True)),
    *(CStruct, Optional, Optional, INT, INT),
    result=INT,
)
_limit_force = Function(
    "limit_force", Array(3), Array(_FORCES), Array(_FORCES), Array(_FORCES, written=True), result=INT
)
_advance = Function("advance", CStruct, _TABLE_OUT, INT)
_measure = Function("measure", CStruct, INT, _LINE, Array(_FORCES), Array(_MEASURED, written=True))


def limit_force(limits: FloatArray, wanted: FloatArray, previous: FloatArray, command: FloatArray) -> bool:
    """Fill in what the actuators are told (2,) [N]; whether a limit shapes it.

    Args:
        limits: Greatest force that may be wanted, its greatest change, and the actuators' greatest force (3,) [N].
        wanted: By the controller (2,) [N].
        previous: What they were told before (2,) [N].
        command: To be filled.
    """
    return bool(_limit_force(limits, wanted, previous, command))


class LawDesign:
    """A linear controller and its limits, as loop.h has them.

    Args:
        gain: On the state, the previous force and what is previewed (2, 10 + 3 · horizon).
        limits: (rows, 10 + 3 · horizon).

    Attributes:
        inputs: How many numbers it multiplies.
        horizon: Control steps that it previews.
        prepared: All of it, as C has it.

    Raises:
        ValueError: Sizes disagree.
    """

    def __init__(self, gain: FloatArray, limits: FloatArray) -> None:
        rows, self.inputs = limits.shape
        self.gain, self.limits, self.horizon = gain, limits, (self.inputs - _LAW_INPUTS) // _DISTURBANCES
        fits = self.inputs == _LAW_INPUTS + _DISTURBANCES * self.horizon and self.horizon >= 0
        require(fits and gain.shape == (_FORCES, self.inputs), "Gains and limits on all that the controller knows")
        arrays = gain, limits, *self._row_bounds()
        for each in arrays:
            each.flags.writeable = False  # it is shared by runs
        self.prepared = _prepare_law_design.prepare(rows, self.horizon, *arrays)

    def _row_bounds(self) -> tuple[FloatArray, FloatArray]:
        """`scale` (10,) and `bounds` (groups, 117) of loop.h.

        The norms of each row's parts are of that on state and force in units that make their largest gain 1, on the
        mean deceleration, on both road velocities, and on the deceleration's difference from its mean.
        """
        groups = -(-len(self.limits) // _GROUP)
        rows = np.zeros((groups, _GROUP, self.inputs))
        rows.reshape(-1, self.inputs)[: len(self.limits)] = self.limits
        on_state = rows[:, :, :_LAW_INPUTS]
        by_disturbance = rows[:, :, _LAW_INPUTS:].reshape(groups, _GROUP, _DISTURBANCES, self.horizon)
        scale = np.abs(on_state).max(axis=(0, 1), initial=0.0)
        state = np.linalg.norm(on_state / np.where(scale > 0, scale, 1.0), axis=2)
        mean = np.abs(by_disturbance[:, :, 2].sum(axis=2))
        others = np.dstack([mean, np.linalg.norm(by_disturbance, axis=3)])
        most = np.column_stack([state.max(axis=1), others.max(axis=1)])
        by_number = [part.transpose(0, 2, 1).reshape(groups, _GROUP * part.shape[2]) for part in (on_state, others)]
        return scale, np.hstack([*by_number, most])


FollowLaw = Callable[[LawDesign, Qp | None, int, int], tuple[int, int]]


class DrivenCar:
    """A car over its whole drive, of which a call takes some control steps.

    `size` numbers are the state p: the half-car's (8,), then a lagging actuator's forces [N] (2,). With an estimator
    its estimate (8,) comes before them, so that p begins with what a controller acts on.

    Args:
        vehicle: As `struct vehicle` of car.c has them.
        states: 8, or 10 with a lagging actuator's.
        effects: What each cause alone makes of rest in a linear car's fine step, as car.c has it (15, 10); None of
            another.
        steps: Control steps of the drive.
        fine: Fine steps in each.
        estimator: As `struct estimator` has them; None without one.
        estimator_input: What is fed to it beforehand (steps, 8); of no steps without one.
        height: Of the road under both axles at the ends of all fine steps (2, n + 1) [m].
        braking: Deceleration in each fine step (n,) [m/s^2].
        above_chord: How far the road lies above its chord in each fine step on average, front and rear, then its first
            moments (n, 4) [m]; None where it is straight, as every road is to a linear car.
        substeps: Of Runge-Kutta in a fine step.
        fine_step: In s.
        recorder: Of its drive; None where nothing is measured.

    Raises:
        ValueError: Sizes disagree.
    """

    def __init__(
        self,
        *,
        vehicle: FloatArray,
        states: int,
        effects: FloatArray | None,
        steps: int,
        fine: int,
        estimator: FloatArray | None,
        estimator_input: FloatArray,
        height: FloatArray,
        braking: FloatArray,
        above_chord: FloatArray | None,
        substeps: int,
        fine_step: float,
        recorder: Recorder | None,
    ) -> None:
        all_fine, linear, estimates = steps * fine, effects is not None, estimator is not None
        require(states in (_STATES, NUMBERS), "A state of 8 or 10 numbers")
        require(min(steps, fine, substeps) > 0 and fine_step > 0, "A step or more")
        require(height.shape == (2, all_fine + 1) and len(braking) == all_fine, "Road and braking in every fine step")
        above_chord = np.zeros((0 if linear else all_fine, 4)) if above_chord is None else above_chord
        require(linear or above_chord.shape == (all_fine, 4), "Means and moments of both roads in every fine step")
        require(not estimates or estimator_input.shape == (steps, _STATES), "The estimator's input in every step")
        on_record = recorder is None or (recorder.fine, recorder.steps) == (fine, steps)
        require(on_record, "A recorder of this drive")
        self._prepared = _prepare_car.prepare(
            *(vehicle, states, int(linear), np.empty((CAUSES, NUMBERS)) if effects is None else effects),
            *(int(estimates), np.zeros(ESTIMATOR) if estimator is None else estimator, estimator_input),
            *(height, braking, above_chord, steps, fine, substeps, fine_step, recorder and recorder.prepared),
        )
        self.size, self._steps, self.fine = states + (_STATES if estimates else 0), steps, fine

    def follow_law(
        self,
        loop: FloatArray,
        disturbances: FloatArray,
        source: FloatArray,
        preview_norms: FloatArray,
        force_limits: FloatArray,
        *,
        clips: bool,
    ) -> FollowLaw:
        """Drive it by linear controllers.

        Args:
            loop: [p; previous command] before each step and after the last (steps + 1, size + 2).
            disturbances: What is previewed in each step (3, steps, horizon), perhaps a view of
            source: A C-contiguous array that begins with it.
            preview_norms: Of each step's, as loop.h has them (4, steps).
            force_limits: As `limit_force` has them (3,).
            clips: Whether a force beyond the limit is clipped, or not decided by the controller.

        Returns:
            A controller, what decides the steps in which one of its limits binds (None where C does not), from which
            step on and before which one it is to be driven -> the first step that it does not decide, and in how many
            before it a limit shaped the command.

        Raises:
            ValueError: Sizes disagree.
        """
        self._check(loop)
        steps, horizon = self._steps, disturbances.shape[2]
        kind, step, _ = (stride // disturbances.itemsize for stride in disturbances.strides)
        beyond = (_DISTURBANCES - 1) * kind + (steps - 1) * step + horizon
        fits = min(kind, step) >= 0 and (beyond <= source.size or not horizon)
        fits &= disturbances.shape[:2] == (_DISTURBANCES, steps) and preview_norms.shape == (1 + _DISTURBANCES, steps)
        require(fits, "What is previewed in every step")
        numbers = np.array([kind, step, steps, clips, *force_limits], dtype=np.float64)
        inputs = np.empty(_LAW_INPUTS + _DISTURBANCES * horizon)
        shared = _prepare_run_inputs.prepare(numbers, source, preview_norms, inputs)
        limited = np.zeros(1, dtype=np.intc)
        follow = _follow_law.bind(self._prepared, shared, loop, limited)

        def follow_from(law: LawDesign, qp: Qp | None, first: int, last: int) -> tuple[int, int]:
            require(0 <= first <= last <= self._steps, "No steps beyond the drive")
            require(law.horizon in (0, horizon), "A controller of what is previewed")
            design, memory = qp or (None, None)
            of_qp = memory.both(design, law.inputs) if memory and design else (None, None)
            limited[0] = 0
            driven: int = follow(law.prepared, *of_qp, first, last)
            return driven, int(limited[0])

        return follow_from

    def advance(self, step: int, loop: FloatArray) -> None:
        """Fill in its state after a control step, whose command stands beside it already.

        Args:
            step: Index of the control step.
            loop: As `follow_law` has it.

        Raises:
            ValueError: The step is beyond the drive, or sizes disagree.
        """
        require(0 <= step < self._steps, "No steps beyond the drive")
        self._check(loop)
        _advance(self._prepared, loop, step)

    def measure(self, step: int, state: FloatArray, command: FloatArray) -> FloatArray:
        """half_car.MEASURED_OUTPUTS (4,) at the beginning of a control step, without noise.

        Args:
            step: Index of the control step.
            state: p (size,) then.
            command: Held until then (2,) [N].

        Raises:
            ValueError: The state is another car's, or the step beyond the drive.
        """
        require(len(state) == self.size and 0 <= step < self._steps, "The state of this car in one of its steps")
        measured = np.empty(_MEASURED)
        _measure(self._prepared, step, np.ascontiguousarray(state), np.ascontiguousarray(command), measured)
        return measured

    def sample(self, first: int, last: int, loop: FloatArray) -> FloatArray:
        """Return the samples of the steps from `first` to before `last`, as they were driven (10, steps, fine + 1).

        Args:
            first: Index of a step.
            last: Likewise.
            loop: As `follow_law` has it, after a drive.

        Raises:
            ValueError: The steps are beyond the drive, or sizes disagree.
        """
        require(0 <= first <= last <= self._steps, "No steps beyond the drive")
        self._check(loop)
        each = self.fine + 1
        samples = np.empty((SIGNALS, last - first, each))
        _sample(self._prepared, loop[first:], first, last - first, np.empty((each, SIGNALS)), samples)
        return samples

    def _check(self, loop: FloatArray) -> None:
        require(loop.shape == (self._steps + 1, self.size + _FORCES), "A row before each step and after the last")
