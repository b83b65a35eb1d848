"""docs/explanation/paper.md shows what the service answers; UPDATE_DOCS=1 writes it there."""

import os
import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.paper.claims import SEEDS, WINDOW
from backend.paper.interpretations import INTERPRETATIONS, OPEN_QUESTIONS
from sim_core.catalogue import SIGNALS
from sim_core.strategies import STRATEGIES
from tests.docs import causes

PAGE = Path(__file__).parents[2] / "docs/explanation/paper.md"
SIGNAL_NAMES = {key: item.label for key, item in SIGNALS.items()}


def counts(answer: dict[str, Any]) -> Iterator[str]:
    def sentence(reached: int, verdicts: dict[str, int]) -> str:
        rest = f"{verdicts['smaller']} smaller, {verdicts['contradicts']} contradict"
        return f"{reached} of {answer['total']} reached, {rest}"

    blind = answer["without_preview"]
    ours = sentence(answer["reached"], answer["counts"])
    yield f"With the road ahead known to the MPC: **{ours}**. Without preview: "
    yield f"**{sentence(blind['reached'], blind['counts'])}**."


def sets(answer: dict[str, Any]) -> Iterator[str]:
    yield "| roads | interpretation | reached | simulated | ECU, ±8 % | within ±10 points | printed in our interval |"
    yield "|---|---|---:|---:|---:|---:|---:|"
    roads = f"{answer['first_seed']}-{answer['first_seed'] + answer['seeds'] - 1}"
    for item in answer["interpretations"]:
        parts = (item, item["simulated"], item["ecu"])
        counted = " | ".join(f"{part['reached']} of {part['total']}" for part in parts)
        near = item["agreement"]
        yield (
            f"| {roads} | {item['id']} | {counted} | {near['within']} of {near['cells']} "
            f"| {near['in_interval']} of {near['cells']} |"
        )


def missed(answer: dict[str, Any]) -> Iterator[str]:
    for cell in answer["cells"]:
        if cell["verdict"] != "reached":
            claim = cell["misprint"]["follows"] if cell["misprint"] else cell["paper_change"]
            pair = f"{STRATEGIES[cell['strategy']].label} against {STRATEGIES[cell['against']].label}"
            changes = f"{claim:+g} %, ours {cell['our_change']:+.1f} %, {worded(cell)}"
            yield f"- Table {cell['table']}, {SIGNAL_NAMES[cell['signal']].lower()}, {pair}: {changes}."


def windows(client: httpx.Client) -> Iterator[str]:
    """Cells reached under each choice of the reading `window`, which changes no run."""
    yield "| interpretation | `window=to_bump` | `window=class_b` | `window=full_course` |"
    yield "|---|---:|---:|---:|"
    for name in INTERPRETATIONS:
        for without, label in (({}, name), ({"preview": "none"}, f"{name}, `preview=none`")):
            cells = []
            for choice in OPEN_QUESTIONS[WINDOW].choices:
                query = {"interpretation": name, "window": choice.id, **without}
                answer = client.get("/api/v1/paper", params=query).json()
                simulated, in_ecu = (answer[part]["reached"] for part in ("simulated", "ecu"))
                cells.append(f"{answer['reached']} ({simulated} + {in_ecu})")
            yield f"| {label} | {' | '.join(cells)} |"


def verdicts(answer: dict[str, Any]) -> Iterator[str]:
    yield "| table | figure | of | against | paper | ours | 95 % | verdict | without preview |"
    yield "|---|---|---|---|---:|---:|---|---|---|"
    for cell in answer["cells"]:
        claimed = f"{cell['paper_change']:+g} %"
        if cell["misprint"]:
            claimed = f"{cell['misprint']['follows']:+g} % (printed {claimed})"
        blind = cell["without_preview"]
        blindly = f"{worded(blind)}, {blind['our_change']:+.0f} %" if blind else ""
        yield (
            f"| {cell['table']} | {SIGNAL_NAMES[cell['signal']]} | {STRATEGIES[cell['strategy']].label} "
            f"| {STRATEGIES[cell['against']].label} | {claimed} | {interval(cell)} | {worded(cell)} | {blindly} |"
        )


def interval(cell: dict[str, Any]) -> str:
    low, high = cell["ci"]
    return f"{cell['our_change']:+.1f} % | {low:+.1f} to {high:+.1f}"


def worded(item: dict[str, Any]) -> str:
    return f"{item['verdict']}{'' if item['certain'] else ', uncertain'}"


def readings(answer: dict[str, Any], rows: list[dict[str, Any]]) -> Iterator[str]:
    names = {item["id"]: item for item in answer["readings"]}
    yield "| switch | turned to | reached | smaller | contradicts | verdicts changed |"
    yield "|---|---|---:|---:|---:|---:|"
    for row in rows:
        item = names[row["reading"]]
        label = next(choice["label"] for choice in item["choices"] if choice["id"] == row["choice"])
        counts = row["counts"]
        numbers = f"{counts['reached']} | {counts['smaller']} | {counts['contradicts']} | {row['changed']}"
        yield f"| {item['title']} | {label} | {numbers} |"


def written_between(text: str, match: re.Match[str]) -> str:
    return f"{match[1]}{text}\n{match[2]}"


def with_blocks(page: str, blocks: dict[str, Iterator[str]]) -> str:
    for name, lines in blocks.items():
        written = "\n".join(line.rstrip() for line in lines)
        page, times = re.subn(
            rf"(<!-- {name} -->\n).*?(<!-- end -->)",
            partial(written_between, written),
            page,
            flags=re.DOTALL,
        )
        assert times == 1, name
    return page


@pytest.mark.usefixtures("reproduced")
def test_the_page_shows_what_is_answered(client: httpx.Client) -> None:
    answer = client.get("/api/v1/paper").json()
    page = PAGE.read_text(encoding="utf-8")
    blocks = {"counts": counts(answer), "verdicts": verdicts(answer)}
    blocks["sets"] = sets(answer)
    blocks["missed"] = missed(client.get("/api/v1/paper", params={"interpretation": "favourable"}).json())
    blocks["sentences"] = (f"- {line}" for line in client.get("/api/v1/paper/attribution").json()["sentences"])
    if os.environ.get("UPDATE_DOCS"):  # what each switch does takes a minute or two: not in every run
        while not (effects := client.get("/api/v1/paper/readings").json())["complete"]:
            pass
        blocks["readings"] = readings(answer, effects["rows"])
        fresh = client.get("/api/v1/paper", params={"first_seed": 21, "seeds": 40}).json()
        blocks["fresh"] = sets(fresh)
        blocks["windows"] = windows(client)
        PAGE.write_text(with_blocks(page, blocks), encoding="utf-8")
    else:
        assert with_blocks(page, blocks) == page


def test_the_causes_on_the_page() -> None:
    page = PAGE.read_text(encoding="utf-8")
    written = with_blocks(page, {"causes": causes.page(range(1, SEEDS + 1))})
    if os.environ.get("UPDATE_DOCS"):
        PAGE.write_text(written, encoding="utf-8")
    assert written == page


@pytest.mark.usefixtures("reproduced")
def test_the_readme_names_both_counts(client: httpx.Client) -> None:
    answer = client.get("/api/v1/paper").json()
    default, favourable, _ = answer["interpretations"]
    text = " ".join((PAGE.parents[2] / "README.md").read_text(encoding="utf-8").split())
    own, other = ((each["simulated"]["reached"], each["ecu"]["reached"]) for each in (default, favourable))
    for said in (
        f"{default['reached']} are reached as Ridelab reads it, {own[0]} of 40 simulated changes and {own[1]} of 8 on",
        f"{favourable['reached']} are reached by the favourable set of readings, {other[0]} of 40 and {other[1]} of 8",
        f"lie {default['agreement']['within']} and {favourable['agreement']['within']} of the 40",
        f"without preview {answer['without_preview']['reached']} are reached",
    ):
        assert said in text
    assert default["agreement"]["in_interval"] == favourable["agreement"]["in_interval"] == 0
