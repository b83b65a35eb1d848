"""The page as a person uses it: names for what they look at and do."""

from typing import Any

import httpx
from playwright.sync_api import Locator, Page, Response, expect

from tests.browser.server import ROOT

AXE = ROOT / "frontend/node_modules/axe-core/axe.min.js"
WINDOWS = {"rough_road": "rms", "bump": "peak"}


class Dashboard:
    """One open page."""

    def __init__(self, page: Page, url: str) -> None:
        self.page = page
        self.url = url
        self.failures: list[str] = []
        page.on("pageerror", lambda error: self.failures.append(str(error)))
        page.on("console", lambda message: self._listen(message.type, message.text))

    def _listen(self, kind: str, text: str) -> None:
        # A refused or missing request is written to the console by the browser itself.
        if kind == "error" and "Failed to load resource" not in text:
            self.failures.append(text)

    def open(self, path: str = "/") -> None:
        """Opens an address and waits for the first curves."""
        self.page.goto(path)
        self.expect_curves()

    def expect_curves(self) -> None:
        expect(self.page.locator(".scatterlayer .trace").first).to_be_visible()
        expect(self.results).to_have_attribute("data-source", "exact")

    @property
    def results(self) -> Locator:
        return self.page.get_by_test_id("results")

    @property
    def status(self) -> Locator:
        return self.page.get_by_test_id("status-header")

    @property
    def run_id(self) -> str:
        return self.page.url.split("/r/")[1].split("?")[0]

    def slider(self, name: str) -> Locator:
        return self.page.get_by_role("slider", name=name, exact=True)

    def entry(self, name: str) -> Locator:
        return self.page.get_by_role("textbox", name=name, exact=True)

    def chip(self, name: str) -> Locator:
        return self.page.get_by_role("group", name="Strategies").get_by_role("button", name=name)

    def row(self, strategy: str) -> Locator:
        return self.results.locator(f"tr[data-strategy={strategy}]").first

    def type_into(self, name: str, text: str) -> None:
        self.entry(name).fill(text)
        self.entry(name).press("Enter")

    def stored_run(self) -> dict[str, Any]:
        """The run the address names, as the API has it."""
        answer: dict[str, Any] = httpx.get(f"{self.url}/api/v1/runs/{self.run_id}").raise_for_status().json()
        return answer

    def shown_values(self) -> dict[str, float]:
        """`strategy window.signal.statistic` -> the table's unrounded value."""
        shown: dict[str, float] = self.results.evaluate(
            """results => Object.fromEntries([...results.querySelectorAll('tr[data-strategy] td[data-cell]')].map(
              cell => [cell.parentElement.dataset.strategy + ' ' + cell.dataset.cell, Number(cell.dataset.value)]))"""
        )
        return shown

    def expect_table_to_be_the_stored_run(self) -> None:
        """Every number of the comparison is the one the API gives for the address's run."""
        run = self.stored_run()
        expected = {
            f"{strategy} {window}.{signal}.{statistic}": result["metrics"][window][signal][statistic]
            for strategy, result in run["strategies"].items()
            for window, statistic in WINDOWS.items()
            for signal in ("body_acceleration", "pitch_acceleration", "front_tyre_load", "rear_tyre_load")
        }
        assert self.shown_values() == expected

    def expect_accessible(self) -> None:
        """Axe-core finds no serious violation of WCAG 2.1 A and AA on the page as it stands, in either scheme."""
        for scheme in ("light", "dark"):
            self.page.emulate_media(color_scheme=scheme, reduced_motion="reduce")  # no colours half way
            expect(self.page.locator("html")).to_have_attribute("data-mantine-color-scheme", scheme)
            self.page.evaluate(AXE.read_text())
            found = self.page.evaluate(
                """async () => (await axe.run(document, {runOnly: ['wcag2a', 'wcag2aa', 'wcag21aa']})).violations
                   .filter(({impact}) => impact === 'serious' || impact === 'critical')
                   .map(({id, nodes}) => [id, ...nodes.slice(0, 3).map(({html}) => html.slice(0, 160))].join(' | '))"""
            )
            assert found == [], scheme
        self.page.emulate_media(color_scheme="light")

    def drag(self, slider: Locator, steps: tuple[int, ...]) -> list[Response]:
        """Drags a slider's thumb through offsets [px], waiting for live curves at each; returns the live answers."""
        answers: list[Response] = []
        box = slider.bounding_box()
        assert box is not None
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        for step in steps:
            with self.page.expect_response("**/api/v1/live") as answer:
                mouse.move(x + step, y, steps=3)
            answers.append(answer.value)
        expect(self.results).to_have_attribute("data-source", "live")
        mouse.up()
        return answers
