"""Submitting a job and waiting for it, so that Ctrl-C loses nothing that is finished and SIGTERM names what goes on."""

import shlex
import uuid
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from ridelab.cli.reporting import (
    DIFFERENT,
    INTERRUPTED,
    TERMINATED,
    InputError,
    Terminated,
    UnavailableError,
    note,
    print_json,
)
from ridelab.cli.service import Services
from ridelab.errors import RidelabClientError
from ridelab.jobs import Job, Tuning

AnyJob = TypeVar("AnyJob", bound=Job)


def check_detachable(services: Services) -> None:
    """Refuse to leave a job to a service that ends with this command."""
    if services.private:
        raise InputError("--detach needs --server: a private service ends with this command")


def submit_job(submit: Callable[[str], AnyJob], services: Services, *options: str) -> tuple[AnyJob, int]:
    """Submit a job. After an interruption the same idempotency key is sent again and gives its id.

    Returns:
        The job; and the exit code so far, as of `follow_to_end`.
    """
    key = uuid.uuid4().hex
    try:
        return submit(key), 0
    except KeyboardInterrupt as interrupt:
        job = submit(key)
        return job, _stopped(job, interrupt, resume_command(job, services, *options), ours=True)


def follow_to_end(job: Job, services: Services, *options: str, ours: bool = True, timeout: float | None = None) -> int:
    """Wait for a job with a progress bar, `timeout` [s] at most.

    Ctrl-C cancels a job that is `ours`, submitted by this command; another's goes on. SIGTERM cancels none. `options`
    are those of the command that takes its results later.

    Returns:
        The exit code so far: 0 where the job has ended by itself, INTERRUPTED where it was cancelled here.

    Raises:
        typer.Exit: The command ends without its results, and what becomes of them has been said.
        RidelabAPIError: It could not be planned.
    """
    try:
        _follow(job, timeout)
        if job.problem is not None:
            raise job.problem
        return 0
    except KeyboardInterrupt as interrupt:
        return _stopped(job, interrupt, resume_command(job, services, *options), ours=ours)


def resume_command(job: Job, services: Services, *options: str) -> str:
    """The command that waits for a batch and writes its rows, or that shows a tuning."""
    words = ["export", job.id, "--wait", *(options or ("--out", "FILE"))]
    if isinstance(job, Tuning):
        words = ["tune", "--resume", job.id]
    return shlex.join(["ridelab", *words, *services.options])


def file_options(out: str | None, file_format: str | None) -> list[str]:
    """The options that name the same file in another command."""
    return [] if out is None else ["--out", out, *([] if file_format is None else ["--format", file_format])]


def show_detached(job: Job, services: Services, *options: str, as_json: bool) -> None:
    """Say which job was submitted and how to come back to it."""
    print_json(job.answer) if as_json else typer.echo(job.id)
    size = "Planning" if job.total is None else f"{job.total} {'trials' if isinstance(job, Tuning) else 'runs'}"
    note(f"{size}; {resume_command(job, services, *options)}")


def say_end(job: Job) -> int:
    """Say how it ended; the exit code."""
    if job.state == "failed":
        raise UnavailableError(f"The {job.NAME} {job.id} failed: {job.reason}")
    note(f"{job.NAME} {job.id}: {job.state}, {finished(job)} done, {job.failed} failed")
    return DIFFERENT if job.failed or job.state == "cancelled" else 0


def show_estimate(estimate: Mapping[str, Any], runs: str, units: str, *, as_json: bool) -> None:
    """Print a dry run's answer: `6 runs, 3 points, about 0.1 s`."""
    if as_json:
        print_json(estimate)
        return
    seconds = estimate.get("estimated_seconds")
    about = "" if seconds is None else f", about {seconds:.3g} s"
    typer.echo(f"{estimate[runs]} runs, {estimate[units]} {units}{about}")


def finished(job: Job) -> str:
    """Return how many of its runs succeeded, of how many: `3 of 6`."""
    return f"{job.done}" if job.total is None else f"{job.done} of {job.total}"


def _stopped(job: Job, interrupt: KeyboardInterrupt, follow_up: str, *, ours: bool) -> int:
    """Cancel what is left of a job that is ours; the exit code where its results can still be taken."""
    terminated = isinstance(interrupt, Terminated)
    if terminated or not ours:
        why = "Ended" if terminated else "Stopped waiting"
        note(f"{why}; the {job.NAME} {job.id} goes on. To wait for it: {follow_up}")
        raise typer.Exit(TERMINATED if terminated else INTERRUPTED)
    try:
        if not job.finished:
            job.cancel()
        word = "Cancelled" if job.state == "cancelled" else "Interrupted"
        note(f"{word}; {finished(job)} are finished and stay stored: {job.NAME} {job.id}")
        return INTERRUPTED
    except (RidelabClientError, KeyboardInterrupt) as error:
        note(str(error) or "Interrupted again")
        note(f"For what is finished: {follow_up}")
        raise typer.Exit(INTERRUPTED) from None


def _follow(job: Job, timeout: float | None) -> None:
    texts = TextColumn("{task.description}"), TextColumn("{task.fields[remarks]}")
    columns = (texts[0], BarColumn(), MofNCompleteColumn(), texts[1], TimeRemainingColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, disable=not console.is_terminal, transient=True) as bar:
        task = bar.add_task(job.state, total=job.total, remarks="")

        def show(job: Job) -> None:
            remarks = [f"{job.failed} failed"] if job.failed else []
            remarks += [f"{job.position} runs before it"] if job.position and job.state == "queued" else []
            remarks += [f"{job.feasible} within the limits"] if isinstance(job, Tuning) and job.answer["limits"] else []
            word = job.answer.get("step", job.state) if job.state == "running" else job.state
            ended, said = job.done + job.failed, ", ".join(remarks)
            bar.update(task, description=word, total=job.total, completed=ended, remarks=said)

        job.follow(show, timeout=timeout)
