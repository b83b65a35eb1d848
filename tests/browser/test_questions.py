"""One of the questions, on a phone; `make drill` asks all of them at three sizes."""

from tests.browser.dashboard import Dashboard
from tests.browser.questions import Question, what_got_better

SIZES = ((1440, 900), (1024, 768), (390, 844))


def answered(dashboard: Dashboard, question: Question, size: tuple[int, int]) -> None:
    """The page answers it at that size, accessible in both schemes and no wider than the window."""
    width, height = size
    dashboard.page.set_viewport_size({"width": width, "height": height})
    question(dashboard)
    dashboard.expect_accessible()
    dashboard.expect_no_wider(width)


def test_what_got_better_is_answered_on_a_phone(dashboard: Dashboard) -> None:
    answered(dashboard, what_got_better, SIZES[2])
