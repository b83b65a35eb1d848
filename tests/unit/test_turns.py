"""Turns: one at a time, in order, and what is ahead before the rest."""

import asyncio

from backend.paper.turns import Turns
from tests.servers import loops


async def _work(turns: Turns, key: str, parts: int, done: list[str]) -> None:
    for _ in range(parts):
        async with turns.turn(key):
            assert not done or done[-1] != "begun", "two at once"
            done.append("begun")
            await asyncio.sleep(0)
            done[-1] = key


def test_turns_alternate_and_what_is_ahead_goes_first() -> None:
    async def main() -> list[str]:
        turns, done = Turns(), list[str]()
        await asyncio.gather(*(_work(turns, key, 2, done) for key in "ab"))
        rest = [asyncio.create_task(_work(turns, key, 3, done)) for key in "cd"]
        while done[-1] != "c":
            await asyncio.sleep(0)
        with turns.ahead("e"), turns.ahead("f"):
            await asyncio.gather(*(_work(turns, key, 2, done) for key in "ef"))
            await asyncio.sleep(0.01)
            assert not any(task.done() for task in rest), "nothing else begins while something is ahead"
        await asyncio.gather(*rest)
        return done

    order = "".join(loops.run(main))
    assert order[:5] == "ababc"
    assert order[5] in "de", "a turn that was begun is ended"
    assert order.replace("d", "").replace("c", "")[4:] == "efef"
    assert order.index("e") <= 6
    assert sorted(order) == sorted("aabb" + "cccddd" + "eeff")


def test_what_joins_later_may_be_put_ahead() -> None:
    async def main() -> list[str]:
        turns, done = Turns(), list[str]()
        tasks = [asyncio.create_task(_work(turns, key, 2, done)) for key in "abc"]
        await asyncio.sleep(0)
        with turns.ahead("c"):
            await tasks[2]
        await asyncio.gather(*tasks)
        return done

    assert "".join(loops.run(main)) in ("accbab", "accabb", "accbba")


def test_what_is_called_off_gives_its_turn_away() -> None:
    async def main() -> list[str]:
        turns, done = Turns(), list[str]()
        async with turns.turn("held"):
            waiting = [asyncio.create_task(_work(turns, key, 1, done)) for key in "abc"]
            await asyncio.sleep(0)
            waiting[0].cancel()  # waits
        waiting[1].cancel()  # was given the turn and has not yet begun
        await asyncio.gather(*waiting, return_exceptions=True)
        return done

    assert loops.run(main) == ["c"]
