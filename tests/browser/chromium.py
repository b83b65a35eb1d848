"""Finds a Chromium: an installed one, else Playwright's own, else the system's package; never silently none."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Error, Playwright

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
# No sandbox as root in a container; and nothing of the browser's own goes out to the network.
ARGUMENTS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


def launch(playwright: Playwright) -> Browser:
    """Starts the first Chromium that works.

    Raises:
        pytest.fail.Exception: There is none, and none could be installed; says how to get one.
    """
    tried: list[str] = []
    for find in (_installed, _downloaded, _packaged):
        path = find()
        if path is None:
            tried.append(f"{find.__name__.strip('_')}: none")
            continue
        try:
            return playwright.chromium.launch(executable_path=path or None, args=ARGUMENTS)
        except Error as error:
            tried.append(f"{path or 'the download'}: {error.message.splitlines()[0]}")
    pytest.fail(f"The browser tests need Chromium ({'; '.join(tried)}). Install it: apt-get install chromium")


def _installed() -> str | None:
    return next((path for name in NAMES if (path := shutil.which(name))), None)


def _downloaded() -> str | None:
    """Playwright's own build, at the place it knows (an empty path)."""
    command = [sys.executable, "-m", "playwright", "install", "--only-shell", "chromium"]
    try:
        done = subprocess.run(command, capture_output=True, timeout=240, check=False)
    except subprocess.TimeoutExpired:
        return None
    return "" if done.returncode == 0 else None


def _packaged() -> str | None:
    if os.geteuid() != 0 or not Path("/usr/bin/apt-get").exists():
        return None
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["apt-get", "update"], ["apt-get", "install", "--yes", "--no-install-recommends", "chromium"]):
        if subprocess.run(command, capture_output=True, env=environment, timeout=600, check=False).returncode != 0:
            return None
    return _installed()
