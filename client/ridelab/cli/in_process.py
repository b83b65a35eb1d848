"""The core in this process, in a service's place: for names, and for a run that nobody wants stored.

docs/decisions/0035-a-run-in-process.md says why. Nothing is started and nothing is left behind.
"""

import json
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict
from typing import Any

from ridelab.cli.reporting import InputError, UnavailableError, waiting
from ridelab.client import Ridelab
from ridelab.http import plain

_NAMES = ("/schema", "/catalogue", "/strategies", "/presets", "/vehicles")  # each a function of sim_core.library


class InProcess(Ridelab):
    """Answers as a service does; what the core alone cannot answer, and what it refuses, goes to a private service.

    Args:
        service: Gives the private service's client; called when it is first needed.
    """

    def __init__(self, service: Callable[[], Ridelab]) -> None:
        self._service = service

    def get(self, path: str, params: Mapping[str, Any] | None = None) -> Any:
        """The JSON at a path below `/api/v1`."""
        try:
            if path not in _NAMES:
                return self._service().get(path, params)
            from sim_core import library

            return getattr(library, path[1:])()
        except ImportError as error:  # a core that is there and cannot be used says why
            raise UnavailableError(str(error)) from None

    def _post(self, path: str, body: Mapping[str, Any], key: str = "") -> dict[str, Any]:
        refusal: list[str] = []
        if path == "/runs" and body["roads"] == 1 and not body.keys() & {"requirements", "against"}:
            with waiting("Driving"):
                answer = _run(body, refusal)
            if answer is not None:
                return answer
        try:
            return self._service()._post(path, body, key)  # it says better what is wrong, beside what is not
        except UnavailableError:
            if refusal:
                raise InputError(*refusal) from None
            raise


def _said(error: Mapping[str, Any]) -> str:
    """Return what one of pydantic's errors says of a scenario's field."""
    from sim_core.scenario import dotted

    if error["type"] == "extra_forbidden":
        return "there is no such field; ridelab fields lists them"
    field = dotted.scenario_fields().get(".".join(map(str, error["loc"])))
    return dotted.explain(error, "1" if field is None else field.unit)


def _run(body: Mapping[str, Any], refusal: list[str]) -> dict[str, Any] | None:
    """A run's answer without an id; None, and why, where the core refuses anything of it."""
    from pydantic import ValidationError

    from sim_core import STRATEGIES, RidelabError, Scenario, __version__, characteristics, compare, simulate

    answers, results = {}, {}
    try:
        scenario = Scenario.model_validate_json(json.dumps(body["scenario"], default=plain))
        ours = [name for name in STRATEGIES if name in body["strategies"]]
        for name in ours + [name for name in body["strategies"] if name not in ours]:
            begin = time.perf_counter()
            results[name] = simulate(scenario, name)
            summary = results[name].summary()
            milliseconds = round(1000 * (time.perf_counter() - begin), 2)
            answers[name] = {"status": "ok", "compute_ms": milliseconds, "cached": False, "source": None, **summary}
        comparison = asdict(compare(results, body.get("baseline")))
    except ValidationError as error:
        refusal += [f"{'.'.join(map(str, each['loc']))}: {_said(each)}" for each in error.errors()]
        return None
    except RidelabError as error:
        refusal.append(error.message)
        return None
    facts = {
        "characteristics": asdict(characteristics(scenario.vehicle)),
        "cautions": comparison["cautions"],
        "comparison": comparison,
        "strategies": answers,
    }
    plain_facts: dict[str, Any] = json.loads(json.dumps(facts, default=plain))
    return {"id": None, "core_version": __version__, "scenario": scenario.model_dump(mode="json"), **plain_facts}
