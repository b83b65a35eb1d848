"""Ridelab's simulation core: pure numerics, no web.

`simulate(scenario, strategy)` is the whole of it. Everything named in `__all__` is public: a `Scenario` and its parts
(all of `sim_core.scenario.__all__`), what a run returns, and what a controller is written and checked with. Ridelab's
own strategies are written with nothing else. Named scenarios are in `sim_core.scenario.presets`.

Example:
    >>> from sim_core import STRATEGIES, Bump, Road, Scenario, simulate
    >>> "lv" in STRATEGIES
    True
    >>> scenario = Scenario(road=Road(bump=Bump(height=0.08)))
    >>> lv, lqr = simulate(scenario, "lv"), simulate(scenario, "lqr")
    >>> lv.comfort["weighted_rms"] < lqr.comfort["weighted_rms"]
    True
"""
# ruff: noqa: F405

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller, Report
from sim_core.control.cost import CostTerms
from sim_core.control.damping import DampingController, axle_velocities
from sim_core.control.declared import option, scenario_field
from sim_core.control.law import LinearLaw
from sim_core.control.mpc import PredictiveController
from sim_core.control.regulator import feedforward, regulator
from sim_core.control.seen import Seen, Setup
from sim_core.controller_files import load_controllers
from sim_core.ecu.controller import EcuController
from sim_core.errors import RidelabError
from sim_core.result import StrategyResult
from sim_core.scenario import *  # noqa: F403 - all that it offers; each stands in __all__ too, where mypy looks
from sim_core.speed.profile import SpeedPlan
from sim_core.vehicle.model import SemiActiveDampers

# isort: split
from sim_core.check_controller import check_controller  # the strategies use what stands above
from sim_core.comparison.caution import Caution
from sim_core.comparison.change import Change
from sim_core.comparison.compare import Comparison, compare
from sim_core.comparison.requirements import Requirement, RequirementResult
from sim_core.comparison.verdict import Verdict
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES
from sim_core.tables.errors import TableError, UnsureTableError
from sim_core.tables.table import Table, read_table

__all__ = [
    "STRATEGIES",
    "Actuator",
    "Brake",
    "Bump",
    "Caution",
    "Change",
    "Characteristics",
    "Comparison",
    "Controller",
    "CostTerms",
    "DampingController",
    "EcuController",
    "Estimation",
    "FloatArray",
    "Fuzzy",
    "Hil",
    "Hook",
    "LinearLaw",
    "Lqr",
    "Mismatch",
    "Mpc",
    "PredictiveController",
    "Preview",
    "Report",
    "Requirement",
    "RequirementResult",
    "RidelabError",
    "Road",
    "RoadWeights",
    "Scenario",
    "Seen",
    "SemiActiveDampers",
    "Setup",
    "Speed",
    "SpeedPlan",
    "StageWeights",
    "StrategyResult",
    "Table",
    "TableError",
    "UnsureTableError",
    "Vehicle",
    "Verdict",
    "Weights",
    "axle_velocities",
    "characteristics",
    "check_controller",
    "compare",
    "feedforward",
    "load_controllers",
    "option",
    "read_table",
    "regulator",
    "scenario_field",
    "simulate",
]
__version__ = "0.5.0"  # part of every stored result's key: raise it where a golden number changes beyond rounding
