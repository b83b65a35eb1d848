"""`ridelab fields`, `metrics`, `strategies`, `presets`, `vehicles`, `problems`: the names a script needs."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.reporting import InputError, print_json, show_table, shown
from ridelab.cli.service import Services
from ridelab.fields import fields_of

_WORDS = "Only those that have all these words in what is said of them."
Words = Annotated[list[str] | None, typer.Argument(metavar="[WORD]...", help=_WORDS)]
_PARTS = ("unit", "default", "minimum", "maximum", "choices")


def fields(services: Services, words: Words = None, as_json: options.AsJson = False) -> None:
    """List the scenario's fields: unit, the paper's value, range or choices, and what each is."""
    listed = [_field(name, schema) for name, schema in fields_of(services.quick.get("/schema")).items()]
    _show(listed, ("name", "unit", "default", "range", "title"), words, as_json=as_json)


def metrics(services: Services, words: Words = None, as_json: options.AsJson = False) -> None:
    """List the metrics by the flat names that --metric, --limit and compare take, each with its unit."""
    listed = [{"name": name, "unit": unit} for name, unit in services.quick.units.items()]
    _show(listed, ("name", "unit"), words, as_json=as_json)


def strategies(services: Services, words: Words = None, as_json: options.AsJson = False) -> None:
    """List the strategies that --strategy takes."""
    _named(services.at().get("/strategies"), words, as_json=as_json)


def presets(services: Services, words: Words = None, as_json: options.AsJson = False) -> None:
    """List the presets: complete scenarios that stand in the place of SCENARIO."""
    _named(services.quick.get("/presets"), words, as_json=as_json)


def vehicles(services: Services, words: Words = None, as_json: options.AsJson = False) -> None:
    """List the vehicles that --set vehicle=NAME takes; `ridelab vehicle NAME` shows one."""
    _named(list(services.quick.vehicles().values()), words, as_json=as_json)


def problems(services: Services, words: Words = None, as_json: options.AsJson = False) -> None:
    """List the kinds of problem that the service answers with, and what to do about each."""
    _show(services.at().get("/problems"), ("name", "statuses", "meaning", "remedy"), words, as_json=as_json)


LISTS = (fields, metrics, strategies, presets, vehicles, problems)


def _named(entries: Sequence[Mapping[str, Any]], words: Sequence[str] | None, *, as_json: bool) -> None:
    _show([{"name": each["id"], **each} for each in entries], ("name", "label", "description"), words, as_json=as_json)


def _field(name: str, schema: Mapping[str, Any]) -> dict[str, Any]:
    """A field's unit, default, limits and choices; None where it has none of that."""
    value = next((each for each in schema.get("anyOf", ()) if each.get("type") != "null"), schema)
    merged = {**value, **schema, "choices": value.get("enum")}
    low, high = merged.get("minimum"), merged.get("maximum")
    span = shown(merged["choices"]) if merged["choices"] else "" if low is None else f"{shown(low)} .. {shown(high)}"
    parts = {part: merged.get(part) for part in _PARTS}
    texts = {"title": schema["title"], "description": schema["description"]}
    return {"name": name, **parts, "range": span, **texts, "search_words": schema.get("search_words", [])}


def _has_words(entry: Mapping[str, Any], keys: Sequence[str], asked: Sequence[str]) -> bool:
    """Check whether all words stand in the entry, or in the words and whole phrases that people look for it by."""
    terms = [term.split() for term in entry.get("search_words", ())]
    single = [term[0] for term in terms if len(term) == 1]
    text = " ".join([*(str(entry.get(key)) for key in keys), *single]).casefold()
    in_phrases = {word for term in terms if len(term) > 1 and set(term) <= set(asked) for word in term}
    return all(word in text or word in in_phrases for word in asked)


def _show(
    entries: Sequence[Mapping[str, Any]], columns: Sequence[str], words: Sequence[str] | None, *, as_json: bool
) -> None:
    asked = [word.casefold() for text in words or () for word in text.split()]
    matching = [each for each in entries if _has_words(each, (*columns, "description"), asked)]
    if not matching:
        raise InputError(f"Nothing here has {' and '.join(words or ())}")
    if as_json:
        print_json(matching)
    else:
        show_table(columns, [[each[column] for column in columns] for each in matching])
