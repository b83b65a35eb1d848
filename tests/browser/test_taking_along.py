"""What somebody takes along: files, figures, an FMU."""

import re

import pytest

from tests.browser.dashboard import Dashboard, expect, expect_new_address


@pytest.mark.thorough
def test_files_of_every_kind_and_an_fmu(dashboard: Dashboard) -> None:
    """A pin's name is a text in a drawing, also one that looks like a link."""
    dashboard.open()
    page = dashboard.page
    first = dashboard.address()
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
        "LV control as JSON": "json",
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
    assert files["json"].startswith(b'{"core_version"')
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
    page.route("**/fmus", lambda route: route.fulfill(body=b"an FMU"))
    with page.expect_request("**/fmus") as asked, page.expect_download() as download:
        dialog.get_by_role("button", name="Export").click()
    body = asked.value.post_data_json
    assert isinstance(body, dict)
    assert (body["of"], body["version"]) == ("vehicle", "3.0")
    assert download.value.suggested_filename == "ridelab-vehicle.fmu"
    assert download.value.path().read_bytes() == b"an FMU"
