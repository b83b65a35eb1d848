"""The numbers of this version: whoever changes one raises `sim_core.__version__`, or stored results would be wrong.

GOLDEN=write writes them for a new version, or those of a new strategy, scenario or metric; a number that is the same
beyond rounding stays as it was written.
"""

import json
import os
from pathlib import Path
from typing import Any

import numpy as np

import sim_core
from sim_core import STRATEGIES, Actuator, Bump, Estimation, Hil, Mismatch, Mpc, Road, Scenario, Vehicle
from tests.results import SAME, metrics, moved_only

FILE = Path(__file__).with_name("golden.json")
ROOT = Path(__file__).parents[2]
SHORT = Road(length=60, bump=Bump(start=40))
SCENARIOS = {
    "paper": Scenario(),
    "nonlinear": Scenario(
        road=SHORT,
        vehicle=Vehicle(rebound_ratio=2.0, bump_stop_clearance=0.05, tyre_lift_off=True),
        estimation=Estimation(kind="kalman"),
    ),
    "limits": Scenario(
        road=SHORT,
        mpc=Mpc(force_limit=1200, deflection_limit=0.04, prediction_horizon=12, control_horizon=5),
        actuator=Actuator(bandwidth=8.0, rate_limit=40_000.0, saturation=900.0),
        mismatch=Mismatch(springs=0.9, preview_noise=0.002),
        hil=Hil(noise=0.002, jitter=0.004, packet_loss=0.05),
    ),
}


def numbers(scenario: Scenario, strategy: str) -> dict[str, float]:
    """Every metric, comfort figure and event that is a number, by dotted name."""
    result = sim_core.simulate(scenario, strategy)
    values: dict[str, Any] = metrics(result) | {f"events.{key}": value for key, value in result.events.items()}
    return {key: float(value) for key, value in values.items() if value is not None}


def test_no_number_changes_without_the_version() -> None:
    now = {
        f"{name}/{strategy}": numbers(scenario, strategy)
        for name, scenario in SCENARIOS.items()
        for strategy in STRATEGIES
    }
    stored: dict[str, Any] = json.loads(FILE.read_text()) if FILE.exists() else {"version": "", "numbers": {}}
    differing = [
        (run, key)
        for run, values in now.items()
        for key, value in values.items()
        if not np.isclose(stored["numbers"].get(run, {}).get(key, np.nan), value, rtol=SAME, atol=1e-12)
    ]
    metrics_before = {key for values in stored["numbers"].values() for key in values}
    added = bool(differing) and all(run not in stored["numbers"] or key not in metrics_before for run, key in differing)
    if os.environ.get("GOLDEN") == "write" and (stored["version"] != sim_core.__version__ or added):
        written = {"version": sim_core.__version__, "numbers": moved_only(stored["numbers"], now)}
        FILE.write_text(json.dumps(written, indent=0, sort_keys=True) + "\n")
        return
    assert stored["version"] == sim_core.__version__, "a new version: GOLDEN=write writes its numbers"
    assert not differing, "numbers are new, or changed: then raise sim_core.__version__; GOLDEN=write writes them"
