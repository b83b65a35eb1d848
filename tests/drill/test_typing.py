"""The core's wheel, installed by itself, tells mypy its types."""

import subprocess
import sys
from pathlib import Path

from tests.packaging.environments import Environment, built


def test_a_program_that_uses_the_core_is_type_checked_without_plugins(tmp_path: Path) -> None:
    core = Environment(tmp_path / "core", [built(tmp_path / "wheels")["ridelab-core"]])
    program = """
from sim_core import Bump, Controller, Mpc, Road, Scenario, Seen, option, simulate

class BodyDamper(Controller):
    "Damps the body's vertical motion."
    id, label = "body_damper", "Body damper"
    damping: float = option(2000.0, unit="N s/m", ge=0, le=20_000, help="Force per body velocity.")

    def force(self, seen: Seen) -> tuple[float, float]:
        each = -self.damping * float(seen.state[4]) / 2
        return each, each

scenario = Scenario(road=Road(length=60, bump=Bump(start=30)), mpc=Mpc(force_limit=2000))
peak: float = simulate(scenario, BodyDamper).metrics["bump"]["body_acceleration"]["peak"]
"""
    (tmp_path / "right.py").write_text(program)
    (tmp_path / "star.py").write_text(
        program.replace("Bump, Controller, Mpc, Road, Scenario, Seen, option, simulate", "*")
    )
    (tmp_path / "wrong.py").write_text(f"{program}Scenario(rod=Road())\nsimulate(scenario, 3)\n")
    words = ["-m", "mypy", "--strict", "--config-file=", "--python-executable", core.program("python")]
    check = [sys.executable, *words, "right.py", "star.py", "wrong.py"]
    *errors, last = subprocess.run(check, capture_output=True, text=True, check=False, cwd=tmp_path).stdout.splitlines()
    assert last == "Found 2 errors in 1 file (checked 3 source files)", errors
    assert all(error.startswith("wrong.py:") for error in errors)
    assert 'Unexpected keyword argument "rod" for "Scenario"' in errors[0]
    assert 'Argument 2 to "simulate" has incompatible type "int"' in errors[1]
