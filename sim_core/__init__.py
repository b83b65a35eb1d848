"""Ridelab's simulation core: pure numerics, no web.

`simulate(scenario, strategy)` is the whole of it; a scenario comes from `sim_core.scenario` or its presets.
"""

import ctypes
import os
from contextlib import suppress

# The matrices are small: a second BLAS thread only costs, many times over on a busy machine. Set before NumPy loads
# its BLAS, and only where nobody has chosen.
for _library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

# A run's arrays take some MiB. Where glibc gives them back to the system after each run, the next one fetches them
# page by page, which is a quarter of its time: have it keep them (mallopt(3)). Other C libraries are left alone.
_M_TRIM_THRESHOLD, _M_MMAP_THRESHOLD = -1, -3
with suppress(OSError, AttributeError):
    _mallopt = ctypes.CDLL(None).mallopt
    _mallopt(_M_MMAP_THRESHOLD, 8 * 1024 * 1024)
    _mallopt(_M_TRIM_THRESHOLD, 16 * 1024 * 1024)

__version__ = "0.3.0"  # part of every stored result's key: raise it whenever a number can change
