"""The drive by the clock: what counts as in time."""

import time
from typing import Any, cast

import numpy as np

from backend.ecu.link import ProcessEcu
from backend.ecu.realtime import PacedEcu, Timing
from sim_core.ecu.interface import Frame, Reply

REPLY = Reply(commands=(1, 2), limited=False, iterations=0, unfinished=False, slack=0.0)
STEP = 0.02


class Link:
    """Answers every frame, after so long."""

    def __init__(self, delays: list[float]) -> None:
        self._delays = delays
        self._sent = 0

    def send(self, frame: Frame) -> None:
        self._sent = frame.step

    def receive(self, deadline: float) -> tuple[int, Reply] | None:
        time.sleep(self._delays[self._sent])
        return self._sent, REPLY  # whatever the deadline was: as if it lay there when this side woke up


def test_an_answer_after_the_next_frame_is_due_is_a_miss_even_if_it_is_there() -> None:
    timing = Timing()
    paced = PacedEcu(cast(ProcessEcu, cast(Any, Link([0.0, 2 * STEP, 0.0]))), STEP, timing)
    frames = [Frame(step=step, stage=0, codes=np.zeros(1, dtype=np.int64)) for step in range(3)]
    assert paced.exchange(frames[1]) is None
    assert timing.misses == 1
    assert timing.latency == []
