"""The shapes of share links: what is asked for, and what a link opens."""

from datetime import datetime
from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    ConfigDict,
    Field,
    ValidationError,
    ValidatorFunctionWrapHandler,
    WrapValidator,
    model_validator,
)
from pydantic_core import PydanticCustomError

from backend.batches.models import Batch
from backend.models import Answer, RequestModel, StrategyId, inconsistent
from backend.plain_text import PlainText
from backend.requirements import Requirement, Requirements
from backend.runs.models import RoadsRun, Run
from sim_core.catalogue import METRIC_SIGNALS, METRICS, RUN_FIGURES, STATISTICS, WINDOWS
from sim_core.scenario import Scenario

SLUG_PATTERN = "^[A-Za-z0-9_-]{22}$"

MAX_PINS = 8

Finite = Annotated[float, Field(allow_inf_nan=False)]
Names = Annotated[list[StrategyId], Field(max_length=32)]  # as many as a run may have
Id = Annotated[str, Field(pattern=SLUG_PATTERN)]


def _ascending(ends: tuple[float, float]) -> tuple[float, float]:
    if ends[0] >= ends[1]:
        raise PydanticCustomError("not_ascending", "The first end has to be less than the second")
    return ends


def _check_column(name: str) -> str:
    if name not in METRICS:
        raise PydanticCustomError(
            "unknown_column",
            "Unknown figure; there are window.signal.statistic with {windows}, {signals} and {statistics}, "
            "comfort.*, events.* and {figures}",
            {
                "windows": "|".join(WINDOWS),
                "signals": "|".join(METRIC_SIGNALS),
                "statistics": "|".join(STATISTICS),
                "figures": ", ".join(RUN_FIGURES),
            },
        )
    return name


Column = Annotated[str, AfterValidator(_check_column)]


class LinkPin(RequestModel):
    """A run that the shared one is compared with, by a name."""

    name: PlainText = Field(min_length=1, max_length=80)
    run: Id


class LinkInstant(RequestModel):
    """The control step at which the page says why the force is what it is."""

    strategy: StrategyId
    position: Finite = Field(description="Place of the front axle [m].")


def _number_or_none(value: Any, read: ValidatorFunctionWrapHandler) -> Any:
    """One error at the field, in place of one for each member of the union."""
    try:
        return read(value)
    except ValidationError:
        raise PydanticCustomError("number_or_none", "This has to be a number, or none for no line") from None


class LinkView(RequestModel):
    """How the page shows a run or a batch; for omitted members it uses its defaults. Answered as it was sent."""

    strategies: Names | None = Field(None, description="Shown, in this order.")
    hidden: Names | None = Field(None, description="Of those shown, the ones switched off in the plots.")
    baseline: StrategyId | None = Field(None, description="What changes in % are against.")
    axis: Literal["distance", "time"] | None = Field(None, description="What is on the x axis.")
    # strict=False on the tuple alone: JSON has arrays only. The numbers inside stay strict.
    zoom: Annotated[tuple[Finite, Finite], Field(strict=False), AfterValidator(_ascending)] | None = Field(
        None, description="Range of the x axis, [m] or [s]; null is all."
    )
    cursor: Finite | None = Field(None, description="Place on the x axis, [m] or [s]; null is none.")
    pins: Annotated[list[LinkPin], Field(max_length=MAX_PINS)] | None = Field(
        None, description="Of a run only: runs it is compared with. The link keeps them as it keeps its own."
    )
    reference: Id | None = Field(
        None, description="Of a run only: of which pin, by its run, changes in % are against; null is the baseline."
    )
    differences: bool | None = Field(
        None, description="Of a run only: whether plots show differences to what changes are against."
    )
    instant: LinkInstant | None = Field(
        None, description="Of a run only: where the page opens on why a force was what it was."
    )
    x: str | None = Field(None, max_length=255, description="Of a batch only: the field on the x axis, dotted.")
    y: Column | None = Field(None, description="Of a batch only: the metric on the y axis, or of the map.")
    plot: Literal["points", "map", "trade_off"] | None = Field(
        None, description="Of a batch only: runs over a field, a metric over two fields, or one metric over another."
    )
    strategy: StrategyId | None = Field(None, description="Of a batch only: whose map it is.")
    against: StrategyId | None = Field(
        None, description="Of a batch only: the strategy that map is compared with, or `none`."
    )
    threshold: Annotated[Finite | Literal["none"], WrapValidator(_number_or_none)] | None = Field(
        None, description="Of a batch only: where the map has a line, in the unit shown; `none` for no line."
    )
    versus: Column | None = Field(None, description="Of a batch only: the metric on the x axis of a trade-off.")


class LinkRequest(RequestModel):
    """What to share: a stored run or a batch, and how it is looked at."""

    run_id: Id | None = None
    batch_id: Id | None = None
    view: LinkView = LinkView()
    requirements: Requirements = Field([])

    @model_validator(mode="after")
    def _one_target(self) -> Self:
        if (self.run_id is None) == (self.batch_id is None):
            raise inconsistent("run_id", "Exactly one of run_id and batch_id has to be given")
        for name in ("pins", "reference", "differences"):
            if self.run_id is None and getattr(self.view, name) is not None:
                raise inconsistent(f"view.{name}", "Only the view of a run has this field")
        if self.view.reference is not None and all(pin.run != self.view.reference for pin in self.view.pins or []):
            raise inconsistent("view.reference", "This has to be the run of one of the pins")
        for name in ("x", "y", "plot", "strategy", "against", "threshold", "versus"):
            if self.batch_id is None and getattr(self.view, name) is not None:
                raise inconsistent(f"view.{name}", "Only the view of a batch has this field")
        return self


class CreatedLink(Answer):
    """A new link."""

    slug: str = Field(description="22 characters, 128 random bits")
    url: str = Field(description="Address of the page that opens it, at the name by which the service was asked")
    series_pinned: bool = Field(
        description="Whether the link stores time histories too. Never of a batch; of a run of another core version "
        "only where an earlier link pinned them. Metrics always are."
    )


class LinkHead(Answer):
    """A link in a list."""

    slug: str
    url: str
    kind: Literal["run", "batch"]
    run_id: str | None = Field(description="The run that it opens; null of a batch, and where it was taken back")
    batch_id: str | None
    created_at: datetime
    revoked_at: datetime | None = Field(description="When it was taken back; null of one that opens")


class LinkPage(Answer):
    """The newest links."""

    links: list[LinkHead]
    next: str | None = Field(description="Cursor of the next page; null: this is the last one")


class Link(Answer):
    """The contents of a link."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    slug: str
    url: str
    created_at: datetime = Field(description="When the link was created")
    kind: Literal["run", "batch"]
    core_version: str = Field(description="Which computed it")
    computed_at: datetime = Field(description="When; of a batch that still runs, when it was accepted")
    current_core_version: str = Field(description="Which the service runs")
    schema_version: int = Field(description="Which the scenario was stored under; `scenario` is today's")
    scenario: Scenario
    view: LinkView = Field(description="As it was sent")
    run: Run | RoadsRun | None
    batch: Batch | None
    series_pinned: bool
    damaged_at: datetime | None = Field(
        description="When something stored that the link shows was found damaged; since then it shows what "
        "`core_version` computed again, which may differ from what was shared. null where nothing was"
    )
    requirements: list[Requirement] = Field(
        [], description="What it was shared with; only where there were some: `run.requirement_results` says how"
    )
