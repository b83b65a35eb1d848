"""Settings all tests share."""

import gc
import os
import shutil
import signal
import tempfile
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, settings
from xdist.scheduler import LoadFileScheduling

pytest_plugins = ["tests.servers.fixtures", "tests.browser.fixtures"]

# What is imported and collected stays: to look for garbage in it, then and in every test, takes a third of collecting.
gc.disable()

# One core is enough for 8 states, and threads only make timings and other test processes worse.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

# In memory a commit waits for no disk, and a database is copied and gone at once: half the time of what stores things.
MEMORY, ROOM = "/dev/shm", 4e9  # noqa: S108 - what tests leave behind is a tenth of it [bytes]
if os.path.ismount(MEMORY) and not os.statvfs(MEMORY).f_flag & os.ST_NOEXEC and shutil.disk_usage(MEMORY).free > ROOM:
    os.environ.setdefault("TMPDIR", MEMORY)
    tempfile.tempdir = None  # asked for again

# No test writes where a person's data are.
_data = tempfile.TemporaryDirectory()
os.environ["XDG_DATA_HOME"] = _data.name

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


# The browser keeps a core busy, so one process has all its tests while another one has those that mostly wait (the
# manual's commands too), and then those of the API, which share a service; the short files come last, so that both end
# together.
FIRST = ("browser", "faults", "cluster", "packaging", "manual", "api", "architecture", "validation")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    scheduling = LoadFileScheduling(config, log)
    whole = ("tests/browser/", "tests/api/")
    scheduling._split_scope = lambda nodeid: nodeid.split("/test_" if nodeid.startswith(whole) else "::")[0]
    return scheduling


THOROUGH = "THOROUGH" in os.environ  # as `make drill` sets it


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if not THOROUGH:
        thorough = [item for item in items if item.get_closest_marker("thorough")]
        config.hook.pytest_deselected(items=thorough)
        items[:] = [item for item in items if not item.get_closest_marker("thorough")]

    def place(item: pytest.Item) -> int:
        folder = item.path.parent.name
        return FIRST.index(folder) if folder in FIRST else len(FIRST)

    items.sort(key=place)


def pytest_collection_finish() -> None:
    gc.freeze()
    gc.enable()
