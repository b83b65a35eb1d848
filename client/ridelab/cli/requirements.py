"""`--require`: limits that metrics have to keep, as they are typed, shown, and written for a CI system."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any
from xml.etree import ElementTree

from ridelab.cli import options
from ridelab.cli.fields import read
from ridelab.cli.reporting import InputError, folder_of
from ridelab.cli.service import Services
from ridelab.cli.tables import show_table
from ridelab.cli.targets import document
from ridelab.files import save
from ridelab.requirements import FAIL, PASS, UNCERTAIN, Requirement, RequirementResult
from ridelab.results import RunResult
from ridelab.units import quantity

_REQUIRE = (
    "Limit such as bump.body_acceleration.peak<3, lv:travel_time<20s, bump.rear_tyre_load.peak<-20% (a change against "
    "the baseline), or a JSON file of them; repeated."
)
_STRICT = "What is uncertain over several roads fails too."
_JUNIT = "Write the requirements' results there as JUnit XML."
_FORM = re.compile(r"(?:(?P<strategies>[\w,:-]+):\s*)?(?P<metric>[\w.]+)\s*(?P<sign>[<>])=?\s*(?P<limit>.+)")
_CHANGE = re.compile(r"(?P<percent>[-+](?:\d+\.?\d*|\.\d+))\s*%")

Require = Annotated[list[str] | None, options.option("METRIC<LIMIT", _REQUIRE, completes="metrics <")]
Strict = Annotated[bool, options.flag(_STRICT, "--strict")]
Junit = Annotated[str | None, options.option("FILE", _JUNIT)]


def requirements_of(texts: Sequence[str] | None, services: Services) -> list[dict[str, Any]]:
    """What each text, or the file that it names, requires; as the service takes it.

    Raises:
        InputError: It is no requirement.
    """
    return [each for text in texts or () for each in _of_text(text, services)]


def _of_text(text: str, services: Services) -> list[dict[str, Any]]:
    if Path(text).is_file():
        content = document(Path(text).read_bytes(), text)
        content = content.get("requirements") if isinstance(content, dict) else content
        if not isinstance(content, list) or not all(isinstance(each, dict) for each in content):
            raise InputError(f'{text}: it holds no requirements, [{{"metric": .., "max": ..}}, ..]')
        return content
    match = _FORM.fullmatch(text.strip())
    if match is None:
        raise InputError(f"--require takes METRIC<LIMIT or METRIC>LIMIT or a file, and {text or 'nothing'} is none")
    metric, least = match["metric"], match["sign"] == ">"
    named = {} if match["strategies"] is None else {"strategies": match["strategies"].split(",")}
    if change := _CHANGE.fullmatch(match["limit"]):
        if least:
            raise InputError(f"{metric}: a change has an upper limit, such as {metric}<-20%")
        return [{"metric": metric, "max_change": float(change["percent"]), **named}]
    limit = read(metric, match["limit"], quantity, services.names.metrics)
    return [{"metric": metric, "min" if least else "max": limit, **named}]


def show(results: Sequence[RequirementResult], services: Services) -> None:
    """Print a line for each."""
    names = services.names
    heads = ["requirement", "", "strategy", "value", "result", ""]
    show_table(
        heads, [_line(each, names.metrics.get(each.metric, "1"), names.label(each.strategy)) for each in results]
    )


def _line(each: RequirementResult, unit: str, strategy: str) -> list[Any]:
    return [each.metric, each.limit(unit), strategy, _held(each, unit), each.result, explained(each)]


def _held(each: RequirementResult, unit: str) -> str:
    """What is held to the limit, with its unit, and over several roads its interval."""
    shown_unit = "%" if each.max_change is not None else unit
    value = "" if each.value is None else f"{each.value:.4g}{'' if shown_unit == '1' else f' {shown_unit}'}"
    return value if each.low is None else f"{value} ({each.low:.4g} to {each.high:.4g})"


def explained(each: RequirementResult) -> str:
    """Why there is no value; of a batch how many of its runs fail, and where the first one stands."""
    if not each.counts:
        return each.reason or ""
    failed, total = each.counts[FAIL], sum(each.counts.values())
    if each.first_failure is None:
        return f"{each.counts[PASS]} of {total} runs pass"
    at = ", ".join(f"{name}={value}" for name, value in each.first_failure["at"].items())
    return f"{failed} of {total} runs fail, the first at {at}"


def check_file(junit: str | None, requirements: Sequence[Any]) -> None:
    """Refuse a file that could not be written, or would say nothing, before anything is computed."""
    if junit is not None:
        folder_of(junit, "--junit")
        if not requirements:
            raise InputError("--junit writes what becomes of requirements: give some with --require")


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A test case for a CI system: what a strategy is held to, what became of it, and why it does not pass."""

    strategy: str
    name: str
    result: str
    message: str


def cases(results: Sequence[RequirementResult], services: Services) -> list[Case]:
    """One for each requirement and strategy."""
    units = services.names.metrics if results else {}
    return [
        Case(
            strategy=each.strategy,
            name=f"{each.metric} {each.limit(units.get(each.metric, '1'))}",
            result=each.result,
            message=" ".join(filter(None, [each.result, _held(each, units.get(each.metric, "1")), explained(each)])),
        )
        for each in results
    ]


def write_junit(cases: Sequence[Case], path: str, suite: str, *, strict: bool) -> None:
    """The cases as JUnit XML; what is uncertain is skipped, or fails where it is strict."""
    failures = {FAIL, UNCERTAIN} if strict else {FAIL}
    counts = {
        "tests": len(cases),
        "failures": sum(each.result in failures for each in cases),
        "skipped": sum(each.result == UNCERTAIN and not strict for each in cases),
    }
    root = ElementTree.Element("testsuite", {"name": suite, **{name: str(count) for name, count in counts.items()}})
    for each in cases:
        case = ElementTree.SubElement(root, "testcase", {"classname": f"ridelab.{each.strategy}", "name": each.name})
        if each.result != PASS:
            kind = "failure" if each.result in failures else "skipped"
            ElementTree.SubElement(case, kind, {"message": each.message})
    ElementTree.indent(root)
    save([ElementTree.tostring(root, encoding="utf-8", xml_declaration=True), b"\n"], path)


def judged(
    run: RunResult, requirements: Sequence[Requirement], baseline: str | None, name: str, services: Services
) -> Sequence[RequirementResult]:
    """How the strategies of a run, which may be one saved to a file, keep requirements.

    Raises:
        InputError: The service computes other numbers than the file has.
    """
    if not requirements:
        return ()
    held = services.at().run(
        run.scenario, list(run.strategies), roads=run.roads, baseline=baseline, requirements=requirements
    )
    if held.id != run.id:
        older = f"core {run.core_version} computed it, and the service has {held.core_version}"
        raise InputError(f"{name}: --require cannot hold it to a limit, {older}: run its scenario again")
    return held.requirement_results
