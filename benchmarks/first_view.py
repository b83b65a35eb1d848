"""How long a visitor waits for the first curves: headless Chromium, an empty browser cache, a service that runs."""

import shutil
from statistics import median
from time import perf_counter

from playwright.sync_api import sync_playwright

from benchmarks.api_latency import server
from benchmarks.timing import table

REPEATS = 5
GOAL = 2000.0  # docs: first plots within two seconds [ms]
OPTIONS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update"]


def run() -> None:
    """Print the table; where no Chromium is installed, say so."""
    program = shutil.which("chromium") or shutil.which("google-chrome")
    if program is None:
        print("\nFirst view: no Chromium is installed here")
        return
    with server() as client, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=OPTIONS)
        times = []
        for _ in range(REPEATS):
            context = browser.new_context(viewport={"width": 1366, "height": 768})
            page = context.new_page()
            begin = perf_counter()
            page.goto(str(client.base_url))
            page.locator(".scatterlayer .trace").first.wait_for()
            times.append((perf_counter() - begin) * 1000)
            context.close()
        browser.close()
    taken = median(times)
    title = "From the address to the first curves in Chromium, its cache empty, median"
    table(title, ["", "ms", "of the goal"], [["first view", taken, taken / GOAL]])
