"""`--require`: limits that metrics have to keep, as they are typed, shown, and written for a CI system."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any
from xml.etree import ElementTree

from ridelab.cli import options
from ridelab.cli.fields import read
from ridelab.cli.reporting import InputError, folder_of, show_table, write
from ridelab.cli.service import Services
from ridelab.cli.targets import document
from ridelab.requirements import FAIL, PASS, UNCERTAIN, FailingRun, Requirement, RequirementResult
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
    """Return the requirements of each text, or of the file that it names, as the service takes them.

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
    said = _of_runs(each, unit) if each.counts else each.reason or ""
    return [each.metric, each.limit(unit), strategy, _held(each, unit), each.result, said]


def _held(each: RequirementResult, unit: str) -> str:
    """Return the value that is held to the limit, with its unit, and over several roads its interval."""
    value = "" if each.value is None else _with_unit(each, each.value, unit)
    return value if each.low is None else f"{value} ({each.low:.4g} to {each.high:.4g})"


def _with_unit(each: RequirementResult, value: float, unit: str) -> str:
    shown_unit = "%" if each.max_change is not None else unit
    return f"{value:.4g}{'' if shown_unit == '1' else f' {shown_unit}'}"


def _of_runs(each: RequirementResult, unit: str) -> str:
    """Return how many of a batch's runs pass or fail, which fail first and worst, and how many have no value."""
    said = _failing(each, unit) or f"{each.counts[PASS]} of {each.total} runs pass"
    return f"{said}; {each.not_computed} not computed" if each.not_computed else said


def _failing(each: RequirementResult, unit: str) -> str:
    """Return how many of a batch's runs fail, and which first and worst; nothing where none does."""
    first, worst = each.first_failure, each.worst_failure
    if first is None:
        return ""
    said = f"{each.counts[FAIL]} of {each.total} runs fail, the first {_place(each, first, unit)}"
    return said if worst in (None, first) else f"{said}, the worst {_place(each, worst, unit)}"


def _place(each: RequirementResult, run: FailingRun, unit: str) -> str:
    at = ", ".join(f"{name}={value}" for name, value in run["at"].items())
    return f"at {at}" if run["value"] is None else f"at {at} with {_with_unit(each, run['value'], unit)}"


def check_file(junit: str | None, requirements: Sequence[Any]) -> None:
    """Refuse a file that could not be written, or would say nothing, before anything is computed."""
    if junit is not None:
        folder_of(junit, "--junit")
        if not requirements:
            raise InputError("--junit writes what becomes of requirements: give some with --require")


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A test case for a CI system.

    Attributes:
        strategy: Which is held to something.
        name: What it is held to.
        result: What became of it.
        message: Why it does not pass; empty where nothing fails.
        error: What could not be computed; empty where all was.
    """

    strategy: str
    name: str
    result: str
    message: str
    error: str = ""


def cases(results: Sequence[RequirementResult], services: Services) -> list[Case]:
    """One for each requirement and strategy."""
    units = services.names.metrics if results else {}
    return [_case(each, units.get(each.metric, "1")) for each in results]


def _case(each: RequirementResult, unit: str) -> Case:
    if each.counts:
        message = _failing(each, unit) or (_of_runs(each, unit) if each.result == UNCERTAIN else "")
        error = f"{each.not_computed} of {each.total} runs not computed: {each.reason}" if each.not_computed else ""
    else:
        error = each.reason or ""
        message = "" if error else f"{each.result} {_held(each, unit)}"
    name = f"{each.metric} {each.limit(unit)}"
    return Case(strategy=each.strategy, name=name, result=each.result, message=message, error=error)


def write_junit(cases: Sequence[Case], path: str, suite: str, *, strict: bool) -> None:
    """The cases as JUnit XML; what is uncertain is skipped, or fails where it is strict."""
    failures = {FAIL, UNCERTAIN} if strict else {FAIL}
    root = ElementTree.Element("testsuite")
    for each in cases:
        case = ElementTree.SubElement(root, "testcase", {"classname": f"ridelab.{each.strategy}", "name": each.name})
        if each.result != PASS and each.message:
            kind = "failure" if each.result in failures else "skipped"
            ElementTree.SubElement(case, kind, {"message": each.message})
        if each.error:
            ElementTree.SubElement(case, "error", {"message": each.error})
    kinds = Counter(child.tag for case in root for child in case)
    counts = {"failures": kinds["failure"], "errors": kinds["error"], "skipped": kinds["skipped"]}
    root.attrib.update({"name": suite, "tests": str(len(cases)), **{name: str(each) for name, each in counts.items()}})
    ElementTree.indent(root)
    write([ElementTree.tostring(root, encoding="utf-8", xml_declaration=True), b"\n"], path)


def judged(
    run: RunResult, requirements: Sequence[Requirement], baseline: str | None, name: str, services: Services
) -> Sequence[RequirementResult]:
    """Return how the strategies of a run, which may be one saved to a file, keep requirements.

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
