"""Settings all tests share."""

import os

import pytest
from hypothesis import HealthCheck, Phase, settings

pytest_plugins = ["tests.servers.fixtures"]

# One core is enough for 8 states, and threads only make timings and other test processes worse.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

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


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Who runs with whom where tests run on several processes: each file together, but the paper's files share runs."""
    for item in items:
        together = "api/test_paper" if "/api/test_paper" in item.path.as_posix() else item.path.as_posix()
        item.add_marker(pytest.mark.xdist_group(together))
