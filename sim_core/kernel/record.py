"""What is measured of a run while it is driven (kernel/record.c)."""

from itertools import pairwise
from math import isfinite

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.library import INT, Array, CStruct, Function, require, size_of, text_of

LAYOUT, WEIGHTING, _RECORD, _TOTALS = map(size_of, ("layout", "weighting", "record_numbers", "totals"))
SIGNALS, _METRICS = size_of("sample"), size_of("metrics")  # numbers of a sample; those with a metric
_TOTAL_NAMES = text_of("total_names").split()
_LINE, _TABLE, _TABLE_OUT = Array(ndim=1), Array(ndim=2), Array(ndim=2, written=True)
_prepare_recorder = Function(
    "prepare_recorder",
    *(Array(_RECORD), _TABLE, _LINE, _TABLE_OUT, _TABLE_OUT, Array(_TOTALS, written=True), Array(WEIGHTING)),
    *(_TABLE_OUT, Array(ndim=1, written=True), _LINE, INT, Array(LAYOUT), _TABLE, _TABLE, _LINE),
)
_record = Function("record", CStruct, INT)


class Recorder:
    """Integrals and peaks of a run's signals in sections of its drive, and what its comfort and events need.

    Times and places are in fine steps from the first sample on record; signals are the last eight of a sample, as
    record.h has them.

    Args:
        fine: Fine steps in a step of the car.
        first: Its first step on record.
        ends: First and last place of each section (sections, 2), ascending; together they are the whole record.
        max_chord_deviation: How far the road leaves a chord in each section at most (sections,) [m].
        weighted_samples: Samples of which the acceleration is weighted.
        weighting: `struct weighting` of record.c (24,).
        tyres: Of both axles their stiffness [N/m], lowest load and that at which they are in the air [N] (3, 2).
        clearance: From rest to the bump stops of both axles, in compression, then in rebound (2, 2) [m]; infinite
            without any.
        road: Samples of its roughness (m,) [m] and layout (9,).
        position: Of both axles at every fine instant of the drive (2, n) [m].
        height: Of the road there [m].
        kinks: Of the bumps, ascending to infinity [m].

    Attributes:
        ends: As above.
        integrals: Of the signals' squares over each section (sections, 8).
        peaks: Their largest magnitude in each, the tyre loads' at kinks of the road too (sections, 8).
        samples: Of the step that is being driven (fine + 1, 10).

    Raises:
        ValueError: Sizes disagree.
    """

    def __init__(
        self,
        *,
        fine: int,
        first: int,
        ends: FloatArray,
        max_chord_deviation: FloatArray,
        weighted_samples: int,
        weighting: FloatArray,
        tyres: FloatArray,
        clearance: FloatArray,
        road: tuple[FloatArray, FloatArray],
        position: FloatArray,
        height: FloatArray,
        kinks: FloatArray,
    ) -> None:
        instants, sections = position.shape[1], len(ends)
        samples, layout = road
        require(fine > 0 and len(samples) > 1, "A fine step or more, and two samples of the road at least")
        self.fine, self.first, self.steps = fine, first, (instants - 1) // fine
        require(position.shape == height.shape == (2, instants) and instants > 1, "Two axles on a road")
        outermost = position[0, 0], position[0, -1], position[1, 0], position[1, -1]
        require(all(map(isfinite, outermost)) and kinks[-1] == np.inf, "An axle is somewhere, no kink last")
        two_axles = tyres.shape == (3, 2) and clearance.shape == (2, 2)
        require(two_axles, "Two tyres, and two suspensions with stops either way")
        require(0 <= first < self.steps, "A record within the drive")
        of_sections = ends.shape == (sections, 2) and len(max_chord_deviation) == sections > 0
        require(of_sections, "Every section has two ends and a deviation")
        on_record = fine * (self.steps - first)
        places = [0, *ends.ravel().tolist(), on_record]
        require(all(a <= b for a, b in pairwise(places)), "Sections ascend within the record")
        require(weighted_samples <= on_record + 1, "No sample beyond the record is weighted")
        self.ends = ends
        self.integrals, self.peaks = np.zeros((sections, _METRICS)), np.zeros((sections, _METRICS))
        self._totals = np.zeros(_TOTALS)
        self.samples = np.empty((fine + 1, SIGNALS))
        numbers = np.array([fine, first, sections, weighted_samples, instants, *tyres.flat, *clearance.flat], float)
        measured = self.integrals, self.peaks, self._totals, weighting, self.samples, np.empty(fine + 1)
        on_road = samples, len(samples), layout, position, height, kinks
        self.prepared = _prepare_recorder.prepare(numbers, ends, max_chord_deviation, *measured, *on_road)

    def record(self, step: int) -> None:
        """Measure a step of the car whose samples are in `samples`.

        Raises:
            ValueError: It is not on record.
        """
        require(self.first <= step < self.steps, "A step on record")
        _record(self.prepared, step)

    @property
    def totals(self) -> dict[str, float]:
        """What was summed beside integrals and peaks, by the names that record.c and `Sums` have for it."""
        return dict(zip(_TOTAL_NAMES, self._totals.tolist(), strict=False))
