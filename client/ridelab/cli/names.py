"""A service's fields, strategies, presets and signals by name.

The shell completes those that the last service had which has other ones than names.json, this version's.
"""

import contextlib
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from ridelab.client import Ridelab
from ridelab.fields import Limits, limits_of, units_of
from ridelab.files import save

OURS = Path(__file__).with_name("names.json")


@dataclass(frozen=True, slots=True, kw_only=True)
class Names:
    """The names a service accepts."""

    fields: Mapping[str, str]  # unit by dotted name, in the scenario's order
    limits: Mapping[str, Limits]  # by dotted name
    strategies: Mapping[str, str]  # label by id
    presets: Mapping[str, dict[str, Any]]  # complete scenario by id; the paper's first, for fields that are left out
    signals: Mapping[str, tuple[str, str]]  # label and unit by key
    windows: Mapping[str, str]  # label by key
    paper_signals: list[str]  # keys of the signals that the paper compares
    metrics: Mapping[str, str]  # unit by flat name

    @classmethod
    def of(cls, ridelab: Ridelab) -> Self:
        """The names of a service, saved for the shell's completion; vehicles are this version's."""
        schema, catalogue = ridelab.get("/schema"), ridelab.get("/catalogue")
        names = cls(
            fields=units_of(schema),
            limits=limits_of(schema),
            strategies={each["id"]: each["label"] for each in ridelab.get("/strategies")},
            presets={each["id"]: each["scenario"] for each in ridelab.get("/presets")},
            signals={each["key"]: (each["label"], each["unit"]) for each in catalogue["signals"]},
            windows={each["key"]: each["label"] for each in catalogue["windows"]},
            paper_signals=catalogue["paper_signals"],
            metrics=ridelab.units,
        )
        before = remembered()
        listed = {key: list(getattr(names, key)) for key in ("fields", "strategies", "presets", "metrics")}
        if {**before, **listed} != before:
            with contextlib.suppress(OSError):  # completion is a convenience
                _remembered_in().parent.mkdir(parents=True, exist_ok=True)
                save([json.dumps(listed).encode()], _remembered_in())
        return names

    def label(self, strategy: str) -> str:
        """Return a strategy's label; its id where the service does not know it."""
        if strategy.startswith("recording:"):
            return f"Recording {strategy[10:16]}"
        return self.strategies.get(strategy, strategy)

    def signal(self, key: str) -> str:
        """A signal's label and unit, as a column's head."""
        return "{} [{}]".format(*self.signals[key])


def remembered() -> dict[str, list[str]]:
    """The names in the last answer of a service; this version's where none was asked, or it had the same."""
    ours: dict[str, list[str]] = json.loads(OURS.read_bytes())
    try:
        names: dict[str, list[str]] = json.loads(_remembered_in().read_bytes())
    except (OSError, ValueError):
        names = ours
    return {**ours, **names}


def _remembered_in() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "ridelab" / "names.json"
