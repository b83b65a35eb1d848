"""The commands that the page gives to copy, pasted."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.browser.dashboard import Dashboard, expect_new_address
from tests.servers.process import HANG_TIMEOUT, ROOT


@pytest.fixture
def clipboard(dashboard: Dashboard) -> Iterator[Page]:
    """The dashboard's page, which may read what was copied."""
    dashboard.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    yield dashboard.page
    dashboard.page.context.clear_permissions()


def copied(page: Page, item: str) -> str:
    page.evaluate("navigator.clipboard.writeText('')")
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem", name=item).click()
    page.wait_for_function("async () => await navigator.clipboard.readText() !== ''")
    return str(page.evaluate("navigator.clipboard.readText()"))


def shell(command: str) -> str:
    """What a POSIX shell prints for it, in the repository with its programs at hand."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["sh", "-c", command],
        cwd=ROOT,
        env=os.environ | {"PATH": path},
        capture_output=True,
        text=True,
        timeout=HANG_TIMEOUT,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_copied_commands_give_the_same_run(dashboard: Dashboard, clipboard: Page) -> None:
    dashboard.open()
    first = clipboard.url
    for name, value in (("Height", "-6"), ("Cruise, Body acceleration, value", "5")):
        dashboard.type_into(name, value)
        expect_new_address(clipboard, first)
        first = clipboard.url
    clipboard.get_by_role("combobox", name="Shape").select_option("flat_top")
    expect_new_address(clipboard, first)
    dashboard.expect_curves()

    curl = copied(clipboard, "Copy as curl")
    assert json.loads(shell(curl))["id"] == dashboard.run_id
    command = copied(clipboard, "Copy as command line")
    assert command.startswith("ridelab run --set road.bump.shape=flat_top --set road.bump.height=-0.06")
    assert json.loads(shell(f"{command} --json"))["id"] == dashboard.run_id
    script = copied(clipboard, "Copy as Python")
    assert shell(f"python -c '{script}\nprint(run.id)'").strip() == dashboard.run_id
