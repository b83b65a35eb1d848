"""What a start imports; who may import whom is in pyproject.toml, which import-linter checks."""

import subprocess
import sys

import pytest

# Each takes a tenth of a second of a core or more, and belongs to a run, a survey, a search or a cluster.
HEAVY = {"skfuzzy", "scipy.ndimage", "scipy.optimize", "scipy.sparse", "scipy.spatial", "scipy.stats"}
HEAVY |= {"distributed", "optuna", "plotly"}


@pytest.mark.parametrize(
    ("code", "not_imported"),
    [
        ("import backend.app", HEAVY),
        (
            "from sim_core import Scenario, simulate; simulate(Scenario(), 'lv')",
            {"scipy", "skfuzzy", "osqp", "fastapi", "sqlalchemy", "backend"},
        ),
    ],
    ids=["service", "run"],
)
def test_a_start_imports_nothing_that_few_requests_or_runs_need(code: str, not_imported: set[str]) -> None:
    command = [sys.executable, "-c", f"import sys; {code}; print(*sys.modules)"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert not_imported & set(done.stdout.split()) == set()
