"""Integrals and peaks of a record's signals over sections of its drive, by the C of kernel/sections.c."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.kernel.library import ADDRESS, INT, address, function

_sections = function("sections", ADDRESS, INT, ADDRESS, INT, INT, ADDRESS, INT, ADDRESS, ADDRESS, ADDRESS, ADDRESS)


class Integrand(IntEnum):
    """What is integrated of a signal: itself or its square by trapezoids, or the square of a line through samples."""

    VALUE = 0
    SQUARE = 1
    SQUARE_OF_LINE = 2


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
    signals, samples, commands = table.shape
    fine, sections = samples - 1, len(ends)
    if len(integrands) != signals or not ((ends[:, 0] >= 0) & (ends[:, 0] <= ends[:, 1])).all():
        raise ValueError("Every signal needs an integrand, and a section ends behind its beginning")
    if ends.max() > fine * commands:
        raise ValueError("A section ends within the record")
    integrals, peaks = np.empty((signals, sections)), np.empty((sections, signals))
    work, highest = np.empty(commands), np.empty((signals, commands))
    kinds = np.array(integrands, dtype=np.intc)
    _sections(
        *(address(table), signals, address(kinds), fine, commands, address(ends), sections),
        *(address(integrals), address(peaks), address(work), address(highest)),
    )
    return SectionValues(integrals=integrals, peaks=peaks, highest=highest)
