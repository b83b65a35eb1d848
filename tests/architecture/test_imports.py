"""Who may import whom."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]

# Everything pyproject.toml names that the core has no business with.
WEB = (
    "fastapi",
    "starlette",
    "uvicorn",
    "sqlalchemy",
    "alembic",
    "plotly",
    "orjson",
    "pebble",
    "pyarrow",
    "distributed",
)

WITHOUT_WEB = """
import importlib.abc, importlib.util, pkgutil, sys

class Absent(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {blocked!r}:
            raise ModuleNotFoundError(name + " is not installed", name=name)

sys.meta_path.insert(0, Absent())
try:
    import fastapi
except ModuleNotFoundError:
    pass
else:
    raise SystemExit("the block does not block")

import sim_core
for module in pkgutil.walk_packages(sim_core.__path__, "sim_core."):
    if not module.name.endswith("__main__"):
        importlib.import_module(module.name)
from sim_core.scenario.presets import preset
from sim_core.simulate import simulate
print(simulate(preset("paper"), "lv").travel_time)
"""


def test_core_runs_with_no_web_package_installed() -> None:
    blocked = (*WEB, "backend")
    run = subprocess.run(
        [sys.executable, "-c", WITHOUT_WEB.format(blocked=blocked)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert float(run.stdout) > 0
