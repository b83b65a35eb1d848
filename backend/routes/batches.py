"""Batches: submit, follow, cancel, read."""

from collections.abc import Iterable
from typing import Annotated, Any, Literal

from fastapi import Depends, Header, Path, Query, Request, Response
from fastapi.responses import StreamingResponse

from backend.batches import models as models_batches
from backend.batches import robustness
from backend.batches.service import Batches
from backend.errors import InvalidError
from backend.models import Problem
from backend.routes import router
from backend.routes.deps import IMMUTABLE, Client, json_answer
from backend.routes.runs import MEDIA_TYPES
from backend.store.batches import FINAL
from sim_core.catalogue import METRICS, NUMBERS

EVENT = {  # each one of the stream
    "type": "object",
    "properties": {
        "id": {"type": "string"},
        "event": {"enum": ["state", "progress"]},
        "data": {"type": "string", "description": "JSON: state, done, failed, total"},
    },
    "required": ["id", "event", "data"],
}

submitting = router("batches", 400, 409, 413, 415, 422, 429, 503)
batches = router("batches", 404, 422, 503)


async def _batches(request: Request) -> Batches:
    service: Batches = request.app.state.batches
    return service


BatchesService = Annotated[Batches, Depends(_batches)]
BatchId = Annotated[str, Path(alias="id", description="22 characters", max_length=64)]
IdempotencyKey = Annotated[
    str | None,
    Header(
        min_length=1,
        max_length=255,
        pattern=r"^[\x21-\x7e]+$",
        description="The same key and body again answer the same batch, so that a lost answer can be asked for again",
    ),
]


@submitting.post(
    "/batches",
    operation_id="createBatch",
    status_code=202,
    response_model=models_batches.Batch,
    responses={200: {"model": models_batches.Estimate, "description": "Of a dry run"}},
)
async def create_batch(
    body: models_batches.BatchRequest,
    service: BatchesService,
    client: Client,
    idempotency_key: IdempotencyKey = None,
) -> Response:
    """Submit a sweep; 202 comes after the commit: what was accepted completes, whatever crashes."""
    if body.dry_run:
        return json_answer(await service.estimate(body.scenario, body.strategies, body.sweep, client))
    accepted = await service.create(body.scenario, body.strategies, body.sweep, idempotency_key, client)
    answer = json_answer(accepted, {"Location": f"/api/v1/batches/{accepted['id']}"})
    answer.status_code = 202
    return answer


@batches.get("/batches", operation_id="listBatches", response_model=models_batches.Batches)
async def list_batches(
    service: BatchesService, limit: Annotated[int, Query(ge=1, le=500, description="At most so many")] = 50
) -> Response:
    """The newest batches first."""
    return json_answer(await service.newest(limit))


@batches.get("/batches/{id}", operation_id="getBatch", response_model=models_batches.Batch)
async def get_batch(batch_id: BatchId, service: BatchesService) -> Response:
    """A batch as it stands."""
    return json_answer(await service.get(batch_id))


@batches.post("/batches/{id}/cancel", operation_id="cancelBatch", response_model=models_batches.Batch)
async def cancel_batch(batch_id: BatchId, service: BatchesService) -> Response:
    """Queued and running runs stop; finished results stay. A batch that has ended is answered as it is."""
    return json_answer(await service.cancel(batch_id))


@batches.get(
    "/batches/{id}/events",
    operation_id="getBatchEvents",
    response_class=StreamingResponse,
    responses={200: {"content": {"text/event-stream": {"schema": EVENT}}}, 429: {"model": Problem}},
)
async def get_batch_events(
    batch_id: BatchId,
    service: BatchesService,
    client: Client,
    last_event_id: Annotated[str | None, Header(description="The last number seen: a browser sends it")] = None,
    after: Annotated[int | None, Query(ge=0, le=2**31 - 1, description="The same, in the address")] = None,
) -> Response:
    """Server-sent events `state` and `progress` with `{state, done, failed, total}`; the last is the final state."""
    seen = (
        last_event_id if last_event_id is not None and last_event_id.isdecimal() and len(last_event_id) < 10 else None
    )
    stream = await service.events(batch_id, int(seen) if seen is not None else after or 0, client)
    headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
    return StreamingResponse(stream, headers=headers, media_type="text/event-stream")


@batches.get(
    "/batches/{id}/results",
    operation_id="getBatchResults",
    response_model=models_batches.BatchResults,
    responses={200: {"content": {"text/csv": {}, MEDIA_TYPES["parquet"]: {}}}},
)
async def get_batch_results(
    batch_id: BatchId,
    service: BatchesService,
    file_format: Annotated[Literal["json", "csv", "parquet"], Query(alias="format", description="Of it")] = "json",
) -> Response:
    """One row a run, in order, streamed; a batch that still runs has rows that wait."""
    batch, stream = await service.results(batch_id, file_format)
    headers = {"Cache-Control": IMMUTABLE if batch.state in FINAL else "no-store"}
    if file_format != "json":
        headers["Content-Disposition"] = f'attachment; filename="ridelab-batch-{batch.id}.{file_format}"'
    return StreamingResponse(stream, headers=headers, media_type=MEDIA_TYPES[file_format])


@batches.get("/batches/{id}/table", operation_id="getBatchTable", response_model=models_batches.BatchTable)
async def get_batch_table(
    batch_id: BatchId,
    service: BatchesService,
    figures: Annotated[str, Query(description="Keys with commas, such as bump.body_acceleration.peak")] = "",
) -> Response:
    """Rows column by column: run, strategy, status, reason, the swept fields and the figures asked for."""
    answer: dict[str, Any] = await service.table(batch_id, _figures(figures, METRICS))
    return json_answer(answer)


@batches.get(
    "/batches/{id}/summary",
    operation_id="getBatchSummary",
    response_model=models_batches.BatchSummary,
    responses={429: {"model": Problem}},
)
async def get_batch_summary(
    batch_id: BatchId,
    service: BatchesService,
    client: Client,
    figures: Annotated[
        str, Query(description="Keys with commas; without any the paper's eight, travel exceeded and airborne")
    ] = "",
    baseline: Annotated[
        str | None, Query(max_length=64, description="Strategy; without one LV, else the first")
    ] = None,
) -> Response:
    """Each figure's quantiles and extremes under each strategy, paired margins, what they follow, and stability.

    Over the runs that have finished. The worst place of a figure is its `highest`.
    """
    names = _figures(figures, NUMBERS) or list(robustness.FIGURES)
    return json_answer(await service.summary(batch_id, names, baseline, client))


@batches.get("/robustness", operation_id="getRobustnessDefaults", response_model=models_batches.RobustnessDefaults)
async def get_robustness_defaults() -> Response:
    """What a robustness study varies unless told otherwise: a batch over these ranges, read by its summary."""
    return json_answer(robustness.answer())


def _figures(text: str, known: Iterable[str]) -> list[str]:
    """The figures named, each once.

    Raises:
        InvalidError: One is unknown.
    """
    names = [name.strip() for name in text.split(",") if name.strip()]
    if not set(names) <= set(known):
        message = f"Unknown figure; there are {', '.join(known)}"
        raise InvalidError(message, parameter="figures")
    return list(dict.fromkeys(names))
