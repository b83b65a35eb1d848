"""Tunings: begin, follow, cancel, resume, read."""

from typing import Annotated

from fastapi import Depends, Header, Path, Query, Request, Response
from fastapi.responses import StreamingResponse

from backend.http.routing import ScenarioRoute
from backend.models import Problem
from backend.routes import router
from backend.routes.batches import IdempotencyKey
from backend.routes.deps import Client, json_answer
from backend.tuner import models as models_tuner
from backend.tuner.service import Tunings

EVENT = {  # each one of the stream
    "type": "object",
    "properties": {
        "id": {"type": "string"},
        "event": {"enum": ["state", "progress", "restart"]},
        "data": {
            "type": "string",
            "description": "JSON: state, step, generation, total, done, failed, feasible; progress also best and "
            "hypervolume",
        },
    },
    "required": ["id", "event", "data"],
}

beginning = router("tunings", 400, 409, 413, 415, 422, 429, 503, route_class=ScenarioRoute)
tunings = router("tunings", 404, 422, 503)


async def _tunings(request: Request) -> Tunings:
    service: Tunings = request.app.state.tunings
    return service


TuningsService = Annotated[Tunings, Depends(_tunings)]
TuningId = Annotated[str, Path(alias="id", description="22 characters", max_length=64)]


@beginning.post(
    "/tunings",
    operation_id="createTuning",
    status_code=202,
    response_model=models_tuner.Tuning,
    responses={200: {"model": models_tuner.TuningEstimate, "description": "Of a dry run"}},
)
async def create_tuning(
    body: models_tuner.TuningRequest,
    service: TuningsService,
    client: Client,
    idempotency_key: IdempotencyKey = None,
) -> Response:
    """Begin to look for better weights; 202 comes after the commit: what was accepted completes, whatever crashes."""
    if body.dry_run:
        return json_answer(await service.estimate(body, client))
    accepted = await service.create(body, idempotency_key)
    answer = json_answer(accepted, {"Location": f"/api/v1/tunings/{accepted['id']}"})
    answer.status_code = 202
    return answer


@tunings.get("/tunings", operation_id="listTunings", response_model=models_tuner.Tunings)
async def list_tunings(
    service: TuningsService, limit: Annotated[int, Query(ge=1, le=500, description="At most so many")] = 50
) -> Response:
    """The newest tunings first, without their scenarios and results."""
    return json_answer(await service.newest(limit))


@tunings.get("/tunings/{id}", operation_id="getTuning", response_model=models_tuner.Tuning)
async def get_tuning(tuning_id: TuningId, service: TuningsService) -> Response:
    """A tuning as it stands: the best weights so far, the front, how it got there, in the end the comparison."""
    return json_answer(await service.get(tuning_id))


@tunings.get("/tunings/{id}/trials", operation_id="getTuningTrials", response_model=models_tuner.Trials)
async def get_tuning_trials(tuning_id: TuningId, service: TuningsService) -> Response:
    """Every trial of the complete generations, in order."""
    return json_answer(await service.trials(tuning_id))


@tunings.post("/tunings/{id}/cancel", operation_id="cancelTuning", response_model=models_tuner.Tuning)
async def cancel_tuning(tuning_id: TuningId, service: TuningsService) -> Response:
    """It stops; what its complete generations found stays. One that has ended is answered as it is."""
    return json_answer(await service.cancel(tuning_id))


@tunings.post(
    "/tunings/{id}/resume",
    operation_id="resumeTuning",
    response_model=models_tuner.Tuning,
    responses={409: {"model": Problem}},
)
async def resume_tuning(
    tuning_id: TuningId,
    service: TuningsService,
    trials: Annotated[
        int | None,
        Query(ge=1, le=models_tuner.MOST_TRIALS, description="In all; without it as many as were asked for before"),
    ] = None,
) -> Response:
    """One that has ended goes on where it stopped, perhaps with more trials; one under way is answered as it is."""
    return json_answer(await service.resume(tuning_id, trials))


@tunings.get(
    "/tunings/{id}/events",
    operation_id="getTuningEvents",
    response_class=StreamingResponse,
    responses={200: {"content": {"text/event-stream": {"schema": EVENT}}}, 429: {"model": Problem}},
)
async def get_tuning_events(
    tuning_id: TuningId,
    service: TuningsService,
    client: Client,
    last_event_id: Annotated[str | None, Header(description="The last number seen: a browser sends it")] = None,
    after: Annotated[int | None, Query(ge=0, le=2**31 - 1, description="The same, in the address")] = None,
) -> Response:
    """Server-sent events `state`, `progress` (a generation) and `restart`; the last is the final state."""
    seen = (
        last_event_id if last_event_id is not None and last_event_id.isdecimal() and len(last_event_id) < 10 else None
    )
    stream = await service.events(tuning_id, int(seen) if seen is not None else after or 0, client)
    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(stream, headers=headers, media_type="text/event-stream")
