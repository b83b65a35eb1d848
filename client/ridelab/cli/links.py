"""`ridelab links`: what one has shared, found again and taken back."""

from typing import Annotated

import typer

from ridelab.cli import options
from ridelab.cli.reporting import note, print_json, show_table
from ridelab.cli.service import Services

Slugs = Annotated[list[str], typer.Argument(metavar="LINK...", help="Slugs or addresses of links.")]


def list_links(
    services: Services,
    limit: Annotated[int, typer.Option(metavar="N", min=1, help="The newest N.")] = 20,
    as_json: options.AsJson = False,
) -> None:
    """The newest links first: with a token one's own, without tokens on the service's own machine."""
    links = services.at().links(limit=limit)
    if as_json:
        print_json(links)
    elif links:
        rows = [
            [
                each["slug"],
                each["kind"],
                each["run_id"] or each["batch_id"] or "",
                _minute(each["created_at"]),
                _minute(each["revoked_at"] or ""),
            ]
            for each in links
        ]
        show_table(["link", "opens", "of id", "created", "revoked"], rows)
    else:
        note("There are none")


def revoke(services: Services, links: Slugs, as_json: options.AsJson = False) -> None:
    """Take links back: they open nothing any more, for anybody."""
    revoked = []
    for each in links:
        slug = each.rstrip("/").rpartition("/")[2]
        services.at().revoke_link(slug)
        note(f"link {slug}: revoked")
        revoked.append({"slug": slug})
    if as_json:
        print_json(revoked)


def _minute(time: str) -> str:
    return time[:16].replace("T", " ")


COMMANDS = (list_links, revoke)
