"""The exported sources are complete, the same every time, and what lv_hil drives; what they take on their part."""

import io
import re
import subprocess
import zipfile
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from backend.ecu import effort, export
from backend.ecu.link import connected
from benchmarks import firmware
from benchmarks.cortex_m3 import CortexM3
from benchmarks.ecu import RecordedDrive
from sim_core import Bump, Hil, Mpc, Road, Scenario, Speed, simulate
from sim_core.ecu.calibration import Checked
from sim_core.ecu.sources import SOURCES
from sim_core.kernel.build import default_compiler
from sim_core.strategies.calibration import ecu_calibration
from sim_core.strategies.lv_hil import LvHil
from tests.results import event

SMALL = Scenario(
    road=Road(length=40, bump=Bump(start=20, width=3, height=0.09)),
    speed=Speed(initial_speed_kmh=45, target_speed_kmh=30, detection_distance=15),
    mpc=Mpc(prediction_horizon=10, control_horizon=6, force_limit=1500, deflection_limit=0.03),
    hil=Hil(bits=16),
)


def test_the_zip_builds_with_its_own_makefile_and_drives_bit_for_bit_like_ridelabs_program(tmp_path: Path) -> None:
    """With limits, and iterations it does not have."""
    rushed = SMALL.model_copy(update={"hil": Hil(bits=16, iterations=3)})
    content = export.archive(rushed)
    assert content == export.archive(rushed)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        archive.extractall(tmp_path)
    folder = tmp_path / export.FOLDER
    compiler = " ".join(default_compiler())
    make = subprocess.run(
        ["make", f"CC={compiler}", "CFLAGS=-std=c99 -O1 -Wall -Wextra -Werror"], cwd=folder, check=False
    )
    assert make.returncode == 0
    assert Scenario.model_validate_json((folder / "scenario.json").read_text()) == rushed
    exported = simulate(rushed, LvHil(connect=partial(connected, program=folder / "ridelab_ecu")))
    ours = simulate(rushed, "lv_hil")
    assert exported.summary() == ours.summary()
    assert all(np.array_equal(exported.series[key], ours.series[key]) for key in ours.series)
    assert event(exported, "limited_steps") > 5
    assert event(exported, "qp_failures") > 0


def test_the_c_code_keeps_the_habits_it_claims() -> None:
    """No library but the compiler's own, no dynamic memory, no double."""
    for name in export.CONTROLLER:
        code = re.sub(r"/\*.*?\*/", "", (SOURCES / name).read_text(), flags=re.DOTALL)
        assert set(re.findall(r"#include <(.*?)>", code)) <= {"stdint.h"}, name
        assert not re.search(r"\b(malloc|free|double|goto|while)\b", code), name
        assert not re.search(r"\d\.\d+(?!\d|f|e)", code), f"{name}: a double constant"


SIZES: list[tuple[int, int, Checked]] = [(30, 20, "all"), (30, 20, "few"), (10, 6, "all"), (7, 7, "few"), (1, 1, "all")]


@pytest.mark.parametrize(("prediction", "control", "checked"), SIZES)
def test_the_memory_that_the_report_computes_is_that_of_a_real_compilation(
    prediction: int, control: int, checked: Checked
) -> None:
    """To the byte: code, constants and variables of the linked program."""
    mpc = SMALL.mpc.model_copy(update={"prediction_horizon": prediction, "control_horizon": control})
    calibration = ecu_calibration(SMALL.model_copy(update={"mpc": mpc}), checked)
    image, constants = firmware.image(calibration), effort.constants(calibration)
    assert image.sections[".text"] == len(image.segments[0][1]) == effort.CODE
    assert image.sections[".rodata"] == constants
    assert (image.ram, image.flash) == (effort.variables(calibration), effort.CODE + constants)


@pytest.mark.thorough
def test_on_the_parts_processor_it_does_the_same_in_the_cycles_the_report_takes() -> None:
    """The emulated Cortex-M3 gives each command to the bit, and an operation's cycles as `effort` has them."""
    drive = RecordedDrive(SMALL)
    machine = CortexM3(firmware.image(drive.calibration))
    machine.call("ridelab_firmware_start")
    busiest = drive.by_operations[-1]
    for k in (0, 1, busiest - 2, busiest - 1, busiest, busiest + 1):
        _, reply, operations = drive.steps[k]
        spent, commands = drive.emulated(machine, k)
        assert commands == reply.commands
        assert abs(spent.cycles / (operations * effort.CYCLES_PER_OPERATION) - 1) <= effort.SPREAD
        assert spent.stack <= effort.STM32F103.stack
        assert spent.instructions < spent.cycles < 2 * spent.instructions
