"""The page as a person uses it: names for what they look at and do."""

import json
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from re import Pattern
from typing import Any, Literal, overload

from playwright.sync_api import ConsoleMessage, Download, Error, Locator, Mouse, Page, Response, Route, ViewportSize
from playwright.sync_api import expect as expect_with_tree

from tests.servers.process import ROOT, request
from tests.there import there

HANG_TIMEOUT_MS = 120_000  # of a look at the page: a wrong expectation waits as long as one that hangs
expect_with_tree.set_options(timeout=HANG_TIMEOUT_MS)
Text = str | Pattern[str] | list[str] | list[Pattern[str]]


class LocatorLooks:
    """What is waited for in a part of the page; what is not here is Playwright's own.

    Playwright's own writes the page's whole tree into its message at every look that fails, an eighth of a second of a
    core each. A text, an attribute or that something is there needs no such message.
    """

    def __init__(self, locator: Locator) -> None:
        self._locator = locator

    def __getattr__(self, name: str) -> Callable[..., None]:
        matcher: Callable[..., None] = getattr(expect_with_tree(self._locator), name)
        return matcher

    def to_be_visible(self) -> None:
        self._locator.wait_for(timeout=HANG_TIMEOUT_MS)

    def to_be_hidden(self) -> None:
        self._locator.wait_for(state="hidden", timeout=HANG_TIMEOUT_MS)

    def to_be_attached(self) -> None:
        self._locator.wait_for(state="attached", timeout=HANG_TIMEOUT_MS)

    def to_contain_text(self, text: Text) -> None:
        if isinstance(text, list):
            expect_with_tree(self._locator).to_contain_text(text)
        else:  # by a pattern: for a list of one text it is enough that one of several elements contains it
            pattern = re.compile(r"\s+".join(map(re.escape, text.split()))) if isinstance(text, str) else text
            self.to_have_text(pattern)

    def to_have_text(self, text: Text, *, use_inner_text: bool = False) -> None:
        texts = text if isinstance(text, list) else [text]  # of a list no tree is written
        expect_with_tree(self._locator).to_have_text(texts, use_inner_text=use_inner_text)

    def to_have_attribute(self, name: str, value: str | Pattern[str]) -> None:
        if isinstance(value, str):
            same = self._locator.page.locator(f"[{name}={json.dumps(value, ensure_ascii=False)}]")
            self._locator.and_(same).wait_for(state="attached", timeout=HANG_TIMEOUT_MS)
        else:
            expect_with_tree(self._locator).to_have_attribute(name, value)


class PageLooks:
    """What is waited for of a page as a whole."""

    def __init__(self, page: Page) -> None:
        self._page = page

    def to_have_url(self, url: str | Pattern[str]) -> None:
        self._wait(lambda now: now == url if isinstance(url, str) else url.search(now) is not None)

    def not_to_have_url(self, url: str | Pattern[str]) -> None:
        self._wait(lambda now: now != url if isinstance(url, str) else url.search(now) is None)

    def to_have_title(self, title: str | Pattern[str]) -> None:
        expect_with_tree(self._page).to_have_title(title)

    def _wait(self, condition: Callable[[str], bool]) -> None:
        self._page.wait_for_url(condition, wait_until="commit", timeout=HANG_TIMEOUT_MS)


@overload
def expect(part: Locator) -> LocatorLooks: ...
@overload
def expect(part: Page) -> PageLooks: ...
def expect(part: Locator | Page) -> LocatorLooks | PageLooks:
    """Waits for what is asked of the answer."""
    return PageLooks(part) if isinstance(part, Page) else LocatorLooks(part)


AXE = ROOT / "frontend/node_modules/axe-core/axe.min.js"
LAPTOP: ViewportSize = {"width": 1440, "height": 900}
Scheme = Literal["light", "dark"]
# In the dark other colours are all that can be wrong beside.
RULES: dict[Scheme, list[str]] = {"light": ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa"], "dark": ["color-contrast"]}
# Of a whole page: what somebody who does not see it goes by.
STRUCTURE = ["heading-order", "landmark-unique", "landmark-no-duplicate-main", "landmark-one-main"]
THOROUGH = "THOROUGH" in os.environ  # of all pages in the dark too, what Plotly draws and every row of a table
SELDOM = [".main-svg", "tbody tr:nth-child(n + 5)"]
TOUR_SEEN = "try { localStorage['ridelab.tour'] = 'true' } catch {}"  # an empty page stores nothing
REFUSE_COPYING = """
Object.defineProperty(navigator, 'clipboard', {value: undefined});
document.execCommand = () => false;
"""
DROP = """files => {
  const dataTransfer = new DataTransfer();
  for (const [name, text] of Object.entries(files)) dataTransfer.items.add(new File([text], name));
  for (const type of ['dragover', 'drop'])
    document.querySelector('main').dispatchEvent(new DragEvent(type, {dataTransfer, bubbles: true, cancelable: true}));
}"""
WINDOWS = {"rough_road": "rms", "bump": "peak"}


class Dashboard:
    """One open page."""

    def __init__(self, page: Page, url: str) -> None:
        self.page = page
        self.url = url
        self.failures: list[str] = []
        page.set_default_timeout(HANG_TIMEOUT_MS)
        page.on("pageerror", self._fail)
        page.on("console", self._listen)

    def _fail(self, error: Error) -> None:
        self.failures.append(str(error))

    def _listen(self, message: ConsoleMessage) -> None:
        # A refused or missing request is written to the console by the browser itself.
        if message.type == "error" and "Failed to load resource" not in message.text:
            self.failures.append(message.text)

    def forget(self) -> None:
        """Leaves the page and all that is stored of it."""
        self.page.goto("/favicon.svg")  # of the same origin: for an empty page the browser would take another process
        self.page.evaluate("localStorage.clear(); sessionStorage.clear()")

    def leave(self) -> None:
        """Leaves the tab as a new one would be: nothing stored, caught or pressed, no page that still asks for more."""
        page = self.page
        try:
            page.unroute_all(behavior="ignoreErrors")
            self.forget()
            page.set_viewport_size(LAPTOP)
            page.emulate_media(media="null", color_scheme="light", reduced_motion="reduce")
            page.mouse.up()
            page.mouse.move(0, 0)
            page.remove_listener("pageerror", self._fail)
            page.remove_listener("console", self._listen)
        except Error:
            page.close()  # the next test gets another one
            raise

    def open(self, path: str = "/") -> None:
        """Opens an address and waits for the first curves."""
        self.page.goto(path)
        self.expect_curves()

    def expect_curves(self) -> None:
        """Waits for a stored run's curves, tables and tools; whatever address named another run names this one by then.

        Without `expect`, which writes down the whole page for its message at every look: a quarter of a second each.
        """
        self.page.locator("canvas[data-drawn]").first.wait_for()
        exact = self.page.locator("[data-testid=results][data-source=exact]:not([data-stale=true])")
        exact.locator("table").first.wait_for()
        self.page.locator("header").get_by_role("button", name="Export").wait_for()

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

    def toggle(self, name: str) -> None:
        """Switches a strategy on or off in the menu that has all of them."""
        self.page.get_by_role("button", name="Strategies").click()
        self.page.get_by_role("menuitemcheckbox", name=name).click()
        self.page.keyboard.press("Escape")

    def row(self, strategy: str) -> Locator:
        return self.results.locator(f"tr[data-strategy={strategy}]").first

    def type_into(self, name: str, text: str) -> None:
        self.entry(name).fill(text)
        self.entry(name).press("Enter")

    @contextmanager
    def new_address(self) -> Iterator[None]:
        """After what is done within it, wait until the page has another run's address, and shows that run."""
        address = self.address()
        yield
        expect_new_address(self.page, address)
        self.expect_curves()

    def edit(self, name: str, text: str) -> None:
        """Type a value and wait for its run."""
        with self.new_address():
            self.type_into(name, text)

    @contextmanager
    def clipboard(self) -> Iterator[Callable[[], str]]:
        """Within it the page may copy, and what it copied can be asked for."""
        self.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        try:
            yield lambda: str(self.page.evaluate("navigator.clipboard.readText()"))
        finally:
            self.page.context.clear_permissions()

    def downloaded(self, button: Locator) -> Download:
        """What a click on it saves."""
        with self.page.expect_download() as download:
            button.click()
        return download.value

    def exported(self, name: str) -> Download:
        """The file of an item in the menu Export."""
        self.page.get_by_role("button", name="Export", exact=True).click()
        return self.downloaded(self.page.get_by_role("menuitem", name=name))

    def stored_run(self) -> Any:
        """The run the address names, as the API has it."""
        answer = request("GET", f"{self.url}/api/v1/runs/{self.run_id}")
        return answer.raise_for_status().json()

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

    def curves(self) -> list[str]:
        """Every panel on the screen, as it is drawn, in steps of an eighth of a colour's range."""
        pictures: list[str] = self.results.locator("canvas[data-drawn]").evaluate_all(
            """panels => panels.map(panel => {
              const {data} = panel.getContext('2d').getImageData(0, 0, panel.width, panel.height);
              return data.map(value => Math.round(value / 32)).join('');
            })"""
        )
        return pictures

    def panel(self, signal: str) -> Locator:
        """The canvas of a figure; `data-drawn` says how many curves are on it."""
        return self.page.locator(f"section[data-figure={signal}] canvas")

    def drop(self, files: Mapping[str, str]) -> None:
        """Drops files with these contents on the page."""
        self.page.evaluate(DROP, files)

    def address(self) -> str:
        """What the address bar shows now; `page.url` learns of a change a moment later."""
        return str(self.page.evaluate("location.href"))

    @contextmanager
    def held(self, pattern: str) -> Iterator[None]:
        """Within it the answers to such requests are on their way and do not come."""
        waiting: list[Route] = []
        self.page.route(pattern, lambda route: waiting.append(route))
        yield
        for route in waiting:
            route.continue_()
        self.page.unroute(pattern)

    def expect_no_wider(self, *widths: int) -> None:
        """Nothing of the page as it stands is wider than a window so wide [px]."""
        for width in widths:
            self.page.set_viewport_size({"width": width, "height": 860})
            self.page.wait_for_function(
                "width => innerWidth === width && document.documentElement.scrollWidth <= width", arg=width
            )

    def saved_figure(self, title: str, name: str) -> bytes:
        """A figure's file, by the button in its menu."""
        self.page.get_by_role("button", name=f"Save figure: {title}").click()
        menu = self.page.get_by_role("dialog", name=f"Save figure: {title}")
        saved = self.downloaded(menu.get_by_role("button", name=name))
        expect(menu).to_be_hidden()
        return saved.path().read_bytes()

    def expect_accessible(self, part: Locator | None = None, *, in_the_dark: bool = THOROUGH) -> None:
        """Axe-core finds no serious violation of WCAG 2.1 A and AA.

        Args:
            part: Of the page, where another test looks at the rest of it.
            in_the_dark: There too; where colours are the same variables as elsewhere, by `make drill`.
        """
        for scheme, rules in RULES.items():
            if scheme == "dark" and not in_the_dark:
                continue
            self.page.emulate_media(color_scheme=scheme)
            expect(self.page.locator("html")).to_have_attribute("data-mantine-color-scheme", scheme)
            structure = STRUCTURE if part is None and scheme == "light" else []
            violated = violations(part or self.page.locator("html"), rules, structure)
            serious = [text for impact, text in violated if impact in ("serious", "critical") or text[0] in structure]
            assert serious == [], f"{scheme}: {serious}"
        self.page.emulate_media(color_scheme="light")

    def drag(self, slider: Locator, steps: tuple[int, ...]) -> list[Response]:
        """Drags a slider's thumb through offsets [px], waiting for live curves at each; returns the live answers."""
        answers: list[Response] = []
        x, y = thumb(slider)
        with self.held_at(x, y) as mouse:
            for step in steps:
                with self.page.expect_response("**/api/v1/live") as answer:
                    mouse.move(x + step, y, steps=3)
                answers.append(answer.value)
            expect(self.results).to_have_attribute("data-source", "live")
        return answers

    @contextmanager
    def held_at(self, x: float, y: float) -> Iterator[Mouse]:
        """The mouse with its button pressed there, until the end of the block."""
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        yield mouse
        mouse.up()


def thumb(slider: Locator) -> tuple[float, float]:
    """The middle of a slider's thumb in the window [px]; the thumb is as wide as the slider is high."""
    place: tuple[float, float] = slider.evaluate(
        """slider => {
          const {x, y, width, height} = slider.getBoundingClientRect();
          const part = (slider.value - slider.min) / (slider.max - slider.min);
          return [x + height / 2 + part * (width - height), y + height / 2];
        }"""
    )
    return place


def expect_new_address(page: Page, address: str) -> None:
    """Waits until the page has another address; without `expect`, as `expect_curves` does."""
    page.wait_for_url(lambda url: url != address, wait_until="commit")


def violations(part: Locator, rules: list[str], more: Sequence[str] = ()) -> list[tuple[str, list[str]]]:
    """What axe-core finds against these groups of rules, and more rules: impact, and the rule with its elements."""
    page = part.page
    if not page.evaluate("Boolean(window.axe)"):
        page.evaluate(AXE.read_text())  # by the debugger, which a page's policy does not bind
    found: list[tuple[str, list[str]]] = part.evaluate(
        """async (part, [runOnly, more, exclude]) => {
          await new Promise(requestAnimationFrame);  // by then colours that fade have begun to
          const fading = document.getAnimations().filter(({effect}) => effect.getComputedTiming().endTime < Infinity);
          await Promise.allSettled(fading.map(({finished}) => finished));
          const rules = Object.fromEntries(more.map(rule => [rule, {enabled: true}]));
          const what = {include: [part], exclude};
          const {violations} = await axe.run(what, {runOnly, rules, resultTypes: ['violations'], preload: false});
          return violations.map(({id, impact, nodes}) =>
            [impact, [id, ...nodes.slice(0, 3).map(({html}) => html.slice(0, 160))]]);
        }""",
        [rules, more, [] if THOROUGH else SELDOM],
    )
    return found


def centre(part: Locator) -> tuple[float, float, float]:
    """The centre of a part of the page and its width [px], scrolled to."""
    part.scroll_into_view_if_needed()
    box = there(part.bounding_box())
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, box["width"]
