"""What is installed is what was agreed: each package by its hash, from no address, fit for what the project asks.

Known vulnerabilities need the internet (docs/security.md says how to ask); this needs nothing.
"""

import base64
import json
import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
PACKAGES = json.loads((ROOT / "frontend" / "package-lock.json").read_text())["packages"]


def locked(name: str) -> dict[str, list[str]]:
    """Versions by package; several where a marker chooses between them."""
    found: dict[str, list[str]] = {}
    for line in (ROOT / name).read_text().splitlines():
        if match := re.match(r"([A-Za-z0-9][\w.-]*)(?:\[[^\]]*\])?==([^\s;\\]+)", line):
            found.setdefault(canonicalize_name(match[1]), []).append(match[2])
    return found


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("requirements.lock", PROJECT["dependencies"]),
        ("requirements-dev.lock", [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["dev"]]),
    ],
    ids=["runtime", "development"],
)
def test_locks_hold_what_the_project_asks_for(name: str, wanted: list[str]) -> None:
    versions = locked(name)
    assert len(versions) >= len(wanted)
    for requirement in map(Requirement, wanted):
        found = versions.get(canonicalize_name(requirement.name), [])
        assert found, f"{requirement} is not locked: make lock"
        assert all(requirement.specifier.contains(version, prereleases=True) for version in found), requirement


@pytest.mark.parametrize("name", ["requirements.lock", "requirements-dev.lock"])
def test_each_hash_is_of_a_file(name: str) -> None:
    hashes = re.findall(r"--hash=(\S+)", (ROOT / name).read_text())
    assert len(hashes) >= len(locked(name))
    assert all(re.fullmatch(r"sha256:[0-9a-f]{64}", found) for found in hashes)


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
