"""Finds the programs real servers are made of: on the machine, else from its package; never silently none."""

import os
import pwd
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from tests.servers.process import ROOT


def find(name: str, *, package: str, folders: str = "") -> str:
    """The program's path; installs its Debian package where that is possible and it is missing.

    Args:
        name: Of the program.
        package: What to install.
        folders: A pattern of folders, from the root, to look into before PATH.

    Raises:
        pytest.fail.Exception: There is none and none could be installed; says how to get one.
    """
    for attempt in ("installed", "packaged"):
        if attempt == "packaged" and not _install(package):
            break
        searched = sorted(map(str, Path("/").glob(folders)), reverse=True) if folders else []
        path = os.pathsep.join([*searched, os.environ.get("PATH", ""), "/usr/sbin"])
        if program_path := shutil.which(name, path=path):
            return program_path
    pytest.fail(f"These tests need the program {name}. Install it: apt-get install {package}")


def make_secrets(folder: Path) -> list[Path]:
    """Return the secrets of docker-compose.yml, which its script makes in this folder."""
    find("openssl", package="openssl")
    subprocess.run([ROOT / "backend/deploy/secrets.sh", folder], check=True, capture_output=True)
    return sorted(folder.iterdir())


def _install(package: str) -> bool:
    if os.geteuid() != 0 or not Path("/usr/bin/apt-get").exists():
        return False
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["apt-get", "update"], ["apt-get", "install", "--yes", "--no-install-recommends", package]):
        if subprocess.run(command, capture_output=True, env=environment, timeout=600, check=False).returncode != 0:
            return False
    return True


def unprivileged(*names: str) -> dict[str, Any]:
    """Arguments for `subprocess` that make a program run as the first of these users when we are root."""
    if os.geteuid() != 0:
        return {}
    for name in (*names, "nobody"):
        try:
            user = pwd.getpwnam(name)
        except KeyError:
            continue
        return {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}
    pytest.fail("These tests need a user that is not root, such as nobody")
