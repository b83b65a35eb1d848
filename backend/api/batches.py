"""Batches: submit, follow, cancel, read."""

from typing import Annotated

from fastapi import Query, Response

from backend.api import jobs
from backend.api.lists import names_in
from backend.api.routing import ApiRequest, ends_with_client, json_answer, router
from backend.batches import models, robustness
from backend.batches.points import Sweep
from backend.batches.summary_models import RobustnessDefaults
from backend.batches.table import Page
from backend.file_formats import MEDIA_TYPES, FileFormat
from backend.http import problems
from backend.http.answers import Download, content_answer
from sim_core.catalogue import METRICS, NUMBERS, PAPER_METRICS

api = jobs.JobApi(
    service=lambda services: services.batches,
    name="batch",
    plural="batches",
    model=models.Batch,
    page_model=models.Batches,
    events=["state", "progress"],
    event_data="state, done, failed, total",
)
submitting = router(api.plural, 400, 409, 413, 415, 422, 429, 503)
reading = router(api.plural, 404, 422, 429, 503, computes=True)
lists, batches, naming = api.routers()


@submitting.post(
    "/batches",
    operation_id="createBatch",
    status_code=202,
    response_model=models.Batch,
    responses={200: {"model": models.Estimate, "description": "Of a dry run"}},
)
async def create_batch(
    body: models.BatchRequest, request: ApiRequest, idempotency_key: jobs.IdempotencyKey = None
) -> Response:
    """Submit a sweep; 202 comes at once, after the commit: what was accepted completes, whatever crashes.

    It is planned then: what a dry run would refuse ends it as failed, with the same `problem`.
    """
    batch = (body.scenario, body.strategies, body.sweep)
    if body.dry_run:
        async with ends_with_client(request):
            return json_answer(await request.services.batches.estimate(*batch, request.client_id))
    job = await request.services.batches.create(
        *batch,
        key=jobs.key_of(request.token, idempotency_key),
        label=body.label,
        owner=request.token,
        baseline=body.baseline,
        requirements=body.requirements,
    )
    return api.accepted(await request.services.batches.answer(job), job)


@batches.post(
    "/batches/{id}/resume",
    operation_id="resumeBatch",
    response_model=models.Batch,
    responses={**jobs.OWNERS, 409: problems.ANSWER},
)
async def resume_batch(request: ApiRequest, job_id: jobs.JobId) -> Response:
    """What was cancelled of it, or failed for a reason that may have passed, is computed; with tokens its owner may."""
    return json_answer(
        await request.services.batches.answer(await request.services.batches.resume(job_id, request.token))
    )


@batches.get("/batches/{id}/sweep", operation_id="getBatchSweep", response_model=Sweep)
async def get_batch_sweep(request: ApiRequest, job_id: jobs.JobId) -> Response:
    """The sweep as it was sent, its fields by dotted names."""
    return json_answer(await request.services.batches.sweep(job_id))


@reading.get(
    "/batches/{id}/results",
    operation_id="getBatchResults",
    response_model=models.BatchResults,
    responses={200: {"content": {"text/csv": {}}}},
)
async def get_batch_results(
    job_id: jobs.JobId,
    request: ApiRequest,
    file_format: Annotated[
        FileFormat | None, Query(alias="format", description="Without it CSV where Accept has `text/csv`, else JSON")
    ] = None,
    limit: Annotated[int | None, Query(ge=1, le=1_000_000, description="At most so many rows")] = None,
    cursor: Annotated[int, Query(ge=0, le=1_000_000, description="`next` of the page before")] = 0,
) -> Response:
    """One row a run, in order, streamed; a batch that still runs has rows that wait."""
    file_format = file_format or ("csv" if "text/csv" in request.headers.get("accept", "") else "json")
    batch, stream, counted = await request.services.batches.results(
        job_id, file_format, request.client_id, Page(first=cursor, limit=limit)
    )
    headers = {"Cache-Control": "no-store"}
    if file_format != "json":
        headers["Content-Disposition"] = f'attachment; filename="ridelab-batch-{batch.id}.{file_format}"'
    return Download(stream, counted, headers=headers, media_type=MEDIA_TYPES[file_format])


@reading.get("/batches/{id}/table", operation_id="getBatchTable", response_model=models.BatchTable)
async def get_batch_table(
    request: ApiRequest,
    job_id: jobs.JobId,
    figures: Annotated[str, Query(description=f"Keys with commas, such as {PAPER_METRICS[4]}")] = "",
) -> Response:
    """Rows column by column: run, strategy, status, reason, the swept fields and the figures asked for."""
    return content_answer(
        await request.services.batches.table(job_id, names_in("figures", figures, METRICS) or [], request.client_id),
        {},
        MEDIA_TYPES["json"],
    )


@reading.get("/batches/{id}/requirements", operation_id="getBatchRequirements", response_model=models.BatchRequirements)
async def get_batch_requirements(request: ApiRequest, job_id: jobs.JobId) -> Response:
    """How the runs keep the batch's requirements: counts, where each first fails, and the worst of each run."""
    return json_answer(await request.services.batches.requirements(job_id))


@batches.get(
    "/batches/{id}/summary",
    operation_id="getBatchSummary",
    response_model=models.BatchSummary,
    responses={429: problems.ANSWER},
)
async def get_batch_summary(
    request: ApiRequest,
    job_id: jobs.JobId,
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
    names = names_in("figures", figures, NUMBERS) or list(robustness.FIGURES)
    return json_answer(await request.services.batches.summary(job_id, names, baseline, request.client_id))


@batches.get("/robustness", operation_id="getRobustnessDefaults", response_model=RobustnessDefaults)
async def get_robustness_defaults() -> Response:
    """The uncertain fields of a robustness study by default: a batch over these ranges, read by its summary."""
    return json_answer(robustness.defaults())
