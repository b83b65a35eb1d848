"""The exported sources are complete, the same every time, and what lv_hil drives; what they take on their part."""

import io
import re
import subprocess
import zipfile
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from backend.ecu import build, effort, export, firmware, tables
from backend.ecu.link import connected
from benchmarks.cortex_m3 import CortexM3
from benchmarks.ecu import RecordedDrive
from sim_core import Bump, Hil, Mpc, Road, Scenario, Speed, simulate
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.sources import SOURCES
from sim_core.strategies.calibration import ecu_calibration
from sim_core.strategies.lv_hil import LvHil
from tests.results import event

SMALL = Scenario(
    road=Road(length=40, bump=Bump(start=20, width=3, height=0.09)),
    speed=Speed(initial_speed_kmh=45, target_speed_kmh=30, detection_distance=15),
    mpc=Mpc(prediction_horizon=10, control_horizon=6, force_limit=1500, deflection_limit=0.03),
    hil=Hil(bits=16),
)


@pytest.fixture(scope="module")
def calibration() -> Calibration:
    return ecu_calibration(SMALL)


@pytest.fixture(scope="module")
def image(calibration: Calibration) -> firmware.Image:
    return firmware.image(calibration)


def test_the_zip_builds_with_its_own_makefile_and_drives_bit_for_bit_like_ridelabs_programs(tmp_path: Path) -> None:
    """The one in a process of its own and the one in this process; with limits, and iterations it does not have."""
    rushed = SMALL.model_copy(update={"hil": Hil(bits=16, iterations=3)})
    content = export.archive(rushed)
    assert content == export.archive(rushed)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        archive.extractall(tmp_path)
    folder = tmp_path / export.FOLDER
    compiler = " ".join(build.compilers()[0])
    make = subprocess.run(
        ["make", f"CC={compiler}", "CFLAGS=-std=c99 -O1 -Wall -Wextra -Werror"], cwd=folder, check=False
    )
    assert make.returncode == 0
    assert Scenario.model_validate_json((folder / "scenario.json").read_text()) == rushed
    exported = simulate(rushed, LvHil(connect=partial(connected, program=folder / "ridelab_ecu")))
    for ours in (LvHil(connect=connected), "lv_hil"):
        result = simulate(rushed, ours)
        assert exported.summary() == result.summary()
        assert all(np.array_equal(exported.series[key], result.series[key]) for key in result.series)
    assert event(exported, "limited_steps") > 5
    assert event(exported, "qp_failures") > 0


def test_the_c_code_keeps_the_habits_it_claims() -> None:
    """No library but the compiler's own, no dynamic memory, no double."""
    for name in export.CONTROLLER:
        code = re.sub(r"/\*.*?\*/", "", (SOURCES / name).read_text(), flags=re.DOTALL)
        assert set(re.findall(r"#include <(.*?)>", code)) <= {"stdint.h"}, name
        assert not re.search(r"\b(malloc|free|double|goto|while)\b", code), name
        assert not re.search(r"\d\.\d+(?!\d|f|e)", code), f"{name}: a double constant"


def test_the_image_holds_what_the_tables_take(calibration: Calibration, image: firmware.Image) -> None:
    """Constants are the float32 tables and little else; variables the controller, one input and one output."""
    numbers = sum(stage.rows.size + stage.gram.size for stage in calibration.stages)
    numbers += 11 + 64 + 16 + 24 + calibration.row_count
    assert 0 <= image.sections[".rodata"] - (4 * numbers + calibration.row_count) < 256
    assert image.flash == image.sections[".text"] + image.sections[".rodata"] + image.sections.get(".data", 0)
    columns = 10 + 3 * calibration.intervals
    least = 4 * (columns + calibration.row_count + 9 + 3 * calibration.preview_length + 4)
    assert least < image.ram < least + 4 * (tables.most_active(calibration) + 8) ** 2
    assert len(image.segments[0][1]) == image.sections[".text"]


@pytest.mark.thorough
def test_on_the_parts_processor_it_does_the_same_in_the_cycles_the_report_takes(image: firmware.Image) -> None:
    """The emulated Cortex-M3 gives each command to the bit, and an operation's cycles as `effort` has them."""
    drive, machine = RecordedDrive(SMALL), CortexM3(image)
    machine.call("ridelab_firmware_start")
    busiest = drive.by_operations[-1]
    for k in (0, 1, busiest - 2, busiest - 1, busiest, busiest + 1):
        _, reply, operations = drive.steps[k]
        spent, commands = drive.emulated(machine, k)
        assert commands == reply.commands
        assert abs(spent.cycles / (operations * effort.CYCLES_PER_OPERATION) - 1) <= effort.SPREAD
        assert spent.stack <= effort.STM32F103.stack
        assert spent.instructions < spent.cycles < 2 * spent.instructions
