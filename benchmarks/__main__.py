"""Print every figure: the core's, then the service's."""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")  # before numpy loads: one core for both sides of every ratio

from benchmarks import api_latency, batches, core, first_view  # noqa: E402 - after the thread limits above

if __name__ == "__main__":
    core.run()
    api_latency.run()
    first_view.run()
    batches.run()
