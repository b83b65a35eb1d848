"""`expect` of Playwright, whose looks at a busy page are cheap.

Playwright's own writes the page's whole tree into its message at every look that fails, an eighth of a second of a core
each. What most tests wait for, a text, an attribute, an address or that something is there, needs no such message.
"""

import json
import re
from collections.abc import Callable
from re import Pattern
from typing import overload

from playwright.sync_api import Locator, Page
from playwright.sync_api import expect as expect_with_tree

HANG_TIMEOUT_MS = 120_000  # of a look at the page: a wrong expectation waits as long as one that hangs
expect_with_tree.set_options(timeout=HANG_TIMEOUT_MS)
Text = str | Pattern[str] | list[str] | list[Pattern[str]]


class LocatorLooks:
    """What is waited for in a part of the page; what is not here is Playwright's own."""

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
