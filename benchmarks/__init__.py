"""Speed as ratios, measured in one run on one machine: `python -m benchmarks`, or `make bench`."""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")  # before NumPy loads: one core for both sides of every ratio
