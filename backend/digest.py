"""Keys of content-addressed results: the hash of exactly what a result depends on; and ids that people type.

No id begins with a sign, which a command line would take for an option and a spreadsheet for a formula.
"""

import base64
import contextlib
import hashlib
import secrets
from collections.abc import Iterable, Sequence
from typing import Any

import orjson

from backend.json_types import JsonObject
from sim_core.check_controller import ID
from sim_core.program import program
from sim_core.scenario import Scenario
from sim_core.scenario.recorded import NAME_PATTERN, recording_id
from sim_core.strategies import REFERENCE_STRATEGIES, STRATEGIES, strategy_named, values_read

STRATEGY_PATTERN = f"{ID}|{NAME_PATTERN}"  # of a strategy's name in a run: simulated, or a recording
RUN_ID_LENGTH = 22  # base64url characters: 132 bits of SHA-256


def random_id() -> str:
    """Return an id of 128 random bits, for what has no content to be named by; begins as every id does."""
    while not (text := secrets.token_urlsafe(16))[0].isalnum():
        pass
    return text


def canonical(value: Any) -> bytes:
    """Return one byte string for one meaning: keys sorted, no spaces, 50 and 50.0 alike, no negative zero."""
    with contextlib.suppress(orjson.JSONEncodeError):  # for an integer that no double holds
        written = orjson.dumps(value, option=orjson.OPT_SORT_KEYS | orjson.OPT_STRICT_INTEGER)
        if not has_whole_floats(written):
            return written
    return orjson.dumps(plain(value), option=orjson.OPT_SORT_KEYS)


def has_whole_floats(written: bytes) -> bool:
    """Check whether JSON that orjson has written has a number such as `2.0`; a text like that counts, too."""
    return any(end in written for end in (b".0,", b".0]", b".0}")) or written.endswith(b".0")


def result_key(scenario: Scenario, strategy: str) -> str:
    """Return the key of a result: the program that computes it, strategy and the part of the scenario it reads."""
    (keys,) = result_keys([scenario], [strategy])
    return keys[strategy]


def result_keys(
    roads: Sequence[Scenario], strategies: Iterable[str], identity: JsonObject | None = None
) -> list[dict[str, str]]:
    """Return by strategy (no recording) the `result_key` on each of several roads, which differ in their seed alone.

    Args:
        roads: The scenario on each.
        strategies: Ids.
        identity: The first one's identity, `plain`, where it is there already.
    """
    keys: list[dict[str, str]] = [{} for _ in roads]
    identity = plain(roads[0].identity()) if identity is None else identity
    for strategy in strategies:
        recorded = recording_id(strategy) is not None
        part = identity if recorded else values_read(roads[0], strategy_named(strategy), identity)
        content = {**_program([strategy]), "strategy": strategy, "part": part}
        for road, of_road in zip(roads, keys, strict=True):
            if "road.seed" in part:
                part["road.seed"] = road.road.seed
            of_road[strategy] = _digest(content)
    return keys


def paper_row_key(scenario: Scenario, strategy: str) -> str:
    """Return the key of the paper's figures of one strategy's run: it depends on what the result depends on."""
    return _digest({"figures_of": result_key(scenario, strategy)})


def band_key(scenario: Scenario, strategy: str, roads: int) -> str:
    """Return the key of one strategy's time histories over so many roads, of which the scenario's is the first."""
    return _digest({"band_of": result_key(scenario, strategy), "roads": roads})


def derived_key(name: str, parameters: JsonObject) -> str:
    """Return the key of what is derived from many runs: the program that computes them, its name, its parameters."""
    return _digest({**_program(STRATEGIES), "derived": name, "parameters": plain(dict(parameters))})


def run_id(
    scenario: Scenario,
    strategies: Iterable[str],
    roads: int = 1,
    baseline: str | None = None,
    identity: JsonObject | None = None,
) -> str:
    """Return the id of a run: the whole scenario, the set of strategies and the program that computes them.

    Args:
        scenario: What to drive, on the first road.
        strategies: Ids.
        roads: How many roads; a run of one has the id it had before there were several.
        baseline: Which strategy the changes over several roads refer to.
        identity: The scenario's identity, `plain`, where it is there already.
    """
    names = sorted(set(strategies))
    identity = plain(scenario.identity()) if identity is None else identity
    content: JsonObject = {**_program(names), "scenario": identity, "strategies": names}
    if roads > 1:
        content |= {"roads": roads, "baseline": baseline}
    return _digest(content).lstrip("-_")[:RUN_ID_LENGTH]


def _program(strategies: Iterable[str]) -> JsonObject:
    """Return what computes these strategies, all together."""
    computed = {each for name in strategies for each in (REFERENCE_STRATEGIES if recording_id(name) else (name,))}
    programs = {name: program(strategy_named(name)) for name in sorted(computed)}
    common = {key: value for each in programs.values() for key, value in each.items() if key != "controller"}
    return {**common, "controllers": {name: each["controller"] for name, each in programs.items()}}


def _digest(content: JsonObject) -> str:
    """Return the SHA-256 of canonical content."""
    written = orjson.dumps(content, option=orjson.OPT_SORT_KEYS)
    return base64.urlsafe_b64encode(hashlib.sha256(written).digest()).decode().rstrip("=")


def plain(value: Any) -> Any:
    """Return the value with each whole float as an integer (also -0.0 as 0), and each huge integer as a float."""
    if isinstance(value, float) and value.is_integer() and abs(value) < 2**53:
        return int(value)
    if isinstance(value, int) and not -(2**63) <= value < 2**63:
        return float(value)
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value
