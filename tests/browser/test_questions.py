"""Two of the questions, at two sizes; `make drill` asks all of them at three."""

import pytest

from tests.browser.dashboard import Dashboard
from tests.browser.questions import Question, my_van, what_got_better

SIZES = ((1440, 900), (1024, 768), (390, 844))


def answered(dashboard: Dashboard, question: Question, size: tuple[int, int]) -> None:
    """The page answers it at that size, accessible in both schemes and no wider than the window."""
    width, height = size
    dashboard.page.set_viewport_size({"width": width, "height": height})
    question(dashboard)
    dashboard.expect_accessible()
    dashboard.expect_no_wider(width)


@pytest.mark.parametrize(("question", "size"), [(what_got_better, SIZES[0]), (my_van, SIZES[2])])
def test_a_question_is_answered(dashboard: Dashboard, question: Question, size: tuple[int, int]) -> None:
    answered(dashboard, question, size)
