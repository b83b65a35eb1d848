"""A service with tokens: the page asks once, then all works, event streams included, until somebody logs out."""

from pathlib import Path

from playwright.sync_api import Browser

from tests.browser.dashboard import Dashboard, expect
from tests.servers.process import Api, request

TOKEN = "ann-0123456789abcdef"  # noqa: S105  # nobody's


def test_the_page_asks_for_a_token_once(browser: Browser, tmp_path: Path) -> None:
    tokens = tmp_path / "tokens"
    tokens.write_text(f"ann {TOKEN}\n")
    limits = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1", "RIDELAB_TOKENS_FILE": str(tokens)}
    with Api(tmp_path, **limits) as api, browser.new_context(base_url=api.url, reduced_motion="reduce") as context:
        api.wait_until_ready()
        dashboard = Dashboard(context.new_page(), api.url)
        page = dashboard.page
        page.route("**/assets/Login-*", lambda route: route.abort())  # gone with an update of the server
        page.goto("/")
        expect(page.get_by_role("dialog", name="This part of the page could not be shown")).to_be_visible()
        page.unroute("**/assets/Login-*")
        page.get_by_role("button", name="Load again").click()
        dashboard.failures.clear()  # the browser and React write a missing file to the console
        expect(page.get_by_role("heading", name="Ridelab asks for a token")).to_be_visible()
        page.get_by_label("Token").fill("not the one")
        page.get_by_role("button", name="Log in").click()
        expect(page.get_by_text("This is none of the service's tokens.")).to_be_visible()
        page.get_by_label("Token").fill(TOKEN)
        page.get_by_role("button", name="Log in").click()
        dashboard.expect_curves()
        assert page.evaluate("document.cookie") == "", "no script reads it"

        body = {"scenario": {}, "strategies": ["passive"], "sweep": {"grid": {"road.seed": [1, 2]}}}
        accepted = request("POST", f"{api.url}/api/v1/batches", json=body, headers={"Authorization": f"Bearer {TOKEN}"})
        page.goto(f"/b/{accepted.json()['id']}")
        expect(page.get_by_text("done", exact=False).first).to_be_visible()

        page.get_by_role("button", name="Log out ann").click()
        expect(page.get_by_role("heading", name="Ridelab asks for a token")).to_be_visible()
        page.reload()
        expect(page.get_by_role("heading", name="Ridelab asks for a token")).to_be_visible()
        assert dashboard.failures == []
        assert not any(secret in api.log for secret in (TOKEN, "not the one", "not%20the%20one"))
