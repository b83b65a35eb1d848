"""A controller of one's own on the page: chosen, its option changed, its file saved anew and broken."""

from tests.api.own_laws import LAW
from tests.browser.dashboard import Dashboard, expect, expect_new_address
from tests.browser.server import Server


def test_a_saved_law_is_compared_with_before_and_a_broken_one_says_its_line(
    dashboard: Dashboard, server: Server
) -> None:
    page, file = dashboard.page, server.laws / "mine.py"
    file.write_text(LAW)
    try:
        dashboard.open()
        first = page.url
        search, unused = page.get_by_label("Find a field"), page.get_by_test_id("unused")
        search.fill("Deflection noise")
        expect(unused).to_have_text("No shown strategy uses this. Mine does.")  # without a filter, if it likes
        dashboard.toggle("Mine")
        expect(unused).to_have_count(0)
        search.fill("Skyhook damping")  # of which the service says that it does not read it
        expect(unused.first).to_have_text("No shown strategy uses this. Skyhook and Hybrid hook do.")
        search.fill("")
        expect_new_address(page, first)
        dashboard.expect_curves()
        dashboard.type_into("Damping", "4000")
        page.get_by_label("Change against").select_option("Before the last edit")
        cell = dashboard.row("mine").locator("td[data-cell='bump.body_acceleration.peak']")
        expect(cell).to_contain_text("%")
        edited = dashboard.stored_run()
        assert edited["scenario"]["own"] == {"mine": {"damping": 4000}}
        expect(dashboard.row("passive").locator("td[data-cell='bump.body_acceleration.peak']")).not_to_contain_text("▲")

        address = page.url
        file.write_text(LAW.replace("-self.damping * seen.state[4],", "-2 * self.damping * seen.state[4],"))
        expect_new_address(page, address)
        dashboard.expect_curves()
        saved = dashboard.stored_run()
        assert saved["scenario"] == edited["scenario"]
        bumps = [run["strategies"]["mine"]["metrics"]["bump"] for run in (edited, saved)]
        old, new = (each["body_acceleration"]["peak"] for each in bumps)
        expect(cell).to_contain_text(f"{abs(100 * (new / old - 1)):.1f}\u2009%")

        file.write_text(LAW.replace("return", "return 1 / 0 #"))
        expect(dashboard.row("mine")).to_contain_text("mine.py, line 12: ZeroDivisionError: division by zero")
        expect(page.get_by_role("alert")).to_have_count(1)
        page.set_viewport_size({"width": 390, "height": 844})
        column = page.get_by_role("columnheader", name="Mine").first
        expect(column).to_contain_text("mine.py, line 12: ZeroDivisionError: division by zero")
        expect(page.get_by_role("columnheader", name="Passive").first).to_be_visible()
    finally:
        file.unlink()
