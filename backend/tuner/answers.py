"""Stored tunings as they are answered."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from backend.store import StoredTuning
from backend.store.tunings import StoredTrial
from backend.tuner import front
from backend.tuner.objectives import objective_label, objective_unit
from backend.tuner.space import first_weights
from sim_core.catalogue import METRICS


def summary(tuning: StoredTuning) -> dict[str, Any]:
    """`TuningSummary`."""
    request = tuning.request
    return {
        "id": tuning.id,
        "state": tuning.state,
        "reason": tuning.reason,
        "step": tuning.step,
        "strategy": request["strategy"],
        "objectives": [
            {**each, "label": objective_label(each), "unit": objective_unit(each)} for each in request["objectives"]
        ],
        "limits": [
            {**each, "label": METRICS[each["figure"]].label, "unit": METRICS[each["figure"]].unit}
            for each in request["limits"]
        ],
        "search": request["search"],
        "seeds": request["seeds"],
        "fresh_seeds": request["fresh_seeds"],
        "population": request["population"],
        "seed": request["seed"],
        "trials": {
            "total": tuning.total,
            "done": tuning.done,
            "failed": tuning.failed,
            "feasible": tuning.feasible,
        },
        "generation": tuning.generation,
        "batch": tuning.batch_id,
        "core_version": tuning.core_version,
        "estimated_cost": tuning.estimated_cost,
        "created_at": tuning.created_at,
        "started_at": tuning.started_at,
        "finished_at": tuning.finished_at,
    }


def tuning(stored: StoredTuning, trials: Sequence[StoredTrial], history: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """`Tuning`: all its trials make the front, the events of its generations the history."""
    request = stored.request
    own = len(first_weights(request["scenario"], request["strategy"], request["search"])) > 1
    members = front.front(trials)
    best = [front.best(trials, index) for index in range(len(request["objectives"]))]
    return {
        **summary(stored),
        "scenario": request["scenario"],
        "paper": trial(trials[0]) if trials else None,
        "own": trial(trials[1]) if own and len(trials) > 1 else None,
        "best": [None if each is None else trial(each) for each in best],
        "knee": None if (found := front.knee(members)) is None else trial(found),
        "front": [trial(each) for each in members],
        "history": [_generation(told) for told in history],
        "comparison": stored.comparison,
    }


def trial(stored: StoredTrial) -> dict[str, Any]:
    """`Trial`."""
    return asdict(stored)


def _generation(told: Mapping[str, Any]) -> dict[str, Any]:
    """`Generation` from what its event told; the event counts those that are complete."""
    return {
        "generation": told["generation"] - 1,
        "trials": told["done"] + told["failed"],
        "feasible": told["feasible"],
        "best": told["best"],
        "hypervolume": told["hypervolume"],
    }
