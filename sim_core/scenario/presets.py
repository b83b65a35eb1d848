"""Named scenarios, which presets.toml has; the paper's first."""

import tomllib
from pathlib import Path

from pydantic import BaseModel

from sim_core.errors import UnknownNameError
from sim_core.scenario import Scenario


class Preset(BaseModel, frozen=True):
    """A scenario with a name and a sentence on what it is."""

    id: str
    label: str
    description: str
    scenario: Scenario = Scenario()


_TABLE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
PRESETS = {name: Preset(id=name, **entry) for name, entry in _TABLE.items()}


def preset(name: str) -> Scenario:
    """Return the scenario of that name.

    Raises:
        UnknownNameError: There is none; the message lists the names.
    """
    try:
        return PRESETS[name].scenario
    except KeyError:
        raise UnknownNameError(f"Unknown preset; there are {', '.join(PRESETS)}") from None
