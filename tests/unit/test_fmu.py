"""FMUs that leave Ridelab: FMPy validates and runs them, and they give what our own runs give."""

import io
import random
import re
import struct
import subprocess
import zipfile
import zlib
from collections.abc import Callable
from contextlib import suppress
from copy import copy
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu

from backend.fmu import programs
from backend.fmu.archive import fmu
from backend.fmu.description import Version
from sim_core import STRATEGIES, Controller, FloatArray, RidelabError, Scenario, Seen, Setup, simulate
from sim_core.fmi.archive import unpack
from sim_core.fmi.instance import Instance
from sim_core.kernel.build import default_compiler
from sim_core.loop.run import Run
from sim_core.simulate import prepare
from sim_core.strategies.lv_hil import LvHil
from sim_core.vehicle.make import make_vehicle, substeps
from tests.importer import Importer
from tests.results import event

FORCES = ["force_front", "force_rear"]
STATE = [f"state[{i}]" for i in range(1, 9)]
SMALL: dict[str, Any] = {
    "road": {"length": 20, "bump": {"start": 10, "width": 3, "height": 0.09}},
    "speed": {"target_speed_kmh": 30, "detection_distance": 8},
    "mpc": {"force_limit": 1000, "prediction_horizon": 6, "control_horizon": 3, "preview": "lookahead"},
    "lqr": {"preview": "lookahead", "preview_horizon": 12},
}
TOGETHER = SMALL | {"road": SMALL["road"] | {"rear_axle": "together"}}
ROUNDING = 1e-9  # of the greatest value: sums of the same numbers in another order
REAL_CAR: dict[str, Any] = {
    "vehicle": {
        "rebound_ratio": 2,
        "bump_stop_clearance": 0.03,
        "tyre_lift_off": True,
        "anti_dive": 0.4,
        "anti_lift": 0.2,
    },
    "actuator": {"bandwidth": 12},
    "mismatch": {"body_mass": 1.1},
}


def exported(folder: Path, scenario: Scenario, version: Version, strategy: str = "lqr", of: str = "controller") -> Path:
    file = folder / "exported.fmu"
    file.write_bytes(fmu(scenario, strategy, of, version, ["linux64"]))
    assert validate_fmu(str(file)) == []
    return file


class Watched(Controller):
    """Another controller, asked in each step although it has a law; keeps what it saw and gave."""

    def __init__(self, other: Controller, seen: list[tuple[Seen, FloatArray]]) -> None:
        super().__init__()
        self._other = other
        self._seen = seen

    def for_scenario(self, scenario: Scenario) -> "Watched":
        ready = Watched(self._other.for_scenario(scenario), self._seen)
        ready.preview, ready.prediction_horizon = ready._other.preview, ready._other.preview_steps
        return ready

    def start(self, setup: Setup) -> None:
        self._most = setup.force_limit
        self._other.start(setup)

    def force(self, seen: Seen) -> FloatArray:
        force: FloatArray = np.clip(np.asarray(self._other.force(seen)), -self._most, self._most)
        self._seen.append((copy(seen), force))
        return force


def inputs(seen: Seen, sample_time: float) -> dict[str, float]:
    """What an importer connects: the state, and where it looks ahead the road's heights and the braking."""
    values = dict(zip(STATE, seen.state.tolist(), strict=True))
    ahead = seen.preview
    now = ahead[0] - seen.disturbances[:2, 0] * sample_time
    values |= {"road_front": now[0], "road_rear": now[1]}
    for i, ((front, rear), braking) in enumerate(zip(ahead, seen.disturbances[2], strict=True), 1):
        values |= {f"preview_front[{i}]": front, f"preview_rear[{i}]": rear, f"braking[{i}]": braking}
    return values


@pytest.mark.parametrize(("version", "parts"), [("2.0", SMALL), ("3.0", TOGETHER)])
def test_a_linear_law_gives_the_forces_of_our_run_in_whatever_steps_it_is_driven(
    version: Version, parts: dict[str, Any], tmp_path: Path
) -> None:
    """Where both axles meet the road together, too: its passive car, by which the cost is divided, is another one."""
    scenario, seen = Scenario.model_validate(parts), list[tuple[Seen, FloatArray]]()
    simulate(scenario, Watched(STRATEGIES["lqr"](), seen))
    importer = Importer(exported(tmp_path, scenario, version), tmp_path / "fmu")
    differences = []
    with importer.run():
        for k, (each, wanted) in enumerate(seen):
            for part in range(4):  # a command changes with the control step, not with the communication step
                importer.step(k * 0.01 + part * 0.0025, 0.0025, inputs(each, 0.01) if part == 0 else {"state[1]": 9.0})
                differences.append(np.abs(np.array(importer.get(FORCES)) - wanted).max())
    most = max(np.abs(wanted).max() for _, wanted in seen)
    assert most == 1000, "the limit was met"
    assert max(differences) < ROUNDING * most


@pytest.mark.parametrize("parts", [SMALL, TOGETHER], ids=["in turn", "together"])
def test_lv_is_the_ecus_program_to_the_code(parts: dict[str, Any], tmp_path: Path) -> None:
    """In float32; that a rounded input stands in the middle between two codes does not happen here."""
    scenario, seen = Scenario.model_validate(parts), list[tuple[Seen, FloatArray]]()

    class Noting(LvHil):
        def force(self, each: Seen) -> FloatArray | None:
            force = super().force(each)
            assert force is not None
            seen.append((copy(each), force))
            return force

    result = simulate(scenario, Noting)
    importer = Importer(exported(tmp_path, scenario, "3.0", "lv"), tmp_path / "fmu")
    stages = ["cruise", "brake", "bump"]
    with importer.run():
        for k, (each, wanted) in enumerate(seen):
            importer.step(k * 0.01, 0.01, {**inputs(each, 0.01), "stage": stages.index(each.next_stage)})
            assert np.abs(np.array(importer.get(FORCES)) - wanted).max() < 1e-6
    assert event(result, "limited_steps") > 5


def test_the_vehicle_drives_like_our_linear_one(tmp_path: Path) -> None:
    """With the commands of our own LQR; the state at every control instant."""
    scenario = Scenario.model_validate(SMALL)
    run = prepare(scenario, "lqr")
    importer = Importer(exported(tmp_path, scenario, "2.0", of="vehicle"), tmp_path / "fmu")
    assert differences_of(importer, run, run.drive().loop) < ROUNDING


CURVE = {"front_damper_curve": [[-1, -1500], [-0.1, -400], [0.1, 600], [1, 2500]]}


def test_the_vehicle_drives_like_our_nonlinear_one_in_the_same_steps(tmp_path: Path) -> None:
    """Dampers, stops, lift-off, links, lag and mismatch; our own kernel on a road that is straight within its steps."""
    scenario = Scenario.model_validate(SMALL | REAL_CAR | {"vehicle": REAL_CAR["vehicle"] | CURVE})
    run = prepare(scenario, "lqr")
    excitation, grid = run.excitation, run.excitation.grid
    car, actuator = scenario.real_vehicle, scenario.actuator
    driven = make_vehicle(car, actuator, grid.fine_step, grid.fine, excitation.height, grid.braking)
    loop = np.zeros((len(grid.position) + 1, 12))
    loop[1:, 10:] = 800 * np.sin(np.arange(len(grid.position)) / 7)[:, None] * (1, -1)
    for k in range(len(grid.position)):
        driven.advance(k, loop)
    assert np.abs(loop[:, :2]).max() > 0.03, "it meets its stops"
    importer = Importer(exported(tmp_path, scenario, "3.0", of="vehicle"), tmp_path / "fmu")
    step = grid.fine_step / substeps(car, actuator, None, grid.fine_step)
    assert differences_of(importer, run, loop, internal_step=step) < ROUNDING


def differences_of(importer: Importer, run: Run, loop: FloatArray, **parameters: float) -> float:
    """Return the largest difference of a state from that in the loop, relative to its largest value."""
    height, grid, differences = run.excitation.height, run.excitation.grid, []
    fine, step = grid.fine, grid.fine_step
    with importer.run(road_front=height[0, 0], road_rear=height[1, 0], **parameters):
        for i in range(height.shape[1] - 1):
            front, rear = loop[i // fine + 1, -2:]
            road = {"road_front": height[0, i + 1], "road_rear": height[1, i + 1], "braking": grid.braking[i]}
            importer.step(i * step, step, {**road, "force_front": front, "force_rear": rear})
            if (i + 1) % fine == 0:
                differences.append(np.array(importer.get(STATE)) - loop[(i + 1) // fine, :8])
        assert importer.get(["deflection_front", "deflection_rear", "pitch_rate"]) == importer.get(
            [*STATE[:2], STATE[5]]
        )
    return float((np.abs(differences).max(axis=0) / np.abs(loop[:, :8]).max(axis=0)).max())


@pytest.mark.parametrize(
    ("strategy", "more", "reason"),
    [
        ("suspension_only", {}, "a QP decides where one of its limits binds"),
        ("skyhook", {"hook": {"semi_active": True}}, "semi-active dampers"),
    ],
)
def test_a_controller_that_cannot_be_one_is_refused_with_the_reason(
    strategy: str, more: dict[str, Any], reason: str
) -> None:
    with pytest.raises(RidelabError, match=reason) as refused:
        fmu(Scenario.model_validate(SMALL | more), strategy, "controller", "2.0", [])
    assert refused.value.field == "strategy"


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_the_functions_are_the_standards_own_by_its_headers(version: Version, tmp_path: Path) -> None:
    """The headers come with FMPy; another signature would be an error. And without them there is no warning either."""
    headers = Path(fmpy.__file__).parent / "c-code"
    without_binaries = fmu(Scenario.model_validate(SMALL), "lqr", "vehicle", version, [])
    with zipfile.ZipFile(io.BytesIO(without_binaries)) as archive:
        archive.extractall(tmp_path)
    strict = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-Wno-unused-parameter", "-fsyntax-only"]
    files = [str(file) for file in (tmp_path / "sources").glob("*.c")]
    for more in ([], ["-DRIDELAB_STANDARD_HEADERS", f"-I{headers}"]):
        run = subprocess.run([*default_compiler(), *strict, *more, *files], check=False, capture_output=True, text=True)
        assert (run.returncode, run.stderr) == (0, "")


KINDS = (("lqr", "controller"), ("lv", "controller"), ("lqr", "vehicle"))  # a program each


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize(("strategy", "of"), KINDS)
def test_its_sources_build_the_program_that_is_inside(version: Version, strategy: str, of: str, tmp_path: Path) -> None:
    """By another optimisation; with what the description lists, and the numbers that are beside them."""
    file = exported(tmp_path, Scenario.model_validate(SMALL), version, strategy, of)
    given, built = Importer(file, tmp_path / "given"), Importer(file, tmp_path / "built")
    (library,) = (tmp_path / "built" / "binaries").rglob("*.so")
    named = "buildDescription.xml" if version == "3.0" else "../modelDescription.xml"
    files = re.findall(r'File name="(\w+\.c)"', (tmp_path / "built" / "sources" / named).read_text())
    command = [*default_compiler(), "-std=c11", "-O1", "-ffp-contract=off", "-fPIC", "-shared", "-o", str(library)]
    library.unlink()
    subprocess.run([*command, *files, "-lm"], cwd=tmp_path / "built" / "sources", check=True)
    outputs = []
    for importer in (given, built):
        with importer.run():
            importer.step(0, 0.01, {"state[1]": 0.02} if of == "controller" else {"road_front": 0.02})
            outputs.append(importer.get(FORCES if of == "controller" else STATE))
    assert outputs[0] == outputs[1]
    assert any(outputs[0])


def sealed(content: bytes) -> bytes:
    """Numbers with a checksum that fits them."""
    return content[:8] + struct.pack("<I", zlib.crc32(content[12:])) + content[12:]


DAMAGES: dict[str, Callable[[bytes], bytes | None]] = {
    "is not there": lambda _: None,
    "is empty": lambda _: b"",
    "is cut": lambda content: content[:-8],
    "has another bit": lambda content: content[:-9] + bytes([content[-9] ^ 1]) + content[-8:],
    "is cut and sealed": lambda content: sealed(content[:-8]),
    "is longer": lambda content: sealed(content + bytes(8)),
    "has a text beyond its end": lambda content: sealed(content[:12] + struct.pack("<I", 2**32 - 8) + content[16:]),
    "has no number": lambda content: sealed(content[:-8] + struct.pack("<d", float("nan"))),
}


@pytest.mark.parametrize(("strategy", "of"), KINDS)
def test_damaged_numbers_are_an_error_and_never_a_crash(strategy: str, of: str, tmp_path: Path) -> None:
    """Named damages, then numbers by chance under a checksum that fits: it drives, or says why there is no instance."""
    content = fmu(Scenario.model_validate(SMALL), strategy, of, "3.0", ["linux64"])
    description, _, library = unpack(content)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        archive.extractall(tmp_path)
    numbers = tmp_path / "resources" / "numbers.bin"
    whole = numbers.read_bytes()

    def end(damaged: bytes | None) -> None:
        numbers.unlink(missing_ok=True)
        if damaged is not None:
            numbers.write_bytes(damaged)
        instance = Instance(description, tmp_path, library, "It")
        instance.begin([])
        instance.step(0, 0.01)
        instance.end()

    end(whole)
    for name, damage in DAMAGES.items():
        print(f"the file {name}")
        with pytest.raises(RidelabError, match=r"It: the FMU made no instance \(numbers.bin"):
            end(damage(whole))
    chance, first = random.Random(1), 16 + int.from_bytes(whole[12:16], "little")  # noqa: S311
    for _ in range(300):
        place = first + 8 * chance.randrange((len(whole) - first) // 8)
        number = struct.pack("<d", chance.choice([-1.0, 0.0, 0.5, 1e9, 1e300, float(chance.randrange(100))]))
        with suppress(RidelabError):
            end(sealed(whole[:place] + number + whole[place + 8 :]))


def test_one_without_a_platforms_binary_says_what_makes_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(programs, "BINARIES", tmp_path)
    with zipfile.ZipFile(io.BytesIO(fmu(Scenario(), "lqr", "controller", "2.0"))) as archive:
        assert not any(name.startswith("binaries/") for name in archive.namelist())
        said = archive.read("documentation/index.html").decode()
    assert [f"No binary for {each}: " in said for each in programs.PLATFORMS] == [True] * 3
    assert "`make binaries` compiles it" in said
