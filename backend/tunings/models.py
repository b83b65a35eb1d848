"""The shapes of tuning requests."""

from collections.abc import Mapping
from typing import Annotated, Any, Self

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Field,
    ValidationError,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from backend.custom_controllers import registry as custom_controllers
from backend.jobs.models import Label
from backend.json_types import JsonObject
from backend.models import RequestModel, SentScenario, inconsistent
from backend.tunings.objectives import Limit, Objective
from backend.tunings.space import OURS, default_search, searchable, takes_previews, tunable_strategies
from backend.unknown_names import unknown_name
from sim_core import Preview, RidelabError
from sim_core.check_controller import ID
from sim_core.scenario import Scenario, dotted

ADDED = ("previews", "uncertain", "quantile")  # since 0.3.0: left out at their defaults, as requests before had none
MOST_TRIALS = 5000
MOST_POPULATION = 256
MOST_SEEDS = 64


def _increasing(ends: tuple[float, float]) -> tuple[float, float]:
    if not ends[0] < ends[1]:
        raise PydanticCustomError("empty_range", "A range is [lowest, highest], the first smaller than the second")
    return ends


def _each_once(items: list[Any]) -> list[Any]:
    if len(set(items)) != len(items):
        raise PydanticCustomError("repeated", "Each may be there once")
    return items


def _check_strategy(name: str) -> str:
    if name not in OURS and name not in (offered := tunable_strategies()):
        what = "strategy that can be tuned"
        raise PydanticCustomError("unknown_strategy", "{said}", {"said": unknown_name(what, name, offered)})
    return name


def _check_names(search: Any, info: ValidationInfo) -> Any:
    """Names first: what an unknown one holds is of no use, nor what one holds that is no number."""
    strategy = info.data.get("strategy")
    allowed = [] if strategy is None else searchable(strategy)
    for name in search if isinstance(search, dict) and strategy is not None else ():
        is_option = name.startswith(f"{dotted.OWN}{strategy}.") and name in dotted.fields()
        if name not in allowed and not is_option:
            context = {"key": name, "what": "weight or option", "allowed": allowed}
            raise PydanticCustomError("unknown_key", "Unknown weight or option", context)
        if name not in allowed:
            raise inconsistent("", "Numbers are tuned; sweep a switch or a choice instead", name)
    return search


WEIGHTS = list(dict.fromkeys(name for strategy in OURS for name in searchable(strategy)))
End = Annotated[float, Field(ge=-1e12, le=1e12)]
Range = Annotated[tuple[End, End], Field(strict=False), AfterValidator(_increasing)]
Seed = Annotated[int, Field(ge=0, le=2**32 - 1)]
Seeds = Annotated[list[Seed], AfterValidator(_each_once)]


class TuningRequest(RequestModel):
    """What to tune, for what, on which roads and cars."""

    scenario: SentScenario = Scenario()
    strategy: Annotated[str, AfterValidator(_check_strategy), WithJsonSchema({"type": "string", "pattern": ID})] = (
        Field("lv", description=f"{', '.join(OURS)}, or the id of a controller of one's own")
    )
    objectives: list[Objective] = Field([Objective(kind="paper")], min_length=1, max_length=3)
    limits: list[Limit] = Field([], max_length=8)
    search: Annotated[dict[str, Range] | None, BeforeValidator(_check_names)] = Field(
        None,
        min_length=1,
        max_length=16,
        description="Weight, option, horizon, sample time or what is expected of the preview -> [lowest, highest], "
        "searched on a logarithmic scale where both are above 0, whole numbers step by step; what is not named keeps "
        "the scenario's value. Without it every weight of the strategy, 0.05 to 50, or every option that has a "
        "smallest and a largest value.",
        json_schema_extra={"propertyNames": dotted.names_schema(WEIGHTS)},
    )
    previews: Annotated[list[Preview], AfterValidator(_each_once)] | None = Field(
        None, min_length=2, description="Kinds of preview to try; without it only the scenario's is used"
    )
    seeds: Seeds = Field([1, 2, 3, 4], min_length=1, max_length=MOST_SEEDS, description="Roads trained on")
    fresh_seeds: Seeds = Field(
        list(range(101, 111)), min_length=2, max_length=MOST_SEEDS, description="Roads compared on, none trained on"
    )
    uncertain: bool = Field(
        False,
        description="Every road also draws, by its seed, what a robustness study varies by default: the car, its "
        "sensors and actuators, none of which the controllers know",
    )
    quantile: float | None = Field(
        None, ge=0.5, le=1, description="Minimise this quantile over the training roads, 1 the worst, not the mean"
    )
    trials: int = Field(
        200, ge=1, le=MOST_TRIALS, description="Sets of weights, the paper's and the scenario's included"
    )
    population: int = Field(16, ge=1, le=MOST_POPULATION, description="Sets of weights tried at once: a generation")
    seed: int = Field(0, ge=0, le=2**32 - 1, description="Of the search: same request, same trials")
    label: Label = None
    dry_run: bool = Field(False, description="Only check and estimate: nothing is stored or computed")

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if self.scenario.road.profile is not None:
            raise inconsistent("scenario.road.profile", "A measured road is one road: there is none to compare on")
        if set(self.seeds) & set(self.fresh_seeds):
            raise inconsistent("fresh_seeds", "A fresh road is none that was trained on")
        written = [objective.stored() for objective in self.objectives]
        if any(each in written[:index] for index, each in enumerate(written)):
            raise inconsistent("objectives", "Each objective may be there once")
        if self.previews is not None and not takes_previews(self.strategy):
            raise inconsistent("previews", f"{self.strategy} has a preview of its own")
        if not self._searched:
            options = ", ".join(searchable(self.strategy))
            raise inconsistent(
                "search", f"No option of {self.strategy} has both ge and le: name ranges to search, of {options}"
            )
        self._check_ends()
        return self

    def _check_ends(self) -> None:
        """Both ends of what is searched fit the scenario, as all between them then does."""
        plain = self.scenario.model_dump(mode="json")
        for name, ends in self._searched.items():
            field = dotted.field(name)
            whole = field.kind == "integer"
            if whole and not all(float(end).is_integer() for end in ends):
                raise inconsistent("search", "Both ends have to be whole numbers", name)
            if ends[0] <= 0 and not dotted.is_option(name):
                raise inconsistent("search", "Both ends have to be greater than 0", name)
            for end in ends:
                try:
                    value = field.checked(int(end) if whole else end)
                    Scenario.model_validate(dotted.with_changes(plain, {name: value}))
                except ValidationError as error:
                    raise inconsistent("search", error.errors(include_input=False)[0]["msg"], name) from None
                except RidelabError as error:
                    raise inconsistent("search", error.message, name) from None

    @property
    def _searched(self) -> Mapping[str, Range]:
        return default_search(self.strategy) if self.search is None else self.search

    @property
    def ranges(self) -> dict[str, Range]:
        """Return what is searched, the default written out, in the strategy's order."""
        return {name: self._searched[name] for name in searchable(self.strategy) if name in self._searched}

    def stored(self) -> JsonObject:
        """Return it written out, without the number of trials, which resuming may change, and what `ADDED` says."""
        added = {name for name in ADDED if getattr(self, name) == type(self).model_fields[name].default}
        plain = self.model_dump(mode="json", exclude={"trials", "dry_run", "label", *added})
        options = {name: dotted.value(plain["scenario"], name) for name in self.ranges if dotted.is_option(name)}
        source = custom_controllers.source(self.strategy)
        return {
            **plain,
            "scenario": dotted.with_changes(
                plain["scenario"], options
            ),  # with the defaults that its controller has today
            **({} if source is None else {"source": source}),
            "objectives": [objective.stored() for objective in self.objectives],
            "search": {name: list(ends) for name, ends in self.ranges.items()},
        }
