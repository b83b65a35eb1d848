"""The questions that the dashboard answers, each at every size."""

from itertools import product

import pytest

from tests.browser.dashboard import Dashboard
from tests.browser.questions import QUESTIONS, Question

SIZES = ((1440, 900), (1024, 768), (390, 844))


def answered(dashboard: Dashboard, question: Question, size: tuple[int, int]) -> None:
    """The page answers it at that size, accessible in both schemes and no wider than the window."""
    width, height = size
    dashboard.page.set_viewport_size({"width": width, "height": height})
    question(dashboard)
    dashboard.expect_accessible()
    dashboard.expect_no_wider(width)


@pytest.mark.parametrize(("question", "size"), list(product(QUESTIONS, SIZES)))
def test_a_question_is_answered_at_every_size(dashboard: Dashboard, question: Question, size: tuple[int, int]) -> None:
    answered(dashboard, question, size)
