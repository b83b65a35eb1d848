"""What somebody takes along: files, figures, an FMU, commands to paste."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.browser.dashboard import Dashboard, expect
from tests.servers.process import ROOT


@pytest.mark.thorough
def test_files_of_every_kind_and_an_fmu(dashboard: Dashboard) -> None:
    """A pin's name is a text in a drawing, also one that looks like a link."""
    dashboard.open()
    page = dashboard.page
    page.get_by_role("region", name="Comparison").get_by_role("button", name="Pin", exact=True).click()
    page.get_by_role("button", name="Paper’s scenario").click()
    page.get_by_label("Name").fill('<a href="//other">x')
    page.get_by_label("Name").press("Enter")
    page.keyboard.press("Escape")
    dashboard.edit("Height", "12")
    expect(page.locator("[data-pinned]").first).to_be_visible()
    for name, suffix, begin in (
        ("LV control as CSV", "csv", b"time [s],position [m],speed [m/s]"),
        ("LV control as JSON", "json", b"{"),
        ("PNG picture", "png", b"\x89PNG"),
        ("SVG drawing", "svg", b"<svg"),
    ):
        saved = dashboard.exported(name)
        content = saved.path().read_bytes()
        assert re.fullmatch(rf"ridelab-{dashboard.run_id}.*\.{suffix}", saved.suggested_filename)
        assert begin in content[:200]
        assert len(content) > 50_000
    drawings = [content, dashboard.saved_figure("Body acceleration", "SVG")]
    for drawing in drawings:
        assert b"<a " not in drawing
        assert b'LV control, &#60;a href="//other"' in drawing
    table = dashboard.saved_figure("Body acceleration", "CSV").decode()
    assert f"# run: {dashboard.run_id}\n" in table
    assert "LV control: position [m],LV control: Body acceleration [m/s²]" in table

    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem", name="FMU…").click()
    dialog = page.get_by_role("dialog", name="Export an FMU")
    for what in ("Single suspension control", "The vehicle"):
        dialog.get_by_role("combobox", name="What").click()
        page.get_by_role("option", name=what).click()
        if what != "The vehicle":
            dialog.get_by_role("button", name="Export").click()
            expect(dialog.get_by_role("alert")).to_contain_text("a QP decides where one of its limits binds")
    dashboard.expect_accessible(dialog)
    dialog.get_by_text("FMI 3.0").click()
    page.route("**/fmus", lambda route: route.fulfill(body=b"an FMU"))
    with page.expect_request("**/fmus") as asked:
        saved = dashboard.downloaded(dialog.get_by_role("button", name="Export"))
    body = asked.value.post_data_json
    assert isinstance(body, dict)
    assert (body["of"], body["version"]) == ("vehicle", "3.0")
    assert (saved.suggested_filename, saved.path().read_bytes()) == ("ridelab-vehicle.fmu", b"an FMU")


def pasted(command: str) -> str:
    """What the command prints in a shell with this environment's programs."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    return subprocess.check_output(["sh", "-c", command], cwd=ROOT, env=os.environ | {"PATH": path}, text=True)


@pytest.mark.thorough
def test_copied_commands_give_the_same_run(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    dashboard.edit("Height", "-6")
    dashboard.edit("Cruise, Body acceleration, value", "5")
    with dashboard.new_address():
        page.get_by_role("combobox", name="Shape").select_option("flat_top")
    with dashboard.clipboard() as copied:

        def command(item: str) -> str:
            page.get_by_role("button", name="Export").click()
            page.get_by_role("menuitem", name=item).click()
            expect(page.get_by_role("menuitem", name=item)).to_be_hidden()
            return copied()

        assert json.loads(pasted(command("Copy as curl")))["id"] == dashboard.run_id
        assert json.loads(pasted(f"{command('Copy as command line')} --json"))["id"] == dashboard.run_id
        script = command("Copy as Python")
        assert pasted(f"python -c '{script}\nprint(run.id)'").strip() == dashboard.run_id
