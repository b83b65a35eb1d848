"""The service's parts by themselves: digests, strict JSON, settings, memory."""

import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI
from hypothesis import given
from hypothesis import strategies as st

from backend import digest
from backend.api.site import add_site
from backend.means_over_roads import with_seeds
from sim_core import STRATEGIES, Hil, Lqr, Mpc, Road, Scenario


def test_a_result_depends_on_what_its_strategy_reads_and_nothing_else() -> None:
    paper = Scenario()
    edited = {
        "lqr weights": Scenario(lqr=Lqr(weights=(2, 1, 1))),
        "prediction horizon": Scenario(mpc=Mpc(prediction_horizon=25)),
        "converters": Scenario(hil=Hil(bits=10)),
        "seed": Scenario(road=Road(seed=2)),
    }
    changed = {
        name: {s for s in STRATEGIES if digest.result_key(paper, s) != digest.result_key(scenario, s)}
        for name, scenario in edited.items()
    }
    assert changed == {
        "lqr weights": {"lqr"},
        "prediction horizon": {"lv", "lv_hil", "suspension_only"},
        "converters": {"lv_hil"},
        "seed": set(STRATEGIES),
    }
    assert len({digest.result_key(paper, s) for s in STRATEGIES}) == len(STRATEGIES)


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


@pytest.mark.parametrize("first_seed", [1, 0, 2**31])
def test_keys_on_several_roads_are_those_of_each_road(first_seed: int) -> None:
    scenario = Scenario.model_validate({"road": {"seed": first_seed}, "estimation": {"kind": "kalman"}})
    roads = with_seeds(scenario, 3)
    each = [{name: digest.result_key(road, name) for name in STRATEGIES} for road in roads]
    assert digest.result_keys(roads, STRATEGIES) == each
    assert len({key for keys in each for key in keys.values()}) == 3 * len(STRATEGIES)


TRIM = """
from pathlib import Path
from backend.compute import memory
def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096
memory.return_freed_memory()
blocks = [bytes(1000) for _ in range(100_000)]
blocks = blocks[::100]
before = resident()
memory.trim_memory()
print(before - resident())
"""


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have another allocator")
def test_freed_pages_between_blocks_in_use_are_given_back() -> None:
    """Of 100 MB every hundredth block stays."""
    given_back = subprocess.run([sys.executable, "-c", TRIM], capture_output=True, text=True, check=True).stdout
    assert int(given_back) > 80e6


def test_what_is_not_built_is_not_found(service: Any, tmp_path: Path) -> None:
    app = FastAPI()
    add_site(app, tmp_path / "dist", tmp_path / "manual")
    transport = httpx.ASGITransport(app)
    client = httpx.AsyncClient(transport=transport, base_url="http://site")
    for address in ("/manual/", "/manual/index.html", "/assets/index.js", "/docs-assets/swagger-ui.css"):
        assert service.inside(client.get(address)).status_code == 404, address
