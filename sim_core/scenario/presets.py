"""Named scenarios, which presets.toml has; the paper's first."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from sim_core.errors import UnknownNameError
from sim_core.scenario import Scenario


@dataclass(frozen=True, slots=True, kw_only=True)
class Preset:
    """A scenario with a name and a sentence on what it is."""

    id: str
    label: str
    description: str
    scenario: Scenario


def _presets() -> dict[str, Preset]:
    data = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    return {
        name: Preset(
            id=name,
            label=entry["label"],
            description=entry["description"],
            scenario=Scenario.model_validate(entry.get("scenario", {})),
        )
        for name, entry in data.items()
    }


PRESETS = _presets()


def preset(name: str) -> Scenario:
    """Return the scenario of that name.

    Raises:
        UnknownNameError: There is none; the message lists the names.
    """
    try:
        return PRESETS[name].scenario
    except KeyError:
        raise UnknownNameError(f"Unknown preset; there are {', '.join(PRESETS)}") from None
