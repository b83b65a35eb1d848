"""What batches and tunings have in common: list, read, follow, name, cancel, delete."""

from collections.abc import AsyncIterator, Callable, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Protocol

from fastapi import APIRouter, Header, Path, Query, Response
from fastapi.responses import StreamingResponse
from pydantic import BaseModel

from backend.api.lists import DEFAULT_LIMIT, Cursor, Limit
from backend.api.routing import API, ApiRequest, json_answer, router
from backend.http import problems
from backend.jobs.models import LabelRequest
from backend.jobs.service import Jobs
from backend.plain_text import PlainText
from backend.services import Services
from backend.store import StoredJob
from backend.store.job import State

IdempotencyKey = Annotated[
    str | None,
    Header(
        min_length=1,
        max_length=255,
        pattern=r"^[\x21-\x7e]+$",
        description="The same key and body again answer the same job, so that a lost answer can be asked for again; "
        "after it was cancelled they begin a new one",
    ),
]
OWNERS: dict[int | str, dict[str, Any]] = {403: problems.ANSWER}  # of what only the owner of a job may do
JobId = Annotated[str, Path(alias="id", description="22 characters", max_length=64)]


class JobService(Protocol):
    """The service of one kind of job."""

    jobs: Jobs

    async def answer(self, job: StoredJob) -> BaseModel:
        """The job as it is answered."""

    async def page(self, *, limit: int, cursor: str | None, state: State | None, label: str | None) -> BaseModel:
        """The newest jobs."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JobApi:
    """One kind of job over HTTP.

    Attributes:
        service: Picks its `JobService`.
        name: What users call one, such as `batch`.
        plural: What they call several.
        model: Of one.
        page_model: Of a list.
        events: Kinds of events.
        event_data: What each event's data has.
    """

    service: Callable[[Services], JobService]
    name: str
    plural: str
    model: type[BaseModel]
    page_model: type[BaseModel]
    events: Sequence[str]
    event_data: str

    def routers(self) -> tuple[APIRouter, APIRouter, APIRouter]:
        """The routers of what every kind has: lists and one of them, others without a request body, those with one."""
        lists = router(self.plural, 404, 422, 503)
        without_body = router(self.plural, 404, 422, 503)
        with_body = router(self.plural, 400, 404, 413, 415, 422, 503)
        self._add_queries(lists)
        self._add_changing(without_body, with_body)
        self._add_events(without_body)
        return lists, without_body, with_body

    def _add_queries(self, lists: APIRouter) -> None:
        @lists.get(f"/{self.plural}", operation_id=f"list{self.plural.title()}", response_model=self.page_model)
        async def page(
            request: ApiRequest,
            limit: Limit = DEFAULT_LIMIT,
            cursor: Cursor = None,
            state: Annotated[State | None, Query(description="Only those in that state")] = None,
            label: Annotated[PlainText | None, Query(max_length=200, description="Only those with that label")] = None,
        ) -> Response:
            """The newest first, page by page."""
            service = self.service(request.services)
            return json_answer(await service.page(limit=limit, cursor=cursor, state=state, label=label))

        @lists.get(f"/{self.plural}/{{id}}", operation_id=f"get{self.name.title()}", response_model=self.model)
        async def get(job_id: JobId, request: ApiRequest) -> Response:
            """The job's present state; its events report changes."""
            service = self.service(request.services)
            return json_answer(await service.answer(await service.jobs.get(job_id)))

    def _add_changing(self, without_body: APIRouter, with_body: APIRouter) -> None:
        path, title = f"/{self.plural}/{{id}}", self.name.title()

        @with_body.patch(path, operation_id=f"label{title}", response_model=self.model, responses=OWNERS)
        async def set_label(job_id: JobId, body: LabelRequest, request: ApiRequest) -> Response:
            """Name it, or take its name away; with tokens only its owner may."""
            service = self.service(request.services)
            return json_answer(await service.answer(await service.jobs.set_label(job_id, body.label, request.token)))

        @without_body.delete(
            path, operation_id=f"delete{title}", status_code=204, responses={**OWNERS, 409: problems.ANSWER}
        )
        async def delete(job_id: JobId, request: ApiRequest) -> Response:
            """Remove one that has ended and that no link shows; with tokens only its owner may."""
            await self.service(request.services).jobs.delete(job_id, request.token)
            return Response(status_code=204)

        @without_body.post(f"{path}/cancel", operation_id=f"cancel{title}", response_model=self.model, responses=OWNERS)
        async def cancel(job_id: JobId, request: ApiRequest) -> Response:
            """Cancel it; finished runs stay. One that has ended is answered as it is. With tokens only by its owner."""
            service = self.service(request.services)
            return json_answer(await service.answer(await service.jobs.cancel(job_id, request.token)))

    def _add_events(self, without_body: APIRouter) -> None:
        event = {  # each one of the stream
            "type": "object",
            "properties": {
                "id": {"type": "string"},
                "event": {"enum": self.events},
                "data": {"type": "string", "description": f"JSON: {self.event_data}"},
            },
            "required": ["id", "event", "data"],
        }

        @without_body.get(
            f"/{self.plural}/{{id}}/events",
            operation_id=f"get{self.name.title()}Events",
            response_class=StreamingResponse,
            responses={200: {"content": {"text/event-stream": {"schema": event}}}, 429: problems.ANSWER},
        )
        async def get_events(
            job_id: JobId,
            request: ApiRequest,
            last_event_id: Annotated[str | None, Header(description="The last number seen: a browser sends it")] = None,
            after: Annotated[int, Query(ge=0, le=2**31 - 1, description="The same, in the address")] = 0,
        ) -> Response:
            """Server-sent events; the last one is the final state."""
            if last_event_id is not None and last_event_id.isdecimal() and len(last_event_id) < 10:
                after = int(last_event_id)
            jobs = self.service(request.services).jobs
            stream: AsyncIterator[bytes] = await jobs.events(job_id, after, request.client_id)
            headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
            return StreamingResponse(stream, headers=headers, media_type="text/event-stream")

    def accepted(self, answer: BaseModel, job: StoredJob) -> Response:
        """The answer 202 to a job that was accepted."""
        return json_answer(answer, {"Location": f"{API}/{self.plural}/{job.id}"}, status=202)


def key_of(owner: str | None, sent: str | None) -> str | None:
    """The idempotency key as it is stored: each token has keys of its own."""
    return sent if sent is None or owner is None else f"{owner} {sent}"
