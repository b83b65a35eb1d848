"""Time histories in part are those in whole."""

from itertools import combinations

import numpy as np
import pytest

from sim_core.result import Series

COMMANDS, SAMPLES = 4, 3
WHOLE = {"time": np.arange(12.0), "front_force": np.arange(100.0, 112.0)}
BEFORE_NEXT = np.full(COMMANDS, np.nan)  # the value before the next command
ROWS = np.c_[WHOLE["front_force"].reshape(COMMANDS, SAMPLES), BEFORE_NEXT]
SERIES = Series({"time": WHOLE["time"]}, lambda commands: {"front_force": ROWS[commands]}, SAMPLES)


@pytest.mark.parametrize("key", WHOLE)
def test_a_part_of_a_history_is_that_part_of_it(key: str) -> None:
    for start, end in combinations(range(COMMANDS * SAMPLES + 1), 2):
        np.testing.assert_array_equal(SERIES.between(key, start, end), WHOLE[key][start:end])


@pytest.mark.parametrize("key", WHOLE)
def test_histories_of_some_commands_are_those_of_whole_commands(key: str) -> None:
    for start, end in combinations(range(COMMANDS * SAMPLES + 1), 2):
        some = SERIES.of_commands(start, end)
        first, last = start // SAMPLES * SAMPLES, -(-end // SAMPLES) * SAMPLES
        np.testing.assert_array_equal(some[key], WHOLE[key][first:last])
        np.testing.assert_array_equal(some.at(key, np.array([0, 1])), WHOLE[key][first : first + 2])


@pytest.mark.parametrize("key", WHOLE)
def test_single_samples_are_those_of_the_history(key: str) -> None:
    samples = np.array([0, 1, 5, 6, 11])
    np.testing.assert_array_equal(SERIES.at(key, samples), WHOLE[key][samples])
