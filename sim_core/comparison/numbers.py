"""Write numbers, units and percentages as a person reads them."""

from math import floor, isfinite, log10
from typing import Any

NO_VALUE = "–"
ZERO_TOLERANCE = 1e-9  # far below what any unit a result is shown in resolves: what rounding leaves of a zero
LEAST_SHOWN_CHANGE = 0.05  # smaller changes would print as zero [%]
_RAISED = str.maketrans("0123456789-−.", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻·")
_THIN, _NARROW = "\u2009", "\u202f"


def pretty_unit(unit: str) -> str:
    """Return a unit as it is written: `kg·m²` for `kg·m^2`; that of a plain number, `1`, is empty."""
    if unit == "1":
        return ""
    head, *powers = unit.split("^")
    for power in powers:
        digits = len(power) - len(power.lstrip("-0123456789."))
        head += power[:digits].translate(_RAISED) + power[digits:]
    return head


def significant(value: float, digits: int = 3) -> str:
    """Return so many significant digits, without an exponent while that stays readable."""
    if not isfinite(value):
        return NO_VALUE
    if abs(value) < ZERO_TOLERANCE:
        return "0"
    size = floor(log10(abs(float(f"{value:.{digits - 1}e}"))))
    if not -4 <= size <= 7:
        return _power(value, f"{digits}")
    return _typeset(f"{value:{',' if size >= 4 else ''}.{max(0, digits - 1 - size)}f}")


def exact(value: float) -> str:
    """Return every digit a value has, up to ten."""
    if value == 0:
        return "0"
    if not 1e-4 <= abs(value) < 1e9:
        return _power(value, "10")
    return _typeset(f"{value:{',' if abs(value) >= 10_000 and value == int(value) else ''}.10g}")


def with_unit(text: str, unit: str) -> str:
    """Return a number and its unit, which stay on one line."""
    shown = pretty_unit(unit)
    return f"{text}\u00a0{shown}" if shown else text


def percent(change: float, half: float = 0.0) -> str:
    """Return `−43.7 %`: with a sign unless it is 0, a decimal below 100 %; with half an interval `−44 ± 2 %`."""
    if not isfinite(change):
        return NO_VALUE
    size, sign = abs(change), "−" if change < 0 else "+"
    decimals = 1 if size < 99.95 and half < 0.95 else 0
    digits, uncertainty = f"{min(size, 9999):.{decimals}f}", f"{half:.{decimals}f}"
    beyond = "" if size < 9999.5 else "< " if change < 0 else "> "
    interval = f" ± {uncertainty}" if float(uncertainty) else ""
    return f"{beyond}{sign if float(digits) else ''}{digits}{interval}{_THIN}%"


def printed(change: float) -> str:
    """Return a change as the paper prints it, with all of its digits."""
    sign = "−" if change < 0 else "+"
    return f"{sign}{abs(change):g}{_THIN}%"


def plus_minus(shown: str, half: float) -> str:
    """Return a shown result with half its interval's width: as many decimals, more only where it would be 0."""
    text = f"{half:.{len(shown.partition('.')[2])}f}"
    return f"{shown} ± {significant(half, 1) if float(text) == 0 or '×' in shown else text}"


def in_words(value: Any) -> str:
    """Return a metric as text: yes, no, a count with every digit, or three digits of a measure."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, int | float):
        return NO_VALUE
    if float(value).is_integer() and abs(value) < 1e15:
        return _typeset(f"{int(value):{',' if abs(value) >= 10_000 else ''}}")
    return significant(value)


def amount(value: float, unit: str) -> str:
    """Return an amount within a sentence: two digits below ten, whole from there on."""
    return with_unit(exact(float(f"{value:.2g}")) if value < 10 else exact(float(round(value))), unit)


def _power(value: float, digits: str) -> str:
    mantissa, _, exponent = f"{value:.{int(digits) - 1}e}".partition("e")
    short = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return _typeset(f"{short}×10{str(int(exponent)).translate(_RAISED)}")


def _typeset(text: str) -> str:
    """Return a number with real minus signs, which are as wide as a plus, and narrow spaces between thousands."""
    return text.replace("-", "−").replace(",", _NARROW)
