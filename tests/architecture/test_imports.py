"""What a start imports; who may import whom is in pyproject.toml, which import-linter checks."""

import subprocess
import sys

# Each takes a tenth of a second of a core or more, and belongs to a run, a survey, a search or a cluster.
HEAVY = {"skfuzzy", "scipy.ndimage", "scipy.optimize", "scipy.sparse", "scipy.spatial", "scipy.stats"}
HEAVY |= {"distributed", "optuna", "plotly.basedatatypes"}


def test_the_service_starts_without_what_few_requests_need() -> None:
    code = "import sys, backend.app; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert HEAVY & set(done.stdout.split()) == set()
