"""The service's OpenAPI description: FastAPI's, with additions it cannot derive.

Headers, examples, links and tags stand here and not at each route, because they follow from a status, a name or a type.
"""

import json
import threading
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from backend.digest import STRATEGY_PATTERN
from backend.http.field_descriptions import EVERYWHERE, OF_MODELS
from backend.http.kinds import KINDS
from backend.http.problems import MEDIA_TYPE, Problem
from backend.http.request_log import HEADER
from backend.http.tokens import COOKIE
from backend.json_types import JsonObject
from sim_core.catalogue import PAPER_SIGNALS
from sim_core.check_controller import ID
from sim_core.strategies import STRATEGIES, strategies

TAGS = {
    "runs": "A scenario and the strategies that drive it: computed once, stored, read, drawn.",
    "batches": "Sweeps and robustness studies: many runs, submitted, followed and read as one.",
    "roads": "Measured roads: sent as CSV, named by scenarios.",
    "recordings": "Recorded drives: sent as CSV, shown among a run's strategies.",
    "tunings": "Searches for better weights.",
    "links": "Links that open a run or a batch as it was shared.",
    "paper": "The paper's tables and figures, checked.",
    "controller": "The controller as a program for a small processor.",
    "schema": "What there is to choose from: fields, presets, vehicles, strategies, signals, figures.",
    "login": "The page's login, where the service wants a token.",
    "health": "For those who operate the service.",
}
HEADERS: dict[str, JsonObject] = {
    HEADER: {"description": "The request's name, also in the service's log", "required": True},
    "Retry-After": {"description": "When to ask again [s]", "schema": {"type": "integer"}},
    "WWW-Authenticate": {"description": "`Bearer`", "required": True},
    "Location": {"description": "Where it is", "required": True},
    "ETag": {"description": "For If-None-Match; a long file has none"},
    "Set-Cookie": {"description": "The page's cookie, HttpOnly and SameSite=Strict", "required": True},
    "Content-Disposition": {"description": "A file's name; not of JSON"},
}
OF_STATUS = {
    "201": ["Location"],
    "202": ["Location"],
    "304": ["ETag"],
    "401": ["WWW-Authenticate"],
    "429": ["Retry-After"],
    "503": ["Retry-After"],
}
OF_ROWS = frozenset({"EqualSpeed"})  # its `strategy` is a row's id
BYTES: JsonObject = {"type": "string", "format": "binary"}
FILES = frozenset({"text/csv", "application/zip", "text/html"})  # answers that come with a file's name

SCENARIO = {"road": {"length": 130, "bump": {"height": 0.08}}, "speed": {"target_speed_kmh": 25}}
EXAMPLES: dict[str, JsonObject] = {  # of bodies, by their schema
    "RunRequest": {"scenario": SCENARIO, "strategies": ["lv", "passive"]},
    "LiveRequest": {"scenario": SCENARIO, "strategies": ["lv"], "points": 200, "signals": [PAPER_SIGNALS[0]]},
    "FrequencyRequest": {"scenario": SCENARIO, "strategies": ["lqr", "passive"], "frequencies": [1, 5, 11]},
    "FuzzyRequest": {"scenario": {"fuzzy": {"rules": [{"if": {"speed_error": "V"}, "then": "V"}]}}},
    "SolveRequest": {
        "scenario": SCENARIO,
        "strategy": "passive",
        "field": "road.bump.height",
        "range": [0.01, 0.2],
        "metric": "bump.body_acceleration.peak",
        "limit": 4,
    },
    "BatchRequest": {
        "scenario": SCENARIO,
        "strategies": ["lqr", "passive"],
        "sweep": {"grid": {"road.bump.height": [0.05, 0.1]}},
    },
    "TuningRequest": {
        "scenario": SCENARIO,
        "strategy": "lqr",
        "trials": 2,
        "population": 2,
        "seeds": [1],
        "fresh_seeds": [2, 3],
    },
    "LinkRequest": {"run_id": "AAAAAAAAAAAAAAAAAAAAAA", "view": {"baseline": "passive", "axis": "time"}},
    "ControllerRequest": {"scenario": SCENARIO},
    "FmuRequest": {"scenario": SCENARIO, "strategy": "lqr", "platforms": ["linux64"]},
    "LabelRequest": {"label": "winter"},
    "DataSheet": {
        "front_axle_load": 760,
        "rear_axle_load": 640,
        "front_axle_mass": 70,
        "rear_axle_mass": 60,
        "wheelbase": 2.6,
        "front_frequency": 1.2,
        "rear_frequency": 1.4,
        "front_damping_ratio": 0.25,
        "rear_damping_ratio": 0.3,
        "front_tyre_stiffness": 200_000,
        "rear_tyre_stiffness": 200_000,
    },
    "LoginRequest": {"token": "0d1c7a4be8f2915c3366a0f4c1be7fd20a93b1c5de44f708"},
}
_MAKING = threading.Lock()  # making it takes seconds of a core: whoever asks meanwhile waits for that one
LINKS = {  # operations that take the id, by the operation that answers with it
    "createRun": ("200", "$response.body#/id", ["getRun", "getRunFigures", "getRunReport"]),
    "solve": ("200", "$response.body#/run_id", ["getRun", "getRunFigures", "getRunReport"]),
    "createBatch": (
        "202",
        "$response.body#/id",
        ["getBatch", "labelBatch", "cancelBatch", "resumeBatch", "deleteBatch", "getBatchResults", "getBatchTable"],
    ),
    "createTuning": (
        "202",
        "$response.body#/id",
        ["getTuning", "labelTuning", "cancelTuning", "resumeTuning", "deleteTuning", "getTuningTrials"],
    ),
    "createRecording": ("201", "$response.body#/id", ["getRecording"]),
    "createRoad": ("201", "$response.body#/id", ["getRoad"]),
    "createLink": ("201", "$response.body#/slug", ["getLink"]),
}


def describe(app: FastAPI) -> JsonObject:
    """The OpenAPI 3.1 description; it lists the strategies that there are at the moment."""
    with _MAKING:
        return _described(app, tuple(strategies()))[0]


def encoded(app: FastAPI) -> bytes:
    """The OpenAPI description as JSON, made once for all who ask at the same time."""
    with _MAKING:
        return _described(app, tuple(strategies()))[1]


@lru_cache(maxsize=1)
def _described(app: FastAPI, names: tuple[str, ...]) -> tuple[JsonObject, bytes]:
    whole = get_openapi(title=app.title, version=app.version, description=app.description, routes=app.routes)
    whole["tags"] = [{"name": name, "description": text} for name, text in TAGS.items()]
    components = whole["components"]
    problem = Problem.model_json_schema(ref_template="#/components/schemas/{model}", mode="serialization")
    components["schemas"] |= {**problem.pop("$defs"), "Problem": problem}
    components["headers"] = {name: {"schema": {"type": "string"}, **header} for name, header in HEADERS.items()}
    components["securitySchemes"] = {
        "token": {"type": "http", "scheme": "bearer", "description": "Where the service has a file of tokens"},
        "login": {"type": "apiKey", "in": "cookie", "name": COOKIE, "description": "What the page's login sets"},
    }
    for name, example in EXAMPLES.items():
        components["schemas"][name]["examples"] = [example]
    for name, schema in components["schemas"].items():
        _describe_fields(name, schema, components["schemas"])
    for schema in components["schemas"].values():
        for name, field in schema.get("properties", {}).items() if schema["title"] not in OF_ROWS else ():
            _name_strategies(name, field)
    for path, operation in _operations(whole):
        if path.startswith("/api/"):
            operation["security"] = [{}, {"token": []}, {"login": []}]
        for parameter in operation.get("parameters", []):
            _name_strategies(parameter["name"], parameter["schema"])
        _describe_answers(operation)
    _list_strategies(whole, list(names))
    return whole, json.dumps(whole, ensure_ascii=False, separators=(",", ":")).encode()


def _list_strategies(part: Any, names: list[str]) -> None:
    """Put these ids wherever ours are listed."""
    if isinstance(part, dict) and part.get("enum", [])[: len(STRATEGIES)] == list(STRATEGIES):
        part["enum"] = names + [each for each in part["enum"] if each is None]
    elif isinstance(part, dict | list):
        for each in part.values() if isinstance(part, dict) else part:
            _list_strategies(each, names)


def _describe_fields(model: str, schema: JsonObject, schemas: JsonObject) -> None:
    """Give the schema a title of its own, and each field without a description one."""
    schema["title"] = model.replace("-", "")  # Scenario-Input: what is sent may leave out what answers always have
    for name, field in schema.get("properties", {}).items():
        if "description" not in field:
            shown = _shown_model(field)
            of_shown = None if shown is None else schemas[shown]["description"].partition("\n")[0]
            if described := OF_MODELS.get(f"{model}.{name}") or of_shown or EVERYWHERE.get(name):
                field["description"] = described


def _shown_model(field: JsonObject) -> str | None:
    """The name of the schema that a field holds, or holds several of."""
    if "$ref" in field:
        return str(field["$ref"]).rpartition("/")[2]
    parts = (field.get("items"), field.get("additionalProperties"), *field.get("anyOf", ()), *field.get("oneOf", ()))
    return next((name for part in parts if isinstance(part, dict) and (name := _shown_model(part))), None)


def _operations(whole: JsonObject) -> Iterator[tuple[str, JsonObject]]:
    for path, operations in whole["paths"].items():
        for operation in operations.values():
            yield path, operation


def _describe_answers(operation: JsonObject) -> None:
    answers: dict[str, JsonObject] = operation["responses"]
    for status, answer in answers.items():
        content = answer.get("content", {})
        for media_type, described in content.items():
            described.setdefault("schema", {"type": "string"} if media_type.startswith("text/") else BYTES)
        if MEDIA_TYPE in content:
            kinds = [kind for kind in KINDS.values() if int(status) in kind.statuses]
            answer["description"] = " ".join(f"`{kind.name}`: {kind.meaning} {kind.remedy}" for kind in kinds)
        elif answer.get("description") == "Successful Response":
            answer["description"] = operation["description"].partition("\n")[0]
        names = [HEADER, *OF_STATUS.get(status, [])]
        if status == "204" and "login" in operation["tags"]:
            names.append("Set-Cookie")
        if status == "200" and "304" in answers:
            names.append("ETag")
        if status == "200" and any(media_type.partition(";")[0] in FILES for media_type in content):
            names.append("Content-Disposition")
        answer["headers"] = {name: {"$ref": f"#/components/headers/{name}"} for name in names}
    if operation["operationId"] in LINKS:
        status, expression, others = LINKS[operation["operationId"]]
        parameter = "slug" if expression.endswith("slug") else "id"
        answers[status]["links"] = {
            other: {"operationId": other, "parameters": {parameter: expression}} for other in others
        }


def _name_strategies(name: str, field: JsonObject) -> None:
    """List the strategies' names where a field holds one or several."""
    listed = "with commas" in field.get("description", "")  # several in one text
    if name in ("strategy", "baseline", "strategies") and not listed:
        for each in (field, field.get("items", {}), *field.get("anyOf", [])):
            if each.get("type") == "string" and "enum" not in each:
                simulated = name == "strategy" and "recording:" not in field.get("description", "")
                each["pattern"] = ID if simulated else STRATEGY_PATTERN  # perhaps of one that is there no more
            elif each.get("type") == "object":
                each["propertyNames"] = {"pattern": STRATEGY_PATTERN}
