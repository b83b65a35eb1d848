"""Ridelab's simulation core: pure numerics, no web.

`simulate(scenario, strategy)` is the whole of it; a scenario comes from `sim_core.scenario` or its presets. Everything
here named in `__all__` is public, and all that Ridelab's own strategies are written with.

Example:
    >>> from sim_core import STRATEGIES, Scenario, simulate
    >>> "lv" in STRATEGIES
    True
    >>> lv, lqr = simulate(Scenario(), "lv"), simulate(Scenario(), "lqr")
    >>> lv.comfort["weighted_rms"] < lqr.comfort["weighted_rms"]
    True
"""

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller, Report, option, scenario_field
from sim_core.control.cost import CostTerms
from sim_core.control.damping import DampingController, axle_velocities
from sim_core.control.mpc import PredictiveController
from sim_core.control.regulator import feedforward, regulator
from sim_core.control.seen import Seen, Setup
from sim_core.ecu.controller import EcuController
from sim_core.errors import RidelabError
from sim_core.result import StrategyResult
from sim_core.scenario import Preview, Scenario, Weights
from sim_core.speed.profile import SpeedPlan
from sim_core.vehicle.model import LinearLaw, SemiActiveDampers

# isort: split
from sim_core.check_controller import check_controller  # the strategies use what stands above
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES

__all__ = [
    "STRATEGIES",
    "Controller",
    "CostTerms",
    "DampingController",
    "EcuController",
    "FloatArray",
    "LinearLaw",
    "PredictiveController",
    "Preview",
    "Report",
    "RidelabError",
    "Scenario",
    "Seen",
    "SemiActiveDampers",
    "Setup",
    "SpeedPlan",
    "StrategyResult",
    "Weights",
    "axle_velocities",
    "check_controller",
    "feedforward",
    "option",
    "regulator",
    "scenario_field",
    "simulate",
]
__version__ = "0.4.0"  # part of every stored result's key: raise it whenever a number can change
