"""The core's C compiles without a word for other systems too, and as the image builds it."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from sim_core.kernel import build
from sim_core.kernel.library import load
from tests.servers.process import ROOT

TARGETS = ["native", "x86_64-linux-gnu.2.17", "x86_64-windows-gnu", "aarch64-macos"]


@pytest.mark.parametrize("target", TARGETS)
def test_it_is_plain_c11_on_every_system(target: str, tmp_path: Path) -> None:
    compiler = [sys.executable, "-m", "ziglang", "cc", "-target", target]
    command = build.command(compiler, tmp_path / "library", "-Wall", "-Wextra", "-Werror")
    output = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (output.returncode, output.stderr) == (0, "")


def test_the_image_has_the_library_that_the_core_asks_for(tmp_path: Path) -> None:
    """Its command is run here, by the shell that it will have there, on what it has copied."""
    dockerfile = (ROOT / "Dockerfile").read_text()
    (command,) = re.findall(r"^RUN (\S+ sim_core/kernel/build\.py .*)\n", dockerfile, re.MULTILINE)
    for copied in re.findall(r"^COPY (sim_core/\S+/) \1$", dockerfile, re.MULTILINE):
        shutil.copytree(ROOT / copied, tmp_path / copied)
    here = command.replace("python", sys.executable, 1)
    subprocess.run(["sh", "-c", here], cwd=tmp_path, check=True)
    load(tmp_path / "libridelab.so.1", build.digest())  # an ImportError otherwise
