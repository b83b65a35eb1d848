"""How large may it be: asked in the dialog, answered with a value that goes into the form."""

import re

import pytest

from tests.browser.dashboard import Dashboard, expect


@pytest.mark.thorough
def test_a_limit_is_asked_answered_and_put_into_the_form(dashboard: Dashboard) -> None:
    dashboard.open()
    page = dashboard.page
    page.get_by_role("button", name="How fast may it go: Body acceleration, bump").click()
    dialog = page.get_by_role("dialog", name=re.compile("How (fast may it go|large may it be)"))
    find, field = dialog.get_by_role("button", name="Find"), dialog.get_by_role("combobox", name="Field")
    find.click()
    expect(dialog.get_by_text("Enter the limit in m/s²")).to_be_visible()
    expect(dialog.get_by_role("combobox", name="Metric")).to_have_value("Body acceleration, peak, bump")
    dialog.get_by_role("combobox", name="Strategy").click()
    page.get_by_role("listbox").get_by_role("option", name="Passive", exact=True).click()
    expect(field).to_have_value("Initial speed")  # the one that this strategy uses
    field.click()
    page.get_by_role("listbox").get_by_role("option", name="Height", exact=True).click()
    dialog.get_by_label("From").fill("8")
    dialog.get_by_label("To", exact=True).fill("10")
    dialog.get_by_label("At most").fill("4 m/s²")
    find.click()
    expect(dialog.get_by_role("alert")).to_contain_text("No value tried from 8\u00a0cm to 10\u00a0cm keeps")
    dialog.get_by_label("From").fill("1")
    find.click()
    answer = dialog.get_by_role("status")
    expect(answer).to_contain_text("Height at most about 6.4\u00a0cm")
    expect(answer).to_contain_text("may be random variation")
    answer.get_by_role("button", name="Put it into the form").click()
    expect(dialog).not_to_be_visible()
    expect(dashboard.entry("Height")).to_have_value("6.467")
