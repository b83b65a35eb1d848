"""Whoever follows a job is woken when it changes, and by nothing else."""

import asyncio
import threading

from backend.db.commits import Commits, Follower
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT


async def woken(follower: Follower) -> bool:
    """Whether it was told of a change."""
    waiting = asyncio.create_task(follower.wait(HANG_TIMEOUT))
    done, _ = await asyncio.wait({waiting}, timeout=0.05)
    waiting.cancel()
    return bool(done)


def test_a_change_wakes_those_who_follow_that_job_and_those_who_follow_all() -> None:
    async def work() -> None:
        commits = Commits()
        with commits.following("a") as mine, commits.following("b") as other, commits.following() as every:
            thread = threading.Thread(target=commits.notify, args=("a",))
            thread.start()
            await asyncio.to_thread(thread.join)
            assert [await woken(each) for each in (mine, other, every)] == [True, False, True]
            mine.clear()
            assert not await woken(mine)
            commits.notify("c", "a")
            assert [await woken(each) for each in (mine, other)] == [True, False]
        commits.notify("a")
        with commits.following("a") as late:
            assert not await woken(late)

    loops.run(work)


def test_a_change_between_a_look_and_the_wait_for_news_is_not_lost() -> None:
    async def work() -> None:
        commits = Commits()
        with commits.following("a") as follower:
            follower.clear()
            commits.notify("a")
            await follower.wait(HANG_TIMEOUT)

    loops.run(work)
