"""Installed packages are the locked ones: each by its hash, from no address, in a version the project asks for.

Known vulnerabilities need the internet (docs/explanation/security.md says how to ask); this needs nothing.
"""

import base64
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
    "requirements-cluster.lock": [*RUNTIME, *EXTRAS["parquet"], *EXTRAS["cluster"]],
    "requirements-build.lock": GROUPS["build"],
    "requirements-manual.lock": GROUPS["manual"],
    "requirements-ecu.lock": EXTRAS["ecu"],
    "requirements-clients.lock": GROUPS["clients"],
    "requirements-dev.lock": [
        *RUNTIME,
        *(each for extra in EXTRAS.values() for each in extra),
        *GROUPS["build"],
        *GROUPS["manual"],
    ],
}
PACKAGES = json.loads((ROOT / "frontend" / "package-lock.json").read_text())["packages"]


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
    assert "--index-url" not in text
    for entry in re.split(r"\n(?=[A-Za-z0-9])", text.rstrip()):
        assert "==" in entry.splitlines()[0], entry
        hashes = re.findall(r"--hash=(\S+)", entry)
        assert hashes, entry
        assert all(re.fullmatch(r"sha256:[0-9a-f]{64}", digest) for digest in hashes), entry


def test_frontend_packages_are_locked_by_hash_and_come_from_no_address_of_their_own() -> None:
    packages = {path: entry for path, entry in PACKAGES.items() if path}
    assert len(packages) > 50
    for path, entry in packages.items():
        algorithm, _, digest = entry["integrity"].partition("-")
        assert (algorithm, len(base64.b64decode(digest))) == ("sha512", 64), path
        assert "resolved" not in entry, path
        assert not entry.get("link"), path


def test_the_frontend_lock_is_of_its_package() -> None:
    package = json.loads((ROOT / "frontend" / "package.json").read_text())
    for kind in ("dependencies", "devDependencies"):
        assert PACKAGES[""][kind] == package[kind]
        assert {f"node_modules/{name}" for name in package[kind]} <= set(PACKAGES)
