"""The reproduction that tests share is computed again whenever something changes that its numbers depend on."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.servers.process import ROOT
from tests.servers.reproduction import SOURCES, digest, files, packages

# All of its parts on one road, and then every file of ours that took part.
COMPUTE = """
import sys
from backend.paper import work
from sim_core.scenario import Scenario
from sim_core.study.paper import STRATEGIES
for name in (*STRATEGIES, "attribution", "speeds"):
    work.compute(f"paper.{name}", Scenario())
print(*(module.__file__ for name, module in sys.modules.items() if name.partition(".")[0] in ("sim_core", "backend")))
"""


def test_every_module_that_takes_part_is_among_the_sources() -> None:
    run = subprocess.run(
        [sys.executable, "-c", COMPUTE], cwd=ROOT, capture_output=True, text=True, check=True, timeout=120
    )
    taking_part = {Path(name) for name in run.stdout.split()}
    assert ROOT / "sim_core/control/mpc.py" in taking_part
    assert taking_part <= set(files(ROOT, SOURCES))


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    for path in files(ROOT, SOURCES):
        target = tmp_path / path.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, target)
    return tmp_path


@pytest.mark.parametrize(
    "name", ["sim_core/control/qp.py", "sim_core/ecu/source/ridelab_dual.c", "backend/paper/work.py"]
)
def test_a_source_that_changes_gives_another_digest(copy: Path, name: str) -> None:
    assert digest(copy) == digest() == digest()
    source = copy / name
    text = source.read_bytes()
    source.write_bytes(text + b"\n")
    assert digest(copy) != digest()
    source.write_bytes(text)
    assert digest(copy) == digest()
    source.rename(source.with_stem("other"))
    assert digest(copy) != digest()


def test_what_python_compiled_does_not_matter_and_a_new_source_does(copy: Path) -> None:
    (copy / "sim_core/__pycache__").mkdir()
    (copy / "sim_core/__pycache__/qp.cpython-311.pyc").touch()
    assert digest(copy) == digest()
    (copy / "sim_core/more.py").touch()
    assert digest(copy) != digest()


def test_every_installed_package_counts_with_its_version(tmp_path: Path) -> None:
    for package in ("numpy", "scipy", "daqp", "osqp", "scikit_fuzzy"):
        assert any(name.startswith(f"{package}-") for name in packages(sys.path)), package
    (tmp_path / "numpy-9.0.0.dist-info").mkdir()
    assert packages([str(tmp_path)]) == ["numpy-9.0.0.dist-info"]
