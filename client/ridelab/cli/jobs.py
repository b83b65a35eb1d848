"""`ridelab jobs`: batches and tunings on a service, whichever program submitted them."""

from typing import Annotated, Any

import typer

from ridelab.cli import options, targets
from ridelab.cli.following import finished, follow_to_end, resume_command, say_end
from ridelab.cli.reporting import note, print_json, say, show_table
from ridelab.cli.service import Services
from ridelab.jobs import Job

JobId = Annotated[str, typer.Argument(metavar="JOB", help="Id of a batch or a tuning.")]
JobIds = Annotated[list[str], typer.Argument(metavar="JOB...", help="Ids of batches and tunings.")]
Text = Annotated[str, typer.Argument(metavar="TEXT", help="Empty takes the label away.")]
_STATES = "planning, queued, running, done, cancelled or failed only."
Timeout = Annotated[float | None, options.option("SECONDS", "Wait so long at most.", min=0)]


def list_jobs(
    services: Services,
    state: Annotated[str | None, options.option("STATE", _STATES)] = None,
    label: Annotated[str | None, options.option("TEXT", "Of this label only.")] = None,
    limit: Annotated[int, typer.Option(metavar="N", min=1, help="The newest N.")] = 20,
    as_json: options.AsJson = False,
) -> None:
    """The newest jobs first."""
    ridelab = services.at()
    listed: list[Job] = [
        *ridelab.batches(state=state, label=label, limit=limit),
        *ridelab.tunings(state=state, label=label, limit=limit),
    ]
    listed = sorted(listed, key=lambda job: str(job.answer["created_at"]), reverse=True)[:limit]
    if as_json:
        print_json([{"kind": job.NAME, **job.answer} for job in listed])
    elif listed:
        show_table(["", "id", "state", "done", "failed", "of", "created", "label"], list(map(_row, listed)))
    else:
        note("There are none")


def show(services: Services, job_id: JobId, as_json: options.AsJson = False) -> None:
    """Show how a job stands."""
    job = targets.job_of(job_id, services)
    if as_json:
        print_json(job.answer)
        return
    answer = job.answer
    lines: dict[str, Any] = {
        job.NAME: job.id,
        "label": job.label,
        "state": job.state + (f": {job.reason}" if job.reason else ""),
        "done": f"{finished(job)}, {job.failed} failed",
        "runs before it": job.position,
        "strategies": ", ".join(answer.get("strategies") or [answer.get("strategy", "")]),
        "swept": ", ".join(each["name"] for each in answer.get("fields") or []),
        "core": answer.get("core_version"),
        "created": answer.get("created_at"),
        "finished": answer.get("finished_at"),
        "results": resume_command(job, services),
    }
    for name, value in lines.items():
        if value not in (None, ""):
            typer.echo(f"{name + ':':<16}{value}")


def follow(services: Services, job_id: JobId, timeout: Timeout = None, as_json: options.AsJson = False) -> None:
    """Wait for a job's end; Ctrl-C only ends the waiting."""
    job = targets.job_of(job_id, services)
    follow_to_end(job, services, ours=False, timeout=timeout)
    raise typer.Exit(_end(job, as_json=as_json))


def _end(job: Job, *, as_json: bool) -> int:
    """Say how it stands; the exit code."""
    if as_json:
        print_json(job.answer)
    return say_end(job)


def label_job(services: Services, job_id: JobId, text: Text, as_json: options.AsJson = False) -> None:
    """Give a job a label, by which lists find it."""
    job = targets.job_of(job_id, services)
    job.rename(text or None)
    say(f"{job.NAME} {job.id}: {job.label or 'no label'}", job.answer, as_json=as_json)


def cancel(services: Services, job_id: JobId, as_json: options.AsJson = False) -> None:
    """Stop a job; what is finished stays."""
    _end(targets.job_of(job_id, services).cancel(), as_json=as_json)


def resume(services: Services, job_id: JobId, as_json: options.AsJson = False) -> None:
    """Go on with a job that was cancelled or failed; a private service ends with the command, so it is followed."""
    job = targets.job_of(job_id, services).resume()
    if services.private:
        follow_to_end(job, services)
    _end(job, as_json=as_json)


def delete(services: Services, job_ids: JobIds, as_json: options.AsJson = False) -> None:
    """Remove jobs that have ended and that no link shows."""
    deleted = []
    for each in job_ids:
        job = targets.job_of(each, services)
        job.delete()
        note(f"{job.NAME} {job.id}: deleted")
        deleted.append({"kind": job.NAME, "id": job.id})
    if as_json:
        print_json(deleted)


def _row(job: Job) -> list[Any]:
    created = str(job.answer["created_at"])[:16].replace("T", " ")
    return [job.NAME, job.id, job.state, job.done, job.failed, job.total, created, job.label or ""]


COMMANDS = (list_jobs, show, follow, label_job, cancel, resume, delete)
