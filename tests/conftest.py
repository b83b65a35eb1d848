"""Settings all tests share."""

import os
import signal

from hypothesis import HealthCheck, Phase, settings

pytest_plugins = ["tests.servers.fixtures", "tests.browser.fixtures"]

# One core is enough for 8 states, and threads only make timings and other test processes worse.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

# Tests start some hundred processes: what one compiles the others need not.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

# A shell that starts this in the background has SIGINT ignored, and what tests start would inherit that.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# Same examples on every machine and no deadline: a failure is the code's, never the machine's. Nothing is shrunk:
# that takes minutes where an example is a whole run.
settings.register_profile(
    "fixed",
    derandomize=True,
    deadline=None,
    print_blob=True,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=[HealthCheck.too_slow],
)
# To search new examples and shrink what fails: HYPOTHESIS_PROFILE=search python -m pytest tests/validation
settings.register_profile("search", parent=settings.get_profile("fixed"), derandomize=False, phases=list(Phase))
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))
