"""A tuning of weights on a service: follow it, stop it, go on with it, take its points."""

from collections.abc import Mapping
from typing import Any, ClassVar, Self

from backend.client.followed import Followed

Trial = dict[str, Any]  # number, weights, values, limits, feasible, …, as the service sends it


class Tuning(Followed):
    """A tuning as it was last heard of; `answer` has all of it."""

    PLACE: ClassVar[str] = "/api/v1/tunings"

    @property
    def total(self) -> int:
        """Trials wanted."""
        return int(self._answer["trials"]["total"])

    @property
    def done(self) -> int:
        """Trials that have values."""
        return int(self._answer["trials"]["done"])

    @property
    def failed(self) -> int:
        """Trials that could not be run; each says why."""
        return int(self._answer["trials"]["failed"])

    @property
    def feasible(self) -> int:
        """Trials within every limit."""
        return int(self._answer["trials"]["feasible"])

    @property
    def paper(self) -> Trial | None:
        """The paper's weights; None until the first generation is complete."""
        found: Trial | None = self._answer["paper"]
        return found

    @property
    def best(self) -> list[Trial | None]:
        """Of each objective the feasible trial with its smallest value; None while there is none."""
        return list(self._answer["best"])

    @property
    def knee(self) -> Trial | None:
        """Of several objectives the point of the front nearest to its ideal corner."""
        found: Trial | None = self._answer["knee"]
        return found

    @property
    def front(self) -> list[Trial]:
        """Feasible trials that no other one betters."""
        return list(self._answer["front"])

    @property
    def comparison(self) -> dict[str, Any] | None:
        """The paper's weights and the tuned ones over the training roads and fresh ones; None until it is done."""
        found: dict[str, Any] | None = self._answer["comparison"]
        return found

    def __repr__(self) -> str:
        return f"Tuning({self.id}: {self.state}, {self.done} done, {self.failed} failed of {self.total})"

    def resume(self, trials: int | None = None) -> Self:
        """Go on where it stopped, perhaps with more trials in all.

        Raises:
            RidelabAPIError: The service refused: there is nothing left to do (409), or a limit (422).
            RidelabConnectionError: No answer.
        """
        self._answer = self._http.json("POST", self._path("/resume"), params={"trials": trials})
        return self

    def trials(self) -> list[Trial]:
        """Every trial, in order.

        Raises:
            RidelabAPIError: The service refused.
            RidelabConnectionError: No answer.
        """
        found: list[Trial] = self._http.json("GET", self._path("/trials"))["trials"]
        return found

    def _heard(self, told: Mapping[str, Any]) -> None:
        counts = {name: told[name] for name in self._answer["trials"]}
        self._answer |= {name: told[name] for name in ("state", "step", "generation")} | {"trials": counts}
