"""Finds a Chromium: an installed one, else Playwright's own, else the system's package; never silently none."""

import contextlib
import shutil
import subprocess
import sys

from playwright.sync_api import Browser, Playwright

from tests.servers.programs import find

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
SHELL = "chromium-headless-shell"  # a browser without windows: a page takes a quarter less of a core there
# The last such list counts: Playwright's own, and the pages of the address bar, which every new context loads and which
# take three quarters of a second of a core while ours does.
SWITCHED_OFF = (
    "AimEnabled",
    "AvoidCorsURLLoaderRestartOnRedirect",
    "AvoidUnnecessaryBeforeUnloadCheckSync",
    "DestroyProfileOnBrowserClose",
    "HttpsFirstBalancedModeAutoEnable",
    "HttpsUpgrades",
    "LensOverlay",
    "MediaRouter",
    "NetworkTimeServiceQuerying",
    "OptimizationHints",
    "PaintHolding",
    "PreconnectToSearch",
    "ThirdPartyStoragePartitioning",
    "WebUIOmniboxAimPopup",
    "WebUIOmniboxPopup",
)
# No sandbox as root in a container; and nothing of the browser's own goes out to the network.
ARGUMENTS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    f"--disable-features={','.join(SWITCHED_OFF)}",
)
NO_COMPILERS = "--js-flags=--no-maglev --no-turbofan"  # no test's page lives long enough for what they cost
DOWNLOAD = [sys.executable, "-m", "playwright", "install", "chromium"]  # the whole browser, and its shell


def launch(playwright: Playwright, *, compilers: bool = False) -> Browser:
    """Start it; with `compilers` scripts run as fast as at a visitor's."""
    path = next(filter(None, map(shutil.which, (SHELL, *NAMES))), None)
    if path is None and not _downloaded():
        path = find("chromium", package="chromium")
    arguments = ARGUMENTS if compilers else (*ARGUMENTS, NO_COMPILERS)
    return playwright.chromium.launch(executable_path=path, args=arguments)


def _downloaded() -> bool:
    with contextlib.suppress(subprocess.TimeoutExpired):
        return subprocess.run(DOWNLOAD, capture_output=True, timeout=240, check=False).returncode == 0
    return False
