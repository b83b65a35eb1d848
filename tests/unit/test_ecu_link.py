"""The connection to the ECU's process: what misbehaving leads to, and that nothing stays."""

import shlex
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest

from backend.ecu import link
from backend.ecu.link import EcuError, connected
from backend.ecu.tables import fingerprint
from benchmarks.firmware import write_sources
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.program import Frame
from sim_core.kernel.build import default_compiler
from sim_core.scenario import Mpc, Scenario
from sim_core.strategies.calibration import ecu_calibration
from tests.servers.process import HANG_TIMEOUT, wait_until

ROOT = Path(__file__).parents[2]
SMALL = Scenario(mpc=Mpc(prediction_horizon=4, control_horizon=2))
PEER = """#!{python}
import os, struct, sys, time
def say(content):
    sys.stdout.buffer.write(content)
    sys.stdout.buffer.flush()
def hello(fingerprint):
    say(b"RIDELAB2" + struct.pack("<I", fingerprint))
def frame():
    return os.read(0, 4096)
def answer(step, flags=0):
    say(struct.pack("<IiiiIfI", step, 0, 0, flags, 0, 0.0, 0))
FINGERPRINT = {fingerprint}
{body}
"""


@pytest.fixture(scope="module")
def calibration() -> Calibration:
    return ecu_calibration(SMALL)


@pytest.fixture(scope="module")
def program(calibration: Calibration, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The exported one, with these tables."""
    folder = tmp_path_factory.mktemp("controller")
    write_sources(folder, calibration)
    subprocess.run(["make", f"CC={shlex.join(default_compiler())}"], cwd=folder, check=True, capture_output=True)
    return folder / "ridelab_ecu"


def frame(calibration: Calibration, step: int = 0, stage: int = 0) -> Frame:
    return Frame(step=step, stage=stage, codes=np.zeros(8 + 3 * calibration.preview_length, dtype=np.int32))


def peer(place: Path, calibration: Calibration, body: str) -> Path:
    """A program of ours that behaves so."""
    path = place / "peer"
    path.write_text(PEER.format(python=sys.executable, fingerprint=fingerprint(calibration), body=body))
    path.chmod(0o755)
    return path


@pytest.fixture(autouse=True)
def nothing_stays(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Whatever happened, no child is left, running or as a zombie."""
    monkeypatch.setattr(link, "END", 0.3)
    before = {child.pid for child in psutil.Process().children()}
    yield
    assert {child.pid for child in psutil.Process().children()} <= before


MISBEHAVIOURS = {
    "ends at once": ("sys.exit(9)", "ended before"),
    "is another program": ("say(b'usage: frobnicate FILE')", "not an ECU's program"),
    "says nothing": ("time.sleep(3600)", "did not answer within"),
    "has other tables": ("hello(FINGERPRINT ^ 1); time.sleep(3600)", "another scenario"),
    "hangs": ("hello(FINGERPRINT); frame(); time.sleep(3600)", "did not answer within"),
    "answers half": ("hello(FINGERPRINT); frame(); say(bytes(9)); sys.exit()", "ended before"),
    "answers another step": ("hello(FINGERPRINT); frame(); answer(5); time.sleep(3600)", "nobody asked"),
    "answers misuse": ("hello(FINGERPRINT); frame(); answer(0, -1); time.sleep(3600)", "nobody asked"),
}


@pytest.mark.parametrize(("body", "reason"), MISBEHAVIOURS.values(), ids=MISBEHAVIOURS.keys())
def test_a_peer_that_misbehaves_is_an_error_and_never_a_wait(
    tmp_path: Path, calibration: Calibration, body: str, reason: str
) -> None:
    program, patience = peer(tmp_path, calibration, body), 1.0 if "answer within" in reason else HANG_TIMEOUT
    with pytest.raises(EcuError, match=reason), connected(calibration, program, patience=patience) as ecu:
        ecu.exchange(frame(calibration))


def test_the_program_ends_with_a_plant_that_was_killed(program: Path) -> None:
    code = (
        "import sys\n"
        "from pathlib import Path\n"
        "from backend.ecu.link import connected\n"
        "from sim_core.scenario import Mpc, Scenario\n"
        "from sim_core.strategies.calibration import ecu_calibration\n"
        "import psutil\n"
        "small = ecu_calibration(Scenario(mpc=Mpc(prediction_horizon=4, control_horizon=2)))\n"
        "with connected(small, Path(sys.argv[1])):\n"
        "    print(psutil.Process().children()[0].pid, flush=True)\n"
        "    sys.stdin.read()\n"
    )
    plant = subprocess.Popen(
        [sys.executable, "-c", code, str(program)], cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert plant.stdout is not None
    pid = int(plant.stdout.readline())
    assert psutil.pid_exists(pid)
    plant.send_signal(signal.SIGKILL)
    plant.communicate()

    def has_ended() -> bool:
        return not psutil.pid_exists(pid) or psutil.Process(pid).status() == psutil.STATUS_ZOMBIE

    wait_until(has_ended, "it ends with its plant")
