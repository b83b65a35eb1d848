"""The passive car, at constant speed or with the speed controller alone."""

from typing import ClassVar

import numpy as np

from sim_core import Controller, LinearLaw, SpeedPlan

NO_FORCE = LinearLaw(gain=np.zeros((2, 10)))


class Passive(Controller):
    """No control: passive suspension at constant speed."""

    id = "passive"
    label = "Passive"
    speed_plan: ClassVar[SpeedPlan] = "constant"
    actuated = False

    def linear_law(self, stage: str) -> LinearLaw:
        """No force, ever."""
        return NO_FORCE


class SpeedOnly(Passive):
    """Fuzzy speed control, passive suspension."""

    id = "speed_only"
    label = "Single speed control"
    speed_plan = "planned"
