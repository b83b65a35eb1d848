"""What a visitor waits for, in headless Chromium against a service that runs: curves, a dragged value, many runs."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median, quantiles
from time import perf_counter, sleep
from typing import Any

import httpx
from playwright.sync_api import Browser, Page, Route, sync_playwright

from benchmarks.api_latency import server
from benchmarks.timing import table
from tests.browser.chromium import launch
from tests.browser.dashboard import LAPTOP, thumb

REPEATS = 5
MOVES = 180  # of the pointer
PERIOD = 1 / 60  # from one to the next at least: Playwright also waits until the page has had each [s]
STRIDE, TURN = 2, 90  # from one to the next, further than a step of the slider [px]; moves until it goes back
FIRST_LOAD, FIRST_PLOT = 250.0, 700.0  # goals [kB], [ms]
REDRAW, FRAMES = 50.0, 60.0  # goals: 95th percentile [ms], frames a second
CURVES = "[data-drawn] >> nth=0"
ROWS, LONGEST_TASK = 10_000, 100.0  # of a sweep; goal [ms]

WATCH = Path(__file__).with_suffix(".js")


def run() -> None:
    """Print both tables."""
    with server() as client, sync_playwright() as playwright:
        address = str(client.base_url)
        browser = launch(playwright, compilers=True)
        first = [first_view(browser, address) for _ in range(REPEATS)]
        redraws, rate = drag(browser, address)
        longest = arrival(browser, client)
        browser.close()
    size, taken = (median(column) for column in zip(*first, strict=True))
    slowest = quantiles(redraws, n=20)[-1]
    table(
        "The page in Chromium",
        ["", "measured", "goal"],
        [
            ["until the first curves stand, compressed [kB]", size, FIRST_LOAD],
            ["from the address to the first curves, empty cache, median [ms]", taken, FIRST_PLOT],
            ["from a move of a slider to its curves, median [ms]", median(redraws), ""],
            ["the same, 95th percentile [ms]", slowest, REDRAW],
            ["frames a second meanwhile", rate, FRAMES],
            [f"longest task when a sweep's {ROWS} rows come [ms]", longest, LONGEST_TASK],
        ],
    )


@contextmanager
def opened(browser: Browser) -> Iterator[Page]:
    """A page of a browser profile that has seen nothing yet."""
    context = browser.new_context(viewport=LAPTOP)
    yield context.new_page()
    context.close()


def first_view(browser: Browser, address: str) -> tuple[float, float]:
    """Kilobytes of the answers until the first curves stand, and milliseconds until they do."""
    with opened(browser) as page:
        page.add_init_script(path=WATCH)
        page.goto(address)
        page.locator(CURVES).wait_for()
        size, taken = page.evaluate("firstCurves()")
        return size, taken


def drag(browser: Browser, address: str) -> tuple[list[float], float]:
    """Milliseconds from each move of a slider to the curves of that value or a newer one; frames a second."""
    with opened(browser) as page:
        page.add_init_script(path=WATCH)
        page.goto(address)
        page.locator(CURVES).wait_for()
        page.wait_for_load_state("networkidle")
        x, y = thumb(page.get_by_role("slider", name="Height", exact=True))
        page.mouse.move(x, y)
        page.mouse.down()
        page.evaluate("watchMoves()")
        due = perf_counter()
        for step in range(MOVES):
            page.mouse.move(x - STRIDE * abs((step + TURN) % (2 * TURN) - TURN), y)
            due += PERIOD
            sleep(max(0.0, due - perf_counter()))
        seen: dict[str, list[Any]] = page.evaluate("seen")
        page.mouse.up()
    frames = seen["frames"]
    return redraw_times(seen), 1000 * (len(frames) - 1) / (frames[-1] - frames[0])


def arrival(browser: Browser, client: httpx.Client) -> float:
    """Milliseconds of the longest task in which a sweep's page reads and draws many rows; they are made up of one."""
    body = {"scenario": {}, "strategies": ["lv"], "sweep": {"grid": {"road.bump.height": [0.05, 0.1]}}}
    batch = client.post("/api/v1/batches", json=body).raise_for_status().json()["id"]
    client.get(f"/api/v1/batches/{batch}/events")  # a stream that ends with the batch

    def many(route: Route) -> None:
        answer = route.fetch().json()
        answer["columns"] = {name: [values[0]] * ROWS for name, values in answer["columns"].items()} | {
            "run": list(range(ROWS)),
            "road.bump.height": [0.05 + 0.1 * index / ROWS for index in range(ROWS)],
            "bump.body_acceleration.peak": [1 + (index % 100) / 100 for index in range(ROWS)],
        }
        route.fulfill(json=answer)

    with opened(browser) as page:
        page.add_init_script(path=WATCH)
        page.route("**/table?*", many)
        page.goto(f"{client.base_url}/b/{batch}")
        page.locator(f"[data-points='{ROWS}']").wait_for()
        page.wait_for_load_state("networkidle")
        longest: float = page.evaluate("longestTask()")
        return longest


def redraw_times(seen: dict[str, list[Any]]) -> list[float]:
    """Of each move that was answered: the first request after it, its answer, the first drawing after that."""
    times = []
    for moved in seen["moved"]:
        request = next((index for index, sent in enumerate(seen["sent"]) if sent >= moved), None)
        if request is None or request >= len(seen["answered"]) or seen["answered"][request] is None:
            continue
        drawn = next((at for at in seen["drawn"] if at > seen["answered"][request]), None)
        if drawn is not None:
            times.append(drawn - moved)
    return times
