"""What runs share stays within its bytes, and large things are not kept."""

from dataclasses import dataclass
from weakref import WeakSet

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import MEBIBYTE, cached_up_to, size


@dataclass(frozen=True)
class _Pair:
    first: FloatArray
    more: dict[str, tuple[FloatArray, ...]]
    name: str = "pair"


def test_size_counts_every_array_inside() -> None:
    assert size(_Pair(np.zeros(10), {"a": (np.zeros(5), np.zeros(1))})) == 16 * 8


def test_latest_results_are_kept_while_they_fit() -> None:
    calls: list[int] = []

    @cached_up_to(1)
    def make(quarters: int, number: int) -> FloatArray:
        calls.append(number)
        return np.zeros(quarters * MEBIBYTE // 4 // 8 - 1000)

    assert make(1, 1) is make(1, 1)
    for number in (2, 3, 4):
        make(1, number)
    assert calls == [1, 2, 3, 4]
    make(1, 1)  # still there: four quarters fit
    assert calls == [1, 2, 3, 4]
    make(1, 5)  # pushes 2 out, the one not used for longest
    make(1, 2)
    assert calls == [1, 2, 3, 4, 5, 2]
    make(8, 6)
    make(8, 6)  # larger than the whole cache: made again each time
    assert calls[-2:] == [6, 6]


def test_the_arrays_of_arguments_count_because_an_entry_keeps_them_alive() -> None:
    @dataclass(frozen=True, eq=False)
    class Road:
        heights: FloatArray

    alive = WeakSet[Road]()

    @cached_up_to(1)
    def length(road: Road, *, scale: float) -> float:
        return scale * len(road.heights)

    for _ in range(20):
        road = Road(np.zeros(MEBIBYTE // 4 // 8))
        alive.add(road)
        length(road, scale=2.0)
    del road
    assert len(alive) <= 4
