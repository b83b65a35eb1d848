"""A car for tests of what is checked before C gets it."""

from typing import Any

import numpy as np

from sim_core.kernel import prepared


def still_car(steps: int = 6, fine: int = 1, **changed: Any) -> prepared.DrivenCar:
    """A linear car on a level road whose state never changes, but for what is `changed`."""
    effects = np.zeros((prepared.CAUSES, prepared.NUMBERS))
    effects[3:11, :8] = np.eye(8)
    right: dict[str, Any] = {
        "vehicle": np.ones(prepared.CAR),
        "states": 8,
        "effects": effects,
        "steps": steps,
        "fine": fine,
        "estimator": None,
        "estimator_input": np.empty((0, 8)),
        "height": np.zeros((2, steps * fine + 1)),
        "braking": np.zeros(steps * fine),
        "above_chord": None,
        "substeps": 1,
        "fine_step": 1e-3,
        "recorder": None,
    }
    assert changed.keys() <= right.keys(), "a misspelt name would pass for an array that is refused"
    return prepared.DrivenCar(**(right | changed))
