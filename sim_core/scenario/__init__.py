"""The scenario: parts and fields, presets, dotted names, and how an older version's scenario is read."""

from sim_core.scenario.characteristics import Characteristics, characteristics
from sim_core.scenario.fields import Weights
from sim_core.scenario.fuzzy import Fuzzy
from sim_core.scenario.imperfections import Actuator, Estimation, Hil, Mismatch
from sim_core.scenario.parts import SCHEMA_VERSION as SCHEMA_VERSION  # for who stores scenarios
from sim_core.scenario.parts import (
    Brake,
    Hook,
    Lqr,
    Mpc,
    Preview,
    RoadWeights,
    Scenario,
    Speed,
    StageWeights,
)
from sim_core.scenario.road import Bump, Road
from sim_core.scenario.vehicle import Vehicle

__all__ = [
    "Actuator",
    "Brake",
    "Bump",
    "Characteristics",
    "Estimation",
    "Fuzzy",
    "Hil",
    "Hook",
    "Lqr",
    "Mismatch",
    "Mpc",
    "Preview",
    "Road",
    "RoadWeights",
    "Scenario",
    "Speed",
    "StageWeights",
    "Vehicle",
    "Weights",
    "characteristics",
]
