"""Integrals and peaks of a record's signals over sections of its drive, by the C of kernel/sections.c."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel import binding


class Integrand(StrEnum):
    """What is integrated of a signal: itself or its square by trapezoids, or the square of a line through samples."""

    VALUE = "value"
    SQUARE = "square"
    SQUARE_OF_LINE = "square_of_line"


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class SectionValues:
    """What `over_sections` finds.

    Attributes:
        integrals: Of each signal over each section, times in fine steps (signals, sections).
        peaks: Largest magnitude of each signal in each section (sections, signals).
        highest: Largest magnitude of each signal under each command (signals, commands).
    """

    integrals: FloatArray
    peaks: FloatArray
    highest: FloatArray


def over_sections(table: FloatArray, integrands: Sequence[Integrand], ends: FloatArray) -> SectionValues:
    """Integrals and peaks of signals; between samples they are straight, from one command to the next they jump.

    Args:
        table: Signals (signals, fine steps of a command + 1, commands).
        integrands: One for each signal.
        ends: First and last place of each section (sections, 2), in fine steps from the table's first sample to its
            last.

    Raises:
        ValueError: A section lies outside the table, or its end before its beginning.
    """
    integrals, peaks = np.empty((len(table), len(ends))), np.empty((len(ends), len(table)))
    highest = binding.sections(table, integrands, ends, integrals, peaks)
    return SectionValues(integrals=integrals, peaks=peaks, highest=highest)
