"""Methods that submit, estimate, find and list batches and tunings."""

import uuid
from collections.abc import Mapping, Sequence
from typing import Any

from ridelab.connection import Connection, Scenario
from ridelab.jobs import Batch, Tuning
from ridelab.requirements import Requirement, required
from ridelab.results import quoted_id


class JobMethods(Connection):
    """Methods of `Ridelab` that make and find jobs; a job's own are in `Job`, `Batch` and `Tuning`."""

    def submit(
        self,
        scenario: Scenario,
        strategies: Sequence[str],
        sweep: Mapping[str, Any],
        idempotency_key: str | None = None,
        label: str | None = None,
        *,
        baseline: str | None = None,
        requirements: Sequence[Requirement] = (),
    ) -> Batch:
        """Submit a batch; it is committed when this returns.

        Args:
            scenario: What every run starts from.
            strategies: Ids; each point runs under all of them.
            sweep: One of `{"grid": {field: values}}`, `{"latin_hypercube": {"ranges": {field: [lo, hi]}, "samples":
                n, "seed": s}}` and `{"list": [{field: value}, ..]}`, fields by dotted name; with any of them
                `"linked": {field: [field, ..]}`, whose fields take the swept one's value.
            idempotency_key: The same key never makes a second batch; None is a key of this call's own.
            label: What to call it; lists find it by that.
            baseline: The strategy that changes of requirements refer to, at the same point.
            requirements: What its runs have to keep, as of `run`; `batch.requirement_results()` says how.
        """
        body = {"scenario": scenario, "strategies": strategies, "sweep": sweep, "label": label}
        body |= required(requirements, baseline)
        return Batch(self._http, self._post("/batches", body, idempotency_key or uuid.uuid4().hex))

    def estimate(self, scenario: Scenario, strategies: Sequence[str], sweep: Mapping[str, Any]) -> dict[str, Any]:
        """Return size and cost of a batch: `total`, `points`, `estimated_cost` [s of one core], `estimated_seconds`."""
        return self._post("/batches", {"scenario": scenario, "strategies": strategies, "sweep": sweep, "dry_run": True})

    def get_batch(self, batch_id: str) -> Batch:
        """A batch as it stands."""
        return Batch(self._http, self.get(f"/batches/{quoted_id(batch_id)}"))

    def batches(self, *, state: str | None = None, label: str | None = None, limit: int = 50) -> list[Batch]:
        """The newest batches first, without their sweeps; optionally only those in a state or with a label."""
        return [Batch(self._http, each) for each in self._listed("batches", state, label, limit)]

    def tune(self, request: Mapping[str, Any], idempotency_key: str | None = None) -> Tuning:
        """Begin to look for better weights; it is committed when this returns.

        Args:
            request: `{"scenario", "strategy", "objectives", "limits", "search", "seeds", "fresh_seeds", "trials",
                "population", "seed", "label"}`, each of which may be left out (docs/reference/api.md).
            idempotency_key: The same key never begins a second one; None is a key of this call's own.
        """
        return Tuning(self._http, self._post("/tunings", request, idempotency_key or uuid.uuid4().hex))

    def estimate_tuning(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Return size and cost of a tuning: `runs`, `generations`, and the rest as of `estimate`."""
        return self._post("/tunings", {**request, "dry_run": True})

    def get_tuning(self, tuning_id: str) -> Tuning:
        """A tuning as it stands."""
        return Tuning(self._http, self.get(f"/tunings/{quoted_id(tuning_id)}"))

    def tunings(self, *, state: str | None = None, label: str | None = None, limit: int = 50) -> list[Tuning]:
        """The newest tunings first, without what stands behind their scenario; as `batches`."""
        return [Tuning(self._http, each) for each in self._listed("tunings", state, label, limit)]
