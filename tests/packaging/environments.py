"""Wheels of the three distributions, and environments of some of them with the packages they declare, and no others."""

import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator
from importlib.metadata import Distribution, distribution
from pathlib import Path

from packaging.requirements import Requirement

ROOT = Path(__file__).parents[2]
# Stands for a compiler: `make setup` has compiled the core's C by the same setup.py, which takes ten seconds of a core.
COMPILED = 'while [ "$1" != -o ]; do shift; done; cp "$0/$(basename "$2")" "$2"'


def built(folder: Path) -> dict[str, Path]:
    """The wheels by distribution, from copies: setuptools leaves its work beside the sources."""
    sources, wheels = folder / "sources", folder / "wheels"
    ours = shutil.ignore_patterns("__pycache__", "*.egg-info", "build", "libridelab*.so.1")
    for name in ("sim_core", "client", "backend", "frontend/dist", "build/manual"):
        shutil.copytree(ROOT / name, sources / name, ignore=ours)
    for name in ("pyproject.toml", "setup.py", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, sources)
    with (sources / "build" / "sbom.cdx.json").open("w") as bill:  # as `make dist` does
        subprocess.run([sys.executable, ROOT / "backend/deploy/sbom.py"], stdout=bill, check=True)
    projects = [str(path) for path in (sources / "sim_core", sources / "client", sources)]
    compiler = shlex.join(["sh", "-c", COMPILED, str(ROOT / "sim_core/kernel")])
    pip("wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", str(wheels), *projects, CC=compiler)
    return {path.name.split("-")[0].replace("_", "-"): path for path in wheels.glob("*.whl")}


class Environment:
    """A virtual environment with some wheels; their dependencies are links to the packages that run these tests.

    `packages` are the distributions in it, by name.
    """

    def __init__(self, folder: Path, wheels: Iterable[Path]) -> None:
        self._folder = folder
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
        (site,) = folder.glob("lib/python*/site-packages")
        pip("--python", str(folder / "bin" / "python"), "install", "--no-deps", "--no-compile", *map(str, wheels))
        own = [Distribution.at(path) for path in site.glob("*.dist-info")]
        linked: set[str] = {each.metadata["Name"] for each in own}
        for each in own:
            _link(each, set(), site, linked)
        self.packages = linked

    def run(self, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
        """A program of this environment, in its folder and without the variables of ours."""
        command = [str(self._folder / "bin" / words[0]), *words[1:]]
        return subprocess.run(
            command, capture_output=True, text=True, check=False, cwd=self._folder, env=self.variables(**environment)
        )

    def file(self, name: str) -> Path:
        """A file below its folder."""
        return self._folder / name

    def program(self, name: str) -> str:
        """Where a program is."""
        return str(self._folder / "bin" / name)

    def variables(self, **more: str) -> dict[str, str]:
        """The environment variables of its processes."""
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("RIDELAB_", "PYTHON"))}
        return {
            **environment,
            "XDG_CACHE_HOME": str(self._folder / "cache"),
            "XDG_DATA_HOME": str(self._folder / "data-home"),
            "RIDELAB_WORKERS": "1",
            "RIDELAB_BATCH_WORKERS": "1",
            **more,
        }


def pip(*words: str, **environment: str) -> None:
    """Run it without the network."""
    command = [sys.executable, "-m", "pip", "--disable-pip-version-check", *words, "--quiet", "--no-index"]
    subprocess.run(command, check=True, capture_output=True, env={**os.environ, **environment})


def _link(one: Distribution, extras: set[str], site: Path, linked: set[str]) -> None:
    """Link what it requires, with these extras, into the folder."""
    for requirement in _requirements(one, extras):
        installed = distribution(requirement.name)
        if installed.metadata["Name"] not in linked:
            linked.add(installed.metadata["Name"])
            for name in {file.parts[0] for file in installed.files or ()} - {"..", "__pycache__"}:
                (site / name).symlink_to(Path(str(installed.locate_file(name))))
            _link(installed, requirement.extras, site, linked)


def _requirements(one: Distribution, extras: set[str]) -> Iterator[Requirement]:
    for requirement in map(Requirement, one.requires or ()):
        marker = requirement.marker
        if marker is None or any(marker.evaluate({"extra": extra}) for extra in extras or {""}):
            yield requirement
