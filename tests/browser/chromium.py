"""Finds a Chromium: an installed one, else Playwright's own, else the system's package; never silently none."""

import contextlib
import shutil
import subprocess
import sys

from playwright.sync_api import Browser, Playwright

from tests.servers.programs import find

# Its shell first, which has no windows: a page takes a quarter less of a core there.
NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
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
    "--js-flags=--no-maglev --no-turbofan",  # no page here lives long enough for what its scripts' compilers cost
)
DOWNLOAD = [sys.executable, "-m", "playwright", "install", "--only-shell", "chromium"]


def launch(playwright: Playwright, *, back_forward_cache: bool = False) -> Browser:
    """Starts it, by itself without the back/forward cache: Playwright does not follow a page that it brings back."""
    path = next(filter(None, map(shutil.which, NAMES)), None)
    if path is None and not _downloaded():
        path = find("chromium", package="chromium")
    switched_on = ["--disable-back-forward-cache"] if back_forward_cache else []
    return playwright.chromium.launch(executable_path=path, args=ARGUMENTS, ignore_default_args=switched_on)


def _downloaded() -> bool:
    with contextlib.suppress(subprocess.TimeoutExpired):
        return subprocess.run(DOWNLOAD, capture_output=True, timeout=240, check=False).returncode == 0
    return False
