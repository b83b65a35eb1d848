"""What a start imports; who may import whom is in pyproject.toml, which import-linter checks."""

import subprocess
import sys
from pathlib import Path

# Each takes a tenth of a second of a core or more, and belongs to a run, a survey, a search or a cluster.
HEAVY = {"skfuzzy", "scipy.ndimage", "scipy.optimize", "scipy.sparse", "scipy.spatial", "scipy.stats"}
HEAVY |= {"distributed", "optuna", "plotly"}


def test_the_service_starts_without_what_few_requests_need() -> None:
    code = "import sys, backend.app; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert HEAVY & set(done.stdout.split()) == set()


def test_a_first_run_imports_numpy_and_no_scipy_web_or_solver_it_does_not_use() -> None:
    code = "import sys; from sim_core import Scenario, simulate; simulate(Scenario(), 'lv'); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert {"scipy", "skfuzzy", "osqp", "fastapi", "sqlalchemy", "backend"} & set(done.stdout.split()) == set()


def test_the_core_is_tested_without_the_service() -> None:
    """What tests/validation knows of the core has to stand without backend/."""
    files = sorted((Path(__file__).parents[1] / "validation").rglob("*.py"))
    assert len(files) > 20
    lines = [(path.name, line) for path in files for line in path.read_text().splitlines()]
    assert [each for each in lines if each[1].lstrip().startswith(("from backend", "import backend"))] == []
