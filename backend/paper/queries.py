"""The query parameters of the paper page: roads, and how the paper is read."""

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, create_model

from backend.models import RequestModel
from backend.paper.claims import SEEDS
from backend.paper.interpretations import DEFAULT, INTERPRETATIONS, OPEN_QUESTIONS

Seeds = Annotated[int, Field(ge=20, le=100, description="How many roads every strategy drives")]
FirstSeed = Annotated[int, Field(ge=1, le=1_000_000, description="The first road's seed; the others follow it")]


class RoadsQuery(RequestModel):
    """The roads that every strategy drives."""

    model_config = ConfigDict(strict=False)

    seeds: Seeds = SEEDS
    first_seed: FirstSeed = 1

    @property
    def roads(self) -> range:
        """Their seeds."""
        return range(self.first_seed, self.first_seed + self.seeds)


class _Query(RoadsQuery):
    interpretation: Literal[tuple(INTERPRETATIONS)] = Field(  # type: ignore[valid-type]  # from the core
        DEFAULT.id, description="A named set of readings; single ones beside it override it"
    )

    def choices(self) -> dict[str, str]:
        """Question -> choice, all of them."""
        single = {name: getattr(self, name) for name in OPEN_QUESTIONS}
        return INTERPRETATIONS[self.interpretation].choices | {
            name: choice for name, choice in single.items() if choice is not None
        }


class _PartialQuery(_Query):
    partial: bool = Field(False, description="Answer at once with the cells that are there; the others are `pending`")


_CHOICES: dict[str, Any] = {
    reading.id: (
        Literal[tuple(choice.id for choice in reading.choices)] | None,
        Field(None, description=f"{reading.title}: {reading.description} By default as the interpretation has it."),
    )
    for reading in OPEN_QUESTIONS.values()
}
ReportQuery = create_model("ReportQuery", __base__=_Query, **_CHOICES)
PaperQuery = create_model("PaperQuery", __base__=_PartialQuery, **_CHOICES)
