"""A Dask cluster somebody has already: the commands of docs/how-to/operations.md, no TLS, with and without a nanny."""

import contextlib
import re
import shlex
import sys
from pathlib import Path

import psutil
from distributed import Client

from tests.servers.process import FORK_SERVER, ROOT, Api, Program, ask, request, reserved_port

PAGE = (ROOT / "docs/how-to/operations.md").read_text()
PLAIN = {"DASK_CONFIG": "backend/deploy/dask.yaml", "DASK_DISTRIBUTED__COMM__REQUIRE_ENCRYPTION": "false"}
MAY_HAVE_CHILDREN = {"DASK_DISTRIBUTED__WORKER__DAEMON": "false"}


def documented(role: str, port: int, folder: Path) -> list[str]:
    """Return the page's command for scheduler or worker, with our port."""
    (text,) = re.findall(rf"^    \.venv/bin/python (-m dask {role} .*?(?:\\\n.*)?)$", PAGE, re.MULTILINE)
    text = text.replace("\\\n", " ").replace("SCHEDULER:8786", f"127.0.0.1:{port}").replace("8786", str(port))
    text = re.sub(r"127\.0\.0\.1:878\d", "127.0.0.1:0", text).replace("--nthreads 8", "--nthreads 1")
    local = ["--local-directory", str(folder)] if role == "worker" else []
    return [sys.executable, *shlex.split(text), "--host", "127.0.0.1", *local]


def commands_of_children() -> str:
    """Return on a Dask worker what it has started."""
    return " ".join(word for child in psutil.Process().children() for word in child.cmdline())


def test_workers_of_both_kinds_compute_in_processes_of_their_own(tmp_path: Path) -> None:
    port = reserved_port()
    worker = documented("worker", port, tmp_path)
    with_nanny = [word for word in worker if word != "--no-nanny"]
    assert PLAIN.items() <= dict(re.findall(r"(DASK_\w+)=([\w./]+)", PAGE)).items() >= MAY_HAVE_CHILDREN.items()
    address = f"tcp://127.0.0.1:{port}"
    with contextlib.ExitStack() as stack:
        for name, command, more in (
            ("scheduler", documented("scheduler", port, tmp_path), {}),
            ("worker", worker, {}),
            ("nanny", with_nanny, MAY_HAVE_CHILDREN),
        ):
            stack.enter_context(Program(name, command, folder=tmp_path, environment=PLAIN | more))
        api = stack.enter_context(Api(tmp_path, RIDELAB_DASK_SCHEDULER=address, RIDELAB_WORKERS="1"))
        api.wait_until_ready()
        cluster = stack.enter_context(Client(address))
        cluster.wait_for_workers(2)
        body = {"strategies": ["passive"], "sweep": {"grid": {"road.seed": list(range(200))}}}
        batch = ask(api.url, "POST", "/batches", json=body)["id"]
        request("GET", f"{api.url}/api/v1/batches/{batch}/events").raise_for_status()  # a stream that ends with it
        assert ask(api.url, "GET", f"/batches/{batch}")["done"] == 200
        children: dict[str, str] = cluster.run(commands_of_children)
    assert [FORK_SERVER in each for each in children.values()] == [True, True]
