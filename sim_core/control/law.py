"""A linear law of control, which holds while no limit binds."""

from dataclasses import dataclass, field

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.errors import RefusedError
from sim_core.kernel.prepared import LawDesign
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES

LAW_INPUTS = STATES + FORCES  # what a law multiplies: the state, then the previous command


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LinearLaw:
    """u = gain·[state; previous force] + preview_gain·disturbances [N], while no limit binds.

    Attributes:
        gain: On the state (8,), then on the previous force [N] (2, 10).
        preview_gain: On the expected disturbances, all steps of the front road velocity, then of the rear one, then of
            the deceleration (2, 3 · preview_steps); None for nothing.
        limits: Limits beside the greatest force, each a row divided by its limit: the law holds where every row times
            [state; previous force; disturbances] is between -1 and 1 (rows, 10 + 3 · preview_steps); None for none.
        design: All of it, as C has it.

    Example:
        >>> import numpy as np
        >>> from sim_core import LinearLaw
        >>> gain = np.zeros((2, 10))
        >>> gain[:, 4] = -1000.0  # against the body's velocity
        >>> LinearLaw(gain=gain).force(np.array([0, 0, 0, 0, 0.2, 0, 0, 0]), np.zeros(2)).tolist()
        [-200.0, -200.0]
    """

    gain: FloatArray
    preview_gain: FloatArray | None = None
    limits: FloatArray | None = None
    design: LawDesign = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the arrays, which become contiguous copies that nobody can write.

        Raises:
            RidelabError: A shape does not fit, or a number is not finite.
        """
        for name, array, rows, fixed in (
            ("gain", self.gain, FORCES, LAW_INPUTS),
            ("preview_gain", self.preview_gain, FORCES, 0),
            ("limits", self.limits, None, LAW_INPUTS),
        ):
            if array is None:
                continue
            previewed = np.shape(array)[-1] - fixed if np.ndim(array) == 2 else -1
            own = np.array(array, dtype=np.float64, order="C")
            own.flags.writeable = False
            object.__setattr__(self, name, own)
            if previewed < 0 or previewed % DISTURBANCES or rows not in (None, len(array)):
                raise RefusedError(f"A linear law's {name} has the shape {np.shape(array)}")
            if not np.isfinite(own).all():
                raise RefusedError(f"A linear law's {name} has a number that is not finite")
        object.__setattr__(self, "design", self._design())

    def _design(self) -> LawDesign:
        preview_gain, limits = self.preview_gain, self.limits
        if preview_gain is None:
            preview_gain = np.zeros((FORCES, 0 if limits is None else limits.shape[1] - LAW_INPUTS))
        if limits is None:
            limits = np.zeros((0, LAW_INPUTS + preview_gain.shape[1]))
        if limits.shape[1] != LAW_INPUTS + preview_gain.shape[1]:
            raise RefusedError("A linear law's preview_gain and limits have columns for as many control steps")
        return LawDesign(np.hstack([self.gain, preview_gain]), limits)

    def force(
        self, state: FloatArray, previous_force: FloatArray, disturbances: FloatArray | None = None
    ) -> FloatArray:
        """Return the law's forces (2,) [N].

        Args:
            state: (8,).
            previous_force: (2,) [N].
            disturbances: As `Seen.disturbances` (3, preview_steps); a law without `preview_gain` needs none.

        Raises:
            RidelabError: The law has a `preview_gain`, and there are no disturbances.
        """
        force = self.gain[:, :STATES] @ state + self.gain[:, STATES:] @ previous_force
        if self.preview_gain is None:
            return force
        if disturbances is None:
            raise RefusedError("A linear law with a preview_gain needs the disturbances that it multiplies")
        return force + self.preview_gain @ disturbances.ravel()
