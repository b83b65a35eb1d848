"""How the page opens: without a jump, and where nothing is; `make drill` has other windows and a login."""

from tests.browser.dashboard import Dashboard, expect

UNKNOWN = "A" * 22


def expect_steady(dashboard: Dashboard, width: int, height: int) -> None:
    """Cumulative layout shift is good up to 0.1; a table or a plot without its place kept is over that."""
    dashboard.page.set_viewport_size({"width": width, "height": height})
    dashboard.page.goto("/")
    expect(dashboard.results).to_be_visible()
    expect(dashboard.page.locator("section[data-figure]").first).to_be_attached()
    # What comes last.
    for part in (dashboard.page.get_by_test_id("verdict"), dashboard.page.get_by_role("group", name="Strategies")):
        expect(part).to_be_visible()
    expect(dashboard.page.get_by_role("region", name="The moving car")).to_be_visible()
    shift = dashboard.page.evaluate(
        """() => new Promise(done => {
          const told = new PerformanceObserver(list =>
            done(list.getEntriesByType('layout-shift').reduce((sum, {value}) => sum + value, 0)));
          // There always is a paint to tell of.
          for (const type of ['paint', 'layout-shift']) told.observe({type, buffered: true});
        })"""
    )
    assert shift < 0.05
    assert dashboard.page.evaluate("document.documentElement.scrollWidth") <= width


def test_on_a_phone_nothing_jumps_and_the_form_leaves_the_plots_in_sight(dashboard: Dashboard) -> None:
    expect_steady(dashboard, 390, 844)
    page = dashboard.page
    page.get_by_role("button", name="Edit scenario").click()
    expect(dashboard.slider("Height")).to_be_visible()
    box = page.get_by_role("dialog").bounding_box()
    assert box is not None
    assert box["y"] > 0.4 * 844


def test_what_is_not_there_is_said_beside_the_navigation(dashboard: Dashboard) -> None:
    """The statuses are the API's tests'."""
    page = dashboard.page
    for path, said in (
        ("/manual/nothing-here/", "There is no page at this address"),
        (f"/r/{UNKNOWN}", "There is no run at this address"),
        (f"/s/{UNKNOWN}", "There is no shared result at this address"),
        (f"/b/{UNKNOWN}", "There is no sweep at this address"),
        (f"/tuner/{UNKNOWN}", "There is no tuning at this address"),
        ("/paper?preview=sideways", "does not know"),
    ):
        page.goto(path)
        expect(page.get_by_text(said)).to_be_visible()
        expect(page.get_by_role("navigation", name="Pages").get_by_role("link", name="Lab")).to_be_visible()
