"""A tuning of weights on a service: its points, and going on with it."""

from collections.abc import Mapping
from typing import Any, ClassVar, Self

from ridelab.jobs import Job

Trial = dict[str, Any]  # number, weights, values, limits, feasible, …, as the service sends it


class Tuning(Job):
    """A tuning of weights."""

    NAME: ClassVar[str] = "tuning"
    PLACE: ClassVar[str] = "/api/v1/tunings"

    @property
    def counts(self) -> Mapping[str, Any]:
        """Trials, by `total`, `done`, `failed` and `feasible`."""
        trials: Mapping[str, Any] = self.answer["trials"]
        return trials

    @property
    def feasible(self) -> int:
        """Trials within every limit."""
        return int(self.counts["feasible"])

    @property
    def paper(self) -> Trial | None:
        """The paper's weights; None until the first generation is complete."""
        return self.answer.get("paper")

    @property
    def best(self) -> list[Trial | None]:
        """Of each objective the feasible trial with its smallest value; None while there is none."""
        return list(self.answer["best"])

    @property
    def knee(self) -> Trial | None:
        """Of several objectives the point of the front nearest to its ideal corner."""
        return self.answer.get("knee")

    @property
    def front(self) -> list[Trial]:
        """Feasible trials that no other one betters."""
        return list(self.answer["front"])

    @property
    def comparison(self) -> dict[str, Any] | None:
        """The paper's weights and the tuned ones over the training roads and fresh ones; None until it is done."""
        return self.answer.get("comparison")

    def resume(self, trials: int | None = None) -> Self:
        """Go on where it stopped, perhaps with more trials in all.

        Raises:
            RidelabAPIError: There is nothing left to do (409), or a limit (422).
        """
        self.answer = self._http.document("POST", self._path("/resume"), params={"trials": trials})
        return self

    def trials(self) -> list[Trial]:
        """Every trial, in order."""
        trials: list[Trial] = self._http.document("GET", self._path("/trials"))["trials"]
        return trials

    def _take_in(self, data: Mapping[str, Any]) -> None:
        counts = {name: data[name] for name in self.counts}
        self.answer |= {name: data[name] for name in ("state", "step", "generation")} | {"trials": counts}
