"""Installed packages are the locked ones: each by its hash, from no address, in a version the project asks for.

Known vulnerabilities need the internet (docs/explanation/security.md says how to ask); this needs nothing.
"""

import json
import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import ridelab
import sim_core

ROOT = Path(__file__).parents[2]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
CORE, CLIENT = (
    tomllib.loads((ROOT / name / "pyproject.toml").read_text())["project"]["dependencies"]
    for name in ("sim_core", "client")
)
OURS = {"ridelab-core", "ridelab"}
SERVER = [each for each in PYPROJECT["project"]["dependencies"] if Requirement(each).name not in OURS]
RUNTIME, EXTRAS = [*CORE, *CLIENT, *SERVER], PYPROJECT["project"]["optional-dependencies"]
GROUPS = PYPROJECT["dependency-groups"]
LOCKS = {
    "requirements.lock": [*RUNTIME, *EXTRAS["parquet"]],
    "requirements-cluster.lock": [*RUNTIME, *EXTRAS["cluster"]],
    "requirements-build.lock": GROUPS["build"],
    "requirements-manual.lock": GROUPS["manual"],
    "requirements-compiler.lock": GROUPS["compiler"],
    "requirements-clients.lock": GROUPS["clients"],
    "requirements-dev.lock": [
        *RUNTIME,
        *(each for extra in EXTRAS.values() for each in extra),
        *GROUPS["build"],
        *GROUPS["compiler"],
        *GROUPS["manual"],
    ],
}


def locked(name: str) -> dict[str, list[str]]:
    """Versions by package; several where a marker chooses between them."""
    requested: dict[str, list[str]] = {}
    for line in (ROOT / name).read_text().splitlines():
        if match := re.match(r"([A-Za-z0-9][\w.-]*)(?:\[[^\]]*\])?==([^\s;\\]+)", line):
            requested.setdefault(canonicalize_name(match[1]), []).append(match[2])
    return requested


@pytest.mark.parametrize(("name", "wanted"), LOCKS.items())
def test_locks_hold_what_the_project_asks_for(name: str, wanted: list[str]) -> None:
    versions = locked(name)
    assert len(versions) >= len({Requirement(each).name for each in wanted})
    assert not OURS & versions.keys(), "they are installed from here"
    for requirement in map(Requirement, wanted):
        pinned = versions.get(canonicalize_name(requirement.name), [])
        assert pinned, f"{requirement} is not locked: make lock"
        assert all(requirement.specifier.contains(version, prereleases=True) for version in pinned), requirement


def test_the_server_asks_for_its_own_core_and_client() -> None:
    wanted = {Requirement(each).name: str(Requirement(each).specifier) for each in PYPROJECT["project"]["dependencies"]}
    assert {name: wanted[name] for name in OURS} == {
        "ridelab-core": f"=={sim_core.__version__}",
        "ridelab": f"=={ridelab.__version__}",
    }


def test_all_locks_agree() -> None:
    """Those that are installed together; the generator of clients has an environment of its own."""
    development, together = locked("requirements-dev.lock"), LOCKS.keys() - {"requirements-clients.lock"}
    assert all(development[name] == versions for lock in together for name, versions in locked(lock).items())


@pytest.mark.parametrize("name", LOCKS)
def test_each_locked_package_has_a_hash_and_no_address(name: str) -> None:
    text = (ROOT / name).read_text()
    assert "://" not in text
    for entry in re.split(r"\n(?=[A-Za-z0-9])", text.rstrip()):
        assert re.search(r"==.*\n", entry), entry
        assert re.search(r"--hash=sha256:[0-9a-f]{64}\b", entry), entry


def test_the_pages_packages_are_locked_by_hash_and_have_no_address() -> None:
    """`npm ci`, which installs them, holds the lock to package.json."""
    packages = json.loads((ROOT / "frontend" / "package-lock.json").read_text())["packages"]
    del packages[""]
    assert len(packages) > 50
    assert [path for path, entry in packages.items() if not entry["integrity"].startswith("sha512-")] == []
    assert [path for path, entry in packages.items() if {"resolved", "link"} & entry.keys()] == []
