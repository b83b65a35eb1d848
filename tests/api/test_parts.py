"""The service's parts by themselves: digests, strict JSON, settings, memory."""

import math
import os
import subprocess
import sys
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from backend import digest
from sim_core import Scenario


def test_keys_are_the_same_in_every_process() -> None:
    """Sets and dictionaries have another order under another hash seed (here it is random); keys must not."""
    code = "from backend.digest import *; print(result_key(Scenario(), 'lv'), run_id(Scenario(), ['lv', 'lqr']))"
    other = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "PYTHONHASHSEED": "1"},
        cwd=Path(__file__).parents[2],
        capture_output=True,
        text=True,
        check=True,
    )
    assert other.stdout.split() == [digest.result_key(Scenario(), "lv"), digest.run_id(Scenario(), ["lqr", "lv"])]


def test_no_id_begins_with_a_sign() -> None:
    """A command line would take it for an option, a spreadsheet for a formula; one hash in 32 begins with one."""
    scenario = Scenario()
    ids = [
        digest.run_id(scenario.model_copy(update={"road": scenario.road.model_copy(update={"seed": seed})}), ["lv"])
        for seed in range(300)
    ]
    ids += [digest.random_id() for _ in range(300)]
    assert len(set(ids)) == 600
    assert all(len(each) == digest.RUN_ID_LENGTH and each[0].isalnum() for each in ids)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_equal_numbers_have_one_canonical_form_and_others_another(value: float) -> None:
    assert digest.canonical({"a": value}) == digest.canonical({"a": value + 0.0 if value else 0})
    if value.is_integer() and abs(value) < 2**53:
        assert digest.canonical([value]) == digest.canonical([int(value)])
    other = math.nextafter(value, math.inf)
    if math.isfinite(other) and other != value:
        assert digest.canonical([value]) != digest.canonical([other])
