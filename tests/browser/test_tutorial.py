"""The first tutorial's numbered steps, done as its page says them: what is not on the screen fails.

The page says them in these forms, in any order within a step:

    type `VALUE` into **FIELD** · drag the slider below **FIELD** · choose *OPTION* beside **LIST** ·
    choose *OPTION* where it says *OPTION* · click **BUTTON** · press KEY · the page says *TEXT* ·
    **FIELD or STRATEGY** shows `VALUE`
"""

import re
from collections.abc import Callable, Mapping

from tests.browser.dashboard import Dashboard, expect, expect_new_address
from tests.servers.process import ROOT

PAGE = ROOT / "docs/tutorials/first-quarter-of-an-hour.md"
STEP = re.compile(r"^\d+\. (.*(?:\n {3}.*)*)", re.MULTILINE)
BOLD = re.compile(r"\*\*([^*]+)\*\*")


def type_into(dashboard: Dashboard, value: str, field: str) -> None:
    dashboard.entry(field).fill(value)


def drag(dashboard: Dashboard, field: str) -> None:
    address = dashboard.address()
    dashboard.slider(field).press("ArrowRight")
    expect_new_address(dashboard.page, address)


def choose(dashboard: Dashboard, option: str, label: str) -> None:
    region = dashboard.page.get_by_role("region", name="Comparison", exact=True)
    region.get_by_role("combobox", name=label, exact=True).select_option(label=option)


def choose_instead(dashboard: Dashboard, option: str, shown: str) -> None:
    lists = dashboard.page.locator("select:visible").filter(
        has=dashboard.page.get_by_role("option", name=shown, exact=True)
    )
    expect(lists).to_have_count(1)
    expect(lists.locator("option:checked")).to_have_text(shown)
    lists.select_option(label=option)


def click(dashboard: Dashboard, button: str) -> None:
    dashboard.page.get_by_role("button", name=button, exact=True).click()


def press(dashboard: Dashboard, key: str) -> None:
    modifier, _, letter = key.partition("+")
    dashboard.page.keyboard.press(f"Control+{letter.lower()}" if letter else modifier)


def shows(dashboard: Dashboard, name: str, value: str) -> None:
    entry = dashboard.entry(name)
    if entry.count():
        expect(entry).to_have_value(value)
        return
    row = dashboard.results.get_by_role("row").filter(
        has=dashboard.page.get_by_role("rowheader", name=re.compile(f"^{name}"))
    )
    text = r"\s+".join(map(re.escape, value.split()))
    end = r"(?!\d)" if value[-1].isdigit() else ""
    expect(row.first).to_have_text(re.compile(rf"(?<![\d.]){text}{end}"))


def says(dashboard: Dashboard, text: str) -> None:
    expect(dashboard.page.get_by_text(text).first).to_be_visible()


FORMS: Mapping[str, Callable[..., None]] = {
    r"[Tt]ype `([^`]+)` into \*\*([^*]+)\*\*": type_into,
    r"[Dd]rag the slider below \*\*([^*]+)\*\*": drag,
    r"[Cc]hoose \*([^*]+)\* beside \*\*([^*]+)\*\*": choose,
    r"[Cc]hoose \*([^*]+)\* where it says \*([^*]+)\*": choose_instead,
    r"[Cc]lick \*\*([^*]+)\*\*": click,
    r"[Pp]ress (Enter|Escape|Ctrl\+\w)": press,
    r"[Tt]he page says \*([^*]+)\*": says,
    r"\*\*([^*]+)\*\* (?:now )?shows `([^`]+)`": shows,
}


def actions(step: str) -> list[tuple[Callable[..., None], tuple[str, ...]]]:
    """Return what a step does and sees, in its order; every name in bold belongs to one of these."""
    found = [(match, act) for form, act in FORMS.items() for match in re.finditer(form, step)]
    found.sort(key=lambda each: each[0].start())
    names = [name for match, _ in found for name in BOLD.findall(match[0])]
    assert names == BOLD.findall(step), step
    return [(act, match.groups()) for match, act in found]


def test_the_first_tutorial_can_be_followed_as_it_is_written(dashboard: Dashboard) -> None:
    text = PAGE.read_text(encoding="utf-8")
    dashboard.open()
    for name in BOLD.findall(STEP.sub("", text)):  # what the page names beside its steps
        expect(dashboard.page.get_by_text(name, exact=True).first).to_be_visible()
    steps = [" ".join(step.split()) for step in STEP.findall(text)]
    done = [act for step in steps for act, _ in actions(step)]
    assert {*done} == {*FORMS.values()}
    for step in steps:
        for act, words in actions(step):
            act(dashboard, *words)
