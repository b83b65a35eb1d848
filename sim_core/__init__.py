"""Ridelab's simulation core: pure numerics, no web.

`simulate(scenario, strategy)` is the whole of it; a scenario comes from `sim_core.scenario` or its presets.
"""

import os

# The matrices are small: a second BLAS thread only costs, many times over on a busy machine. Set before NumPy loads
# its BLAS, and only where nobody has chosen.
for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

__version__ = "0.3.0"  # part of every stored result's key: raise it whenever a number can change
