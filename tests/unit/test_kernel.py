"""The core's C: how it is compiled, and each function against its definition in NumPy."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.random import default_rng

from sim_core import LinearLaw
from sim_core.kernel import build, library
from sim_core.kernel.library import load
from sim_core.kernel.qp import QpMemory
from sim_core.loop.preview import sliding_forecast
from tests.unit.qp_design import qp_design
from tests.unit.still_car import still_car


def test_where_it_is_not_built_or_of_other_sources_it_says_what_to_do(tmp_path: Path) -> None:
    built = Path(library.__file__).with_name("libridelab.so.1")
    load(built, library.DIGEST)  # an ImportError otherwise
    for file, expected in [(tmp_path / "libridelab.so.1", None), (built, "of other sources")]:
        with pytest.raises(ImportError, match="make setup"):
            load(file, expected)


ZIG, TARGETS = [sys.executable, "-m", "ziglang", "cc", "-target"], ("x86_64-linux-gnu.2.17", "x86_64-windows-gnu")


@pytest.mark.parametrize(
    "compiler",
    [
        [*build.default_compiler(), "-fPIC"],
        *(pytest.param([*ZIG, each], marks=pytest.mark.thorough) for each in ("native", *TARGETS, "aarch64-macos")),
    ],
    ids=lambda words: str(words[-1]),
)
def test_it_is_plain_c11_to_every_compiler(compiler: list[str], tmp_path: Path) -> None:
    """To the machine's, and to zig's for other systems, whose C libraries it brings."""
    command = build.command(compiler, tmp_path / "library", "-O1", "-Wall", "-Wextra", "-Werror")
    output = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (output.returncode, output.stderr) == (0, "")


# In a process of its own: a library is loaded once.
DRIVE = """
import hashlib, sys
from itertools import pairwise
from pathlib import Path
read = Path.read_text
if "--plain" in sys.argv:
    Path.read_text = lambda path, *more, **options: "" if path.name == "cpuinfo" else read(path, *more, **options)
from sim_core import Road, Scenario, Vehicle, simulate
from sim_core.kernel import build
digest = hashlib.sha256()
for vehicle in (Vehicle(), Vehicle(bump_stop_stiffness=300_000, rebound_ratio=1.5)):
    for name in ("lv", "lqr", "passive"):
        series = simulate(Scenario(vehicle=vehicle, road=Road(seed=3)), name).series
        digest.update(b"".join(series[signal].tobytes() for signal in sorted(series)))
print(build.best().name, digest.hexdigest())
"""


def test_the_library_for_newer_processors_gives_the_same_bits() -> None:
    command = [sys.executable, "-c", DRIVE]
    name, here = subprocess.check_output(command, text=True).split()
    plain, there = subprocess.check_output([*command, "--plain"], text=True).split()
    assert (plain, here) == (build.NAME, there)
    assert name in build.libraries(build.default_compiler())


@pytest.mark.parametrize(
    ("kind", "seen"),
    [(0, [1, 1, 1, 1]), (1, [1, 1, 1, 1]), (2, [1, 1, 1, 1]), (2, [1, -1, 1, -1])],
    ids=["front road", "rear road", "mean braking", "braking about its mean"],
)
def test_a_limit_on_one_kind_of_preview_binds_where_all_of_it_is_seen(kind: int, seen: list[float]) -> None:
    steps, ahead, limits = 20, np.zeros((3, 23)), np.zeros((11, 22))  # looked at in eights
    ahead[kind, 10:14] = seen
    limits[0, 10 + 4 * kind : 14 + 4 * kind] = 0.251 * np.array(seen)  # 1.004 in step 10, 0.753 before it
    law = LinearLaw(gain=np.zeros((2, 10)), preview_gain=np.zeros((2, 12)), limits=limits)
    sight = sliding_forecast(ahead, 4, np.zeros((2, steps)))
    arrays = np.zeros((steps + 1, 10)), sight.disturbances, sight.source, sight.preview_norms, np.full(3, np.inf)
    assert still_car(steps=steps).follow_law(*arrays, clips=True)(law.design, None, 0, steps)[0] == 10


def test_a_residual_is_the_largest_violation() -> None:
    """The violations are of stationarity, box, rows, their multipliers' signs and gaps: each is largest in some."""
    rng = default_rng(1)
    moves, travels = 3, 4
    n, rows = moves + 2, 2 * travels
    root = rng.normal(size=(n, n))
    H, A, low, high = root @ root.T, rng.normal(size=(rows, n)), -np.ones(n), np.ones(n)
    matrices = qp_design(H=H, columns=np.ascontiguousarray(A.T), low=low, high=high)
    largest = set()
    for _ in range(300):
        scale = 10 ** rng.uniform(-3, 3, size=4)
        y, multipliers = scale[0] * rng.normal(size=n), scale[1] * rng.normal(size=n + rows)
        box, of_rows = multipliers[:n], multipliers[n:]
        f = scale[2] * rng.normal(size=n) - (H @ y + box + A.T @ of_rows)
        b = scale[3] * rng.normal(size=rows) + A @ y
        slack, force = b - A @ y, 1 + np.abs(multipliers).max()
        gap = np.where(box < 0, y - low, high - y)
        violations = [
            np.abs(H @ y + f + box + A.T @ of_rows) / (1 + np.abs(f)),
            np.maximum(low - y, y - high),
            -slack,
            -of_rows / force,
            np.abs(np.concatenate([box * gap, of_rows * slack])) / force,
        ]
        worst = [float(each.max()) for each in violations]
        largest.add(int(np.argmax(worst)))
        memory = QpMemory(matrices, 1.0)
        memory.f[:], memory.b[:], memory.y[:], memory.multipliers[:] = f, b, y, multipliers
        violation = memory.residual(matrices)
        assert violation == pytest.approx(max(worst), rel=1e-9)
    assert largest == set(range(5))
    memory.f[0] = np.nan
    assert not memory.residual(matrices) < np.inf
