"""A Dask cluster somebody has already: the commands of docs/how-to/operations.md, no TLS, with and without a nanny."""

import asyncio
import contextlib
import re
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest
from distributed import Client

from backend.compute.chunk_messages import Chunk, ChunkOutcome
from backend.compute.dask_executor import DaskExecutor
from backend.job_run import JobRun
from backend.runs import WARM_UP
from backend.runs.compute_run import compute as compute_run
from backend.settings import Settings
from sim_core import __version__
from sim_core.scenario import SCHEMA_VERSION, Scenario
from tests.servers import loops
from tests.servers.process import FORK_SERVER, HANG_TIMEOUT, ROOT, Program, reserved_port

PAGE = (ROOT / "docs/how-to/operations.md").read_text()
PLAIN = {"DASK_CONFIG": "backend/deploy/dask.yaml", "DASK_DISTRIBUTED__COMM__REQUIRE_ENCRYPTION": "false"}
MAY_HAVE_CHILDREN = {"DASK_DISTRIBUTED__WORKER__DAEMON": "false"}


def documented(role: str, port: int, folder: Path) -> list[str]:
    """The page's command for scheduler or worker, with our port."""
    (text,) = re.findall(rf"^    \.venv/bin/python (-m dask {role} .*?(?:\\\n.*)?)$", PAGE, re.MULTILINE)
    text = text.replace("\\\n", " ").replace("SCHEDULER:8786", f"127.0.0.1:{port}").replace("8786", str(port))
    text = re.sub(r"127\.0\.0\.1:878\d", "127.0.0.1:0", text).replace("--nthreads 8", "--nthreads 1")
    local = ["--local-directory", str(folder)] if role == "worker" else []
    return [sys.executable, *shlex.split(text), "--host", "127.0.0.1", *local]


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    port = reserved_port()
    worker = documented("worker", port, tmp_path)
    with_nanny = [word for word in worker if word != "--no-nanny"]
    assert PLAIN.items() <= dict(re.findall(r"(DASK_\w+)=([\w./]+)", PAGE)).items() >= MAY_HAVE_CHILDREN.items()
    with contextlib.ExitStack() as stack:
        for name, command, more in (
            ("scheduler", documented("scheduler", port, tmp_path), {}),
            ("worker", worker, {}),
            ("nanny", with_nanny, MAY_HAVE_CHILDREN),
        ):
            stack.callback(Program(name, command, folder=tmp_path, environment=PLAIN | more).end)
        yield f"tcp://127.0.0.1:{port}"


def chunk(seed: int) -> Chunk:
    run = JobRun(0, f'{{"road.seed":{seed}}}', "passive", str(seed))
    return Chunk(
        compute=compute_run,
        group="group",
        core_version=__version__,
        schema_version=SCHEMA_VERSION,
        base=Scenario().model_dump(mode="json"),
        runs=[run],
        roads={},
        timeout=HANG_TIMEOUT,
        budget=10,
    )


async def compute(address: str, seeds: list[int]) -> list[ChunkOutcome]:
    """The chunks' outcomes for a service that uses that scheduler."""
    for _ in range(60):
        with contextlib.suppress(OSError):
            executor = await DaskExecutor.connected(Settings(dask_scheduler=address), WARM_UP)
            break
    try:
        while await executor.capacity() < 2:
            await asyncio.sleep(0.1)
        return await asyncio.gather(*(executor.compute(chunk(seed)) for seed in seeds))
    finally:
        await executor.close()


def test_workers_of_both_kinds_compute_in_processes_of_their_own(address: str) -> None:
    seeds = list(range(12))
    answers = loops.run(lambda: asyncio.wait_for(compute(address, seeds), 120))
    computed = [run for answer in answers for run in answer.computed or []]
    assert [(run.key, run.status) for run in computed] == [(str(seed), "ok") for seed in seeds]
    with Client(address) as client:
        children: dict[str, list[str]] = client.run(commands_of_children)
    assert len(children) == 2
    assert all(any(FORK_SERVER in command for command in commands) for commands in children.values())


def commands_of_children() -> list[str]:
    """On a Dask worker: what it has started."""
    return [" ".join(child.cmdline()) for child in psutil.Process().children()]
