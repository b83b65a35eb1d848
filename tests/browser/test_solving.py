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
    find = dialog.get_by_role("button", name="Find")
    find.click()
    expect(dialog.get_by_text("Enter the limit in m/s²")).to_be_visible()
    field = dialog.get_by_role("combobox", name="Field")
    expect(field).to_have_value("Target speed")
    expect(dialog.get_by_role("combobox", name="Metric")).to_have_value("Body acceleration, peak, bump")
    expect(dialog.get_by_label("At most")).not_to_have_value("")  # the limit that the chart shows
    dialog.get_by_label("From").fill("31")
    for name, asked in (("LQR", "Target speed"), ("Passive", "Initial speed")):
        dialog.get_by_role("combobox", name="Strategy").click()
        page.get_by_role("listbox").get_by_role("option", name=name, exact=True).click()
        expect(field).to_have_value(asked)
        expect(dialog.get_by_label("From")).to_have_value("31")
    field.click()
    page.get_by_role("listbox").get_by_role("option", name="Height", exact=True).click()
    dialog.get_by_label("From").fill("20")
    dialog.get_by_label("To", exact=True).fill("10")
    dialog.get_by_label("At most").fill("")
    find.click()
    expect(dialog.get_by_role("textbox", name="At most")).to_have_attribute("aria-invalid", "true")
    dialog.get_by_label("From").fill("8")
    dialog.get_by_role("combobox", name="Strategy").click()
    page.get_by_role("listbox").get_by_role("option", name="Passive", exact=True).click()
    dialog.get_by_label("At most").fill("4 m/s²")
    find.click()
    expect(dialog.get_by_role("alert")).to_contain_text("No value tried from 8\u00a0cm to 10\u00a0cm keeps")
    dialog.get_by_label("From").fill("1")
    find.click()
    answer = dialog.get_by_role("status")
    expect(answer).to_contain_text("Height at most about 6.4\u00a0cm")
    expect(answer).to_contain_text("at 6.467\u00a0cm; 6.468\u00a0cm does not keep the limit")
    expect(answer).to_contain_text(
        "On one road a change of Body acceleration, peak, bump below 7 % may be random variation; from 5.9"
    )
    answer.get_by_role("button", name="Put it into the form").click()
    expect(dialog).not_to_be_visible()
    expect(page.get_by_role("textbox", name="Height", exact=True)).to_have_value("6.467")
