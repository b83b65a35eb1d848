"""Speed as ratios, measured in one run on one machine: `python -m benchmarks`, or `make bench`."""

import sim_core as sim_core  # first: it limits the BLAS to one thread, before any benchmark loads NumPy
