"""The one table of units, units.json: spellings of each quantity's units, and how one converts into another.

The client and the page have copies of it: `UPDATE_DOCS=1 python -m pytest tests/unit/test_units.py` writes them.
"""

import json
import re
from collections.abc import Mapping
from pathlib import Path

_TABLE = json.loads(Path(__file__).with_suffix(".json").read_text(encoding="utf-8"))
UNITS: Mapping[str, Mapping[str, float]] = _TABLE["units"]  # quantity -> spelling -> its size in the SI unit
ALIASES: Mapping[str, str] = _TABLE["aliases"]  # other spelling -> one of the table
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
