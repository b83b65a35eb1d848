"""The real service, which a test can take away and bring back."""

from pathlib import Path
from typing import Any

from tests.servers.process import Api, ask


class Server(Api):
    """One service, with data of its own."""

    def __init__(self, folder: Path) -> None:
        self.database = folder / "data" / "ridelab.sqlite"
        self.laws = folder / "laws"  # of one's own: none, unless a test writes one
        self.laws.mkdir()
        # A page asks for one thing at a time: more workers would only take longer to start.
        few = {"RIDELAB_WORKERS": "1", "RIDELAB_BATCH_WORKERS": "1"}
        super().__init__(folder, RIDELAB_CONTROLLERS=str(self.laws), **few)

    def stop(self) -> None:
        """End it as an operator would."""
        self.terminate(stays_dead=True)

    def start(self) -> None:
        """Start it again, and wait until it is ready."""
        self.revive()
        self.wait_until_ready()

    def get(self, path: str) -> Any:
        """The JSON at a path of the API."""
        return ask(self.url, "GET", path)

    def post(self, path: str, body: dict[str, Any]) -> Any:
        """The JSON the API answers to this body."""
        return ask(self.url, "POST", path, json=body)

    def submit(self, sweep: dict[str, Any], strategies: list[str]) -> str:
        """Submits a batch over the paper's scenario, as a script does; returns its page's path."""
        batch = self.post("/batches", {"scenario": {}, "strategies": strategies, "sweep": sweep})
        return f"/b/{batch['id']}"
