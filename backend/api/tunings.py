"""Tunings: begin, resume, read."""

from typing import Annotated

from fastapi import Query, Response

from backend.api import jobs
from backend.api.routing import SCENARIO_VALUES, ApiRequest, json_answer, router
from backend.http import problems
from backend.tunings.answers import Trials, Tuning, TuningEstimate, Tunings
from backend.tunings.models import MOST_TRIALS, TuningRequest

api = jobs.JobApi(
    service=lambda services: services.tunings,
    name="tuning",
    plural="tunings",
    model=Tuning,
    page_model=Tunings,
    events=["state", "progress", "restart"],
    event_data="state, step, generation, total, done, failed, feasible; progress also best and hypervolume",
)
beginning = router(api.plural, 400, 409, 413, 415, 422, 429, 503, computes=True, max_values=SCENARIO_VALUES)
lists, tunings, naming = api.routers()


@beginning.post(
    "/tunings",
    operation_id="createTuning",
    status_code=202,
    response_model=Tuning,
    responses={200: {"model": TuningEstimate, "description": "Of a dry run"}},
)
async def create_tuning(
    body: TuningRequest, request: ApiRequest, idempotency_key: jobs.IdempotencyKey = None
) -> Response:
    """Begin to look for better weights; 202 comes after the commit: what was accepted completes, whatever crashes."""
    if body.dry_run:
        return json_answer(await request.services.tunings.estimate(body, request.client_id))
    job = await request.services.tunings.create(body, jobs.key_of(request.token, idempotency_key), request.token)
    return api.accepted(await request.services.tunings.answer(job), job)


@tunings.get("/tunings/{id}/trials", operation_id="getTuningTrials", response_model=Trials)
async def get_tuning_trials(request: ApiRequest, job_id: jobs.JobId) -> Response:
    """Every trial of the complete generations, in order."""
    return json_answer(await request.services.tunings.trials(job_id))


@tunings.post(
    "/tunings/{id}/resume",
    operation_id="resumeTuning",
    response_model=Tuning,
    responses={**jobs.OWNERS, 409: problems.ANSWER},
)
async def resume_tuning(
    request: ApiRequest,
    job_id: jobs.JobId,
    trials: Annotated[
        int | None, Query(ge=1, le=MOST_TRIALS, description="In all; without it as many as were asked for before")
    ] = None,
) -> Response:
    """One that has ended goes on where it stopped, perhaps with more trials; one under way is answered as it is.

    With tokens only its owner may.
    """
    return json_answer(
        await request.services.tunings.answer(await request.services.tunings.resume(job_id, trials, request.token))
    )
