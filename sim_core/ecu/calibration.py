"""What the ECU's program knows: tables exported from the MPC's designs, one set a driving stage.

The program's work is y = rows · [state; previous command; preview]: the forces and deflections of the horizon as the
unconstrained optimum has them. Where one of them breaks its limit, multipliers of the broken rows correct all of them
through `gram`, which is all a dual method needs of the QP (Goldfarb and Idnani 1983).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.control.cost import KILO
from sim_core.control.mpc_design import MpcDesign
from sim_core.control.qp import AXLES
from sim_core.ecu.channels import PREVIEW, SENSORS, STAGES, highest_code
from sim_core.scenario import Hil
from sim_core.vehicle.half_car import FORCES, STATES, LinearModel

FORCE_ROW = -1  # in place of an axle
MOST_ACTIVE = 44  # limits that may bind together; the program's working memory is made for so many
Checked = Literal["all", "few"]


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class StageTables:
    """One stage: rows (m, 10 + 3 Np) on [state; previous command in kN; preview], gram (m, m)."""

    rows: FloatArray
    gram: FloatArray


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Calibration:
    """All of the program's numbers. Row values are in kN and cm; the first two are the force commands.

    Attributes:
        intervals: Prediction horizon Np.
        moves: Control horizon Nc.
        predicts: Whether the state is predicted for the moment the command takes effect.
        iterations: The solver stops after so many.
        bits: Of the converters.
        input_steps: What one code stands for: 8 states, then the three preview channels (11,).
        command_step: What one code of a command stands for [kN].
        A: Of the car over one control step (8, 8).
        B: The same for forces in kN (8, 2).
        E: The same for disturbances (8, 3).
        bounds: Limit of each row's magnitude (m,) [kN or cm].
        axles: Which slack softens a row: 0 front, 1 rear, FORCE_ROW none (m,).
        slack_price: Linear penalty of a slack [1/cm].
        inverse_slack_weight: Inverse of its quadratic one, 1/H [cm²].
        stages: Tables by stage, in the order of channels.STAGES.
    """

    intervals: int
    moves: int
    predicts: bool
    iterations: int
    bits: int
    input_steps: FloatArray
    command_step: float
    A: FloatArray
    B: FloatArray
    E: FloatArray
    bounds: FloatArray
    axles: tuple[int, ...]
    slack_price: float
    inverse_slack_weight: float
    stages: tuple[StageTables, ...]

    @property
    def arrays(self) -> dict[str, FloatArray]:
        """All tables by their names in exported C: the car's and the limits, then each stage's."""
        shared = {"input_steps": self.input_steps, "a": self.A, "b": self.B, "e": self.E, "bounds": self.bounds}
        for stage, each in zip(STAGES, self.stages, strict=True):
            shared |= {f"{stage}_effects": each.rows, f"{stage}_gram": each.gram}
        return shared

    @property
    def row_count(self) -> int:
        """Rows a stage has."""
        return len(self.bounds)

    @property
    def most_active(self) -> int:
        """Limits that may bind together: one more than there are unknowns, forces and two slacks, never happens."""
        return min(MOST_ACTIVE, FORCES * self.moves + 3)

    @property
    def preview_length(self) -> int:
        """Intervals each frame tells of: one more where the first is spent on predicting."""
        return self.intervals + int(self.predicts)


def calibrate(
    designs: Mapping[str, MpcDesign], model: LinearModel, hil: Hil, force_limit: float, checked: Checked = "all"
) -> Calibration:
    """Export the designs.

    Args:
        designs: By stage.
        model: The car over one control step.
        hil: Converters and solver.
        force_limit: Of each force [N].
        checked: `all` limits of the horizon, or a `few`: the first move's forces and every third deflection.
    """
    first = designs[STAGES[0]].qp
    intervals = (len(first.bounds) - first.moves) // AXLES
    checked_rows = _rows_checked(first.moves, intervals, checked)
    highest = highest_code(hil.bits)
    return Calibration(
        intervals=intervals,
        moves=first.moves // FORCES,
        predicts=hil.compensation == "predict",
        iterations=hil.iterations,
        bits=hil.bits,
        input_steps=np.array([channel.full_scale / highest for channel in (*SENSORS, *PREVIEW)]),
        command_step=force_limit / KILO / highest,
        A=model.A,
        B=model.B * KILO,
        E=model.E,
        bounds=first.bounds[checked_rows],
        axles=tuple(first.axles[checked_rows].tolist()),
        slack_price=first.slack_price,
        inverse_slack_weight=first.inverse_slack_weight,
        stages=tuple(_tables(designs[stage], checked_rows) for stage in STAGES),
    )


def _rows_checked(free: int, intervals: int, checked: Checked) -> NDArray[np.intp]:
    """Return which of the law's checks the program makes; the first two, its commands, always."""
    if checked == "all":
        return np.arange(free + AXLES * intervals, dtype=np.intp)
    some = np.arange(2, intervals, 3)
    return np.concatenate([np.arange(FORCES), free + some, free + intervals + some])


def _tables(design: MpcDesign, checked_rows: NDArray[np.intp]) -> StageTables:
    rows = (design.qp.unconstrained_gain * design.qp.bounds[:, None])[checked_rows]
    rows[:, STATES : STATES + FORCES] *= KILO
    return StageTables(rows=rows, gram=design.qp.gram[np.ix_(checked_rows, checked_rows)])
