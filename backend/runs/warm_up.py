"""Importing this warms a process up: the first request finds filled caches.

Workers that are forked from such a process share its memory, as far as they leave it unchanged.
"""

import gc

from backend.runs.compute_run import compute
from sim_core import STRATEGIES, Scenario

for _strategy in STRATEGIES:
    compute(Scenario(), _strategy, "")
gc.collect()
gc.freeze()  # nothing of it is looked at again, which would copy it
