"""The service's OpenAPI description: FastAPI's, with additions it cannot derive.

Headers, examples, links, tags, and what fields mean that are the same everywhere stand in description.json, not at
each route.
"""

import json
import threading
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from backend.digest import STRATEGY_PATTERN
from backend.http.middleware import ID_HEADER
from backend.http.problem_types import KINDS
from backend.http.problems import MEDIA_TYPE, Problem
from backend.http.tokens import COOKIE
from backend.json_types import JsonObject
from sim_core.check_controller import ID
from sim_core.strategies import STRATEGIES, strategies

OF_ROWS = frozenset({"EqualSpeed"})  # its `strategy` is a row's id
BYTES: JsonObject = {"type": "string", "format": "binary"}
FILES = frozenset({"text/csv", "application/zip", "text/html"})  # answers that come with a file's name

_MAKING = threading.Lock()  # making it takes seconds of a core: whoever asks meanwhile waits for that one
DESCRIPTION = json.loads(Path(__file__).with_name("description.json").read_text(encoding="utf-8"))
EXAMPLES: dict[str, JsonObject] = DESCRIPTION["examples"]  # of bodies, by their schema
FIELDS: dict[str, str] = DESCRIPTION["fields"]  # what they mean whose models do not say it, by name
FIELDS_OF_MODELS: dict[str, str] = DESCRIPTION["fields_of_models"]  # likewise, by model and name


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
    whole["tags"] = [{"name": name, "description": text} for name, text in DESCRIPTION["tags"].items()]
    components = whole["components"]
    problem = Problem.model_json_schema(ref_template="#/components/schemas/{model}", mode="serialization")
    components["schemas"] |= {**problem.pop("$defs"), "Problem": problem}
    components["headers"] = {
        name: {"schema": {"type": "string"}, **header} for name, header in DESCRIPTION["headers"].items()
    }
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
            if described := FIELDS_OF_MODELS.get(f"{model}.{name}") or of_shown or FIELDS.get(name):
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
        names = [ID_HEADER, *DESCRIPTION["headers_of_status"].get(status, [])]
        if status == "204" and "login" in operation["tags"]:
            names.append("Set-Cookie")
        if status == "200" and "304" in answers:
            names.append("ETag")
        if status == "200" and any(media_type.partition(";")[0] in FILES for media_type in content):
            names.append("Content-Disposition")
        answer["headers"] = {name: {"$ref": f"#/components/headers/{name}"} for name in names}
    if link := DESCRIPTION["links"].get(operation["operationId"]):  # operations that take the id that this one answers
        parameter = "slug" if link["expression"].endswith("slug") else "id"
        answers[link["status"]]["links"] = {
            other: {"operationId": other, "parameters": {parameter: link["expression"]}} for other in link["operations"]
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
