"""The core's C compiles without a word for other systems too."""

import subprocess
import sys
from pathlib import Path

import pytest

from sim_core.kernel import build

TARGETS = ["native", "x86_64-linux-gnu.2.17", "x86_64-windows-gnu", "aarch64-macos"]


@pytest.mark.parametrize("target", TARGETS)
def test_it_is_plain_c11_on_every_system(target: str, tmp_path: Path) -> None:
    compiler = [sys.executable, "-m", "ziglang", "cc", "-target", target]
    command = build.command(compiler, tmp_path / "library", "-Wall", "-Wextra", "-Werror")
    output = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (output.returncode, output.stderr) == (0, "")
