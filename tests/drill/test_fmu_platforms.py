"""FMUs of every platform: that for Windows is driven by a program for Windows, that for macOS judged by its format."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

from backend.fmu import archive
from sim_core import FloatArray, Scenario, Seen, simulate
from sim_core.strategies.lqr import Lqr
from tests.servers.programs import find

SCENARIO = Scenario.model_validate({"road": {"length": 20, "bump": {"start": 10, "width": 3, "height": 0.09}}})
DRIVER = Path(__file__).with_name("driver.c")


class Watched(Lqr):
    """Our LQR, asked in each step; keeps the states and its forces within the limit."""

    id = "watched"
    seen: list[tuple[FloatArray, FloatArray]]

    def linear_law(self, stage: str) -> None:  # type: ignore[override]  # it is asked in every step
        return None

    def force(self, seen: Seen) -> FloatArray:
        law, limit = self._law, SCENARIO.mpc.force_limit
        force: FloatArray = np.clip(law.force(seen.state, seen.previous_force), -limit, limit)
        self.seen.append((seen.state.copy(), force))
        return force


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Unpack what `make binaries` has compiled, in a folder whose name an address has to encode."""
    folder = tmp_path_factory.mktemp("für 100% und mehr")
    for version in ("2.0", "3.0"):
        (folder / f"{version}.fmu").write_bytes(archive.fmu(SCENARIO, "lqr", "controller", version))
        with zipfile.ZipFile(folder / f"{version}.fmu") as file:
            file.extractall(folder / version)
    return folder


def test_there_is_a_library_for_every_platform_in_its_own_format(exported: Path) -> None:
    old, new = exported / "2.0" / "binaries", exported / "3.0" / "binaries"
    assert {path.name for path in old.iterdir()} == {"linux64", "win64", "darwin64"}
    assert {path.name for path in new.iterdir()} == {"x86_64-linux", "x86_64-windows", "x86_64-darwin"}
    for folder in (old / "linux64", new / "x86_64-linux"):
        assert (folder / "ridelab_lqr.so").read_bytes()[:6] == b"\x7fELF\x02\x01"
    for folder in (old / "win64", new / "x86_64-windows"):
        content = (folder / "ridelab_lqr.dll").read_bytes()
        header = int.from_bytes(content[0x3C:0x40], "little")
        assert (content[:2], content[header : header + 6]) == (b"MZ", b"PE\0\0\x64\x86"), "for x86-64"
        assert content[header + 23] & 0x20, "a DLL"
    for folder in (old / "darwin64", new / "x86_64-darwin"):
        content = (folder / "ridelab_lqr.dylib").read_bytes()
        assert content[:8] == b"\xcf\xfa\xed\xfe\x07\x00\x00\x01", "Mach-O, 64 bits, x86-64"
        assert int.from_bytes(content[12:16], "little") == 6, "a dynamic library"


def test_the_one_for_windows_gives_our_forces_in_a_program_for_windows(exported: Path, tmp_path: Path) -> None:
    program = tmp_path / "driver.exe"
    zig = [sys.executable, "-m", "ziglang", "cc", "-target", "x86_64-windows-gnu"]
    subprocess.run([*zig, "-O1", str(DRIVER), "-o", str(program)], check=True)
    Watched.seen = []
    simulate(SCENARIO, Watched)
    description = (exported / "2.0" / "modelDescription.xml").read_text()
    token = description.partition('guid="')[2].partition('"')[0]
    library = exported / "2.0" / "binaries" / "win64" / "ridelab_lqr.dll"
    resources = (exported / "2.0" / "resources").as_uri().replace("file:///", "file:///Z:/")
    wine = find("wine64", package="wine64", folders="usr/lib/wine")
    prefix = {"WINEPREFIX": str(tmp_path / "wine"), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml="}
    states = np.array([state for state, _ in Watched.seen])
    run = subprocess.run(
        [wine, str(program), f"Z:{library}", token, resources],
        input=states.tobytes(),
        capture_output=True,
        check=True,
        env={**os.environ, **prefix},
    )
    forces = np.frombuffer(run.stdout).reshape(-1, 2)
    wanted = np.array([force for _, force in Watched.seen])
    assert np.abs(forces - wanted).max() < 1e-9 * np.abs(wanted).max()
