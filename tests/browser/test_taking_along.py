"""What somebody takes along: commands that give the same run elsewhere, files, paper."""

import json
import os
import re
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, Route, expect

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


def test_files_of_every_kind(dashboard: Dashboard) -> None:
    """A pin's name is a text in a drawing, also one that looks like a link."""
    dashboard.open()
    page, first = dashboard.page, dashboard.address()
    page.get_by_role("region", name="Comparison").get_by_role("button", name="Pin", exact=True).click()
    page.get_by_role("button", name="Paper’s scenario").click()
    page.get_by_label("Name").fill('<a href="//other">x')
    page.get_by_label("Name").press("Enter")
    page.keyboard.press("Escape")
    dashboard.type_into("Height", "12")
    expect_new_address(page, first)
    dashboard.expect_curves()
    expect(page.locator("[data-pinned]").first).to_be_visible()
    names = {
        "LV control as CSV": "csv",
        "LV control as Parquet": "parquet",
        "PNG picture": "png",
        "SVG drawing": "svg",
    }
    files: dict[str, bytes] = {}
    for name, suffix in names.items():
        page.get_by_role("button", name="Export").click()
        with page.expect_download() as download:
            page.get_by_role("menuitem", name=name).click()
        files[suffix] = download.value.path().read_bytes()
        assert download.value.suggested_filename.startswith(f"ridelab-{dashboard.run_id}")
        assert download.value.suggested_filename.endswith(suffix)
    assert min(map(len, files.values())) > 50_000
    assert files["csv"].startswith(b"time [s],position [m],speed [m/s]")
    assert files["parquet"][:4] == b"PAR1"
    assert files["png"][:4] == b"\x89PNG"
    assert dashboard.run_id in files["svg"].decode()
    drawings = [files["svg"]]

    page.get_by_role("button", name="Save figure: Body acceleration").click()
    menu = page.get_by_role("dialog", name="Save figure: Body acceleration")
    menu.get_by_text("180 mm").click()
    for name in ("PNG, 300 dpi", "SVG", "CSV"):
        if not menu.is_visible():
            page.get_by_role("button", name="Save figure: Body acceleration").click()
        with page.expect_download() as download:
            menu.get_by_role("button", name=name).click()
        suffix = download.value.suggested_filename.rpartition(".")[2]
        files[suffix] = download.value.path().read_bytes()
        assert download.value.suggested_filename == f"ridelab-{dashboard.run_id}-body_acceleration.{suffix}"
        expect(menu).to_be_hidden()
    assert int.from_bytes(files["png"][16:20]) == pytest.approx(180 / 25.4 * 300, abs=4), "pixels"
    assert re.match(r'<svg width="180mm" height="\d+mm"', files["svg"].decode())
    for drawing in (*drawings, files["svg"]):
        assert b"<a " not in drawing
        assert b'LV control, &#60;a href="//other"' in drawing
    assert f"# run: {dashboard.run_id}\n" in files["csv"].decode()
    assert "LV control: position [m],LV control: Body acceleration [m/s²]" in files["csv"].decode()


def test_every_plot_is_drawn_on_paper(dashboard: Dashboard, tmp_path: Path) -> None:
    """The browser fires its events around printing: panels nobody has scrolled to are drawn for them."""
    dashboard.open()
    page = dashboard.page
    page.evaluate(
        """() => window.addEventListener('afterprint', () => {
          window.printed = [...document.querySelectorAll('section[data-figure]')]
            .map(panel => Number(panel.querySelector('canvas').dataset.drawn));
        })"""
    )
    page.pdf(path=tmp_path / "page.pdf", prefer_css_page_size=True)
    drawn = page.evaluate("window.printed")
    assert len(drawn) > 6
    assert min(drawn) == 3
    # The car and the road, the paper's four signals, the tables, what the other panels show: none is lost or torn.
    pages = re.findall(rb"/Type /Page\b", (tmp_path / "page.pdf").read_bytes())
    assert len(pages) == 4
    page.emulate_media(media="print")
    expect(page.get_by_role("button", name="Share")).to_be_hidden()
    expect(page.get_by_text(dashboard.run_id)).to_be_visible()
    page.emulate_media(media="screen")


def test_a_controller_or_the_vehicle_leaves_as_an_fmu(dashboard: Dashboard, tmp_path: Path) -> None:
    page = dashboard.page
    dashboard.open()
    page.get_by_role("button", name="Export").click()
    page.get_by_role("menuitem", name="FMU…").click()
    dialog = page.get_by_role("dialog", name="Export an FMU")
    dialog.get_by_role("combobox", name="What").click()
    page.get_by_role("option", name="Single suspension control").click()
    dialog.get_by_role("button", name="Export").click()
    expect(dialog.get_by_role("alert")).to_contain_text("a QP decides where one of its limits binds")
    dashboard.expect_accessible(dialog)
    dialog.get_by_role("combobox", name="What").click()
    page.get_by_role("option", name="The vehicle").click()
    dialog.get_by_text("FMI 3.0").click()
    page.route("**/fmus", for_linux_alone)
    with page.expect_download() as download:
        dialog.get_by_role("button", name="Export").click()
    download.value.save_as(tmp_path / "vehicle.fmu")
    assert download.value.suggested_filename == "ridelab-vehicle.fmu"
    with zipfile.ZipFile(tmp_path / "vehicle.fmu") as archive:
        assert "binaries/x86_64-linux/ridelab_vehicle.so" in archive.namelist()


def for_linux_alone(route: Route) -> None:
    """The first program for another system takes a minute."""
    body = route.request.post_data_json
    assert isinstance(body, dict)
    route.continue_(post_data=json.dumps({**body, "platforms": ["linux64"]}))
