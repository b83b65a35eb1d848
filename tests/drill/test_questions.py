"""Every question at every size; the tests of the browser ask each at one."""

from itertools import product

import pytest

from tests.browser.dashboard import Dashboard
from tests.browser.questions import QUESTIONS, Question
from tests.browser.test_questions import SIZES, answered


@pytest.mark.parametrize(("question", "size"), list(product(QUESTIONS, SIZES)))
def test_a_question_is_answered_at_every_size(dashboard: Dashboard, question: Question, size: tuple[int, int]) -> None:
    answered(dashboard, question, size)
