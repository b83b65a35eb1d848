"""The one table of units: spellings of each quantity's units, and how one converts into another.

The client and the page read copies of it: `UPDATE_DOCS=1 python -m pytest tests/unit/test_units.py` writes them.
"""

import math
import re
from collections.abc import Mapping

# Quantity -> spelling -> its size in the quantity's SI unit.
UNITS: Mapping[str, Mapping[str, float]] = {
    "ratio": {"1": 1.0, "%": 0.01},
    "length": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3, "in": 0.0254, "ft": 0.3048, "µm": 1e-6},
    "area": {"m^2": 1.0, "mm^2": 1e-6, "cm^2": 1e-4},
    "volume": {"m^3": 1.0, "cm^3": 1e-6},
    "time": {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "min": 60.0},
    "speed": {"m/s": 1.0, "km/h": 1 / 3.6, "mph": 0.44704, "cm/s": 1e-2, "mm/s": 1e-3},
    "acceleration": {"m/s^2": 1.0, "g": 9.80665},
    "mass": {"kg": 1.0, "t": 1e3, "lb": 0.45359237},
    "inertia": {"kg·m^2": 1.0},
    "force": {"N": 1.0, "kN": 1e3},
    "force rate": {"N/s": 1.0, "kN/s": 1e3, "N/ms": 1e3},
    "stiffness": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3},
    "damping": {"N·s/m": 1.0, "kN·s/m": 1e3, "N·s/mm": 1e3},
    "pressure": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "bar": 1e5},
    "power": {"W": 1.0, "kW": 1e3},
    "frequency": {"Hz": 1.0, "kHz": 1e3},
    "angle": {"rad": 1.0, "mrad": 1e-3, "°": math.pi / 180},
    "angular speed": {"rad/s": 1.0, "mrad/s": 1e-3, "°/s": math.pi / 180},
    "angular acceleration": {"rad/s^2": 1.0, "°/s^2": math.pi / 180},
}
# Other spelling -> one of the table.
ALIASES: Mapping[str, str] = {
    "kmh": "km/h",
    "kph": "km/h",
    "deg": "°",
    "deg/s": "°/s",
    "deg/s^2": "°/s^2",
    "um": "µm",
    "inch": "in",
    "inches": "in",
    "foot": "ft",
    "feet": "ft",
    "metre": "m",
    "metres": "m",
    "meter": "m",
    "meters": "m",
    "sec": "s",
    "second": "s",
    "seconds": "s",
}
_DIGITS = 12  # 7 cm are 0.07 m, not 0.07000000000000001
_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻μ", "0123456789-µ")


def factor(written: str, unit: str) -> float:
    """Return how many of `unit` one of a unit is that somebody wrote: 0.01 for `cm` in `m`.

    Raises:
        ValueError: It measures something else; the message names the units there are.
    """
    units = next((units for units in UNITS.values() if unit in units), {unit: 1.0})
    spellings = {_key(alias): name for alias, name in ALIASES.items()} | {_key(name): name for name in units}
    name = spellings.get(_key(written))
    if name is None or name not in units:
        others = " or".join(", ".join(each for each in units if each != "1").rsplit(",", 1))
        raise ValueError(f"{written} is not understood: it takes {others or 'a number without a unit'}")
    return float(f"{units[name] / units[unit]:.{_DIGITS}g}")


def _key(unit: str) -> str:
    """Return the same text for `kg·m²`, `kg*m^2` and `KG m2`."""
    return re.sub(r"[·⋅*^\s]", "", unit.translate(_RAISED)).lower()
