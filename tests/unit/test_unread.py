"""Whose connection ends where too much waits to be read."""

from dataclasses import dataclass, field

from backend.http.unread import UnreadAnswers


@dataclass(eq=False)
class Fake:
    """One connection with a slow reader."""

    reader: str
    unread: int
    ended: bool = field(default=False, init=False)

    def cut_off(self) -> None:
        self.ended = True


def ended(*connections: Fake) -> list[bool]:
    unread = UnreadAnswers(100)
    for each in connections:
        unread.add(each)
    return [each.ended for each in connections]


def test_the_client_for_which_most_waits_loses_its_oldest() -> None:
    assert ended(Fake("one", 30), Fake("other", 35), Fake("one", 30)) == [False] * 3
    assert ended(Fake("other", 35), Fake("one", 30), Fake("one", 30), Fake("third", 6)) == [False, True, False, False]
    assert ended(Fake("one", 60), Fake("other", 50)) == [True, False]


def test_a_long_answer_alone_is_read_to_its_end() -> None:
    assert ended(Fake("one", 500)) == [False]
    assert ended(Fake("one", 500), Fake("other", 1)) == [True, False]


def test_who_has_caught_up_does_not_count() -> None:
    unread, first, second = UnreadAnswers(100), Fake("one", 90), Fake("one", 90)
    unread.add(first)
    unread.remove(first)
    unread.add(second)
    assert not second.ended
