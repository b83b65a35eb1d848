"""Ridelab's simulation core: pure numerics, no web.

`simulate(scenario, strategy)` is the whole of it; a scenario comes from `sim_core.scenario` or its presets.
"""

__version__ = "0.4.0"  # part of every stored result's key: raise it whenever a number can change
