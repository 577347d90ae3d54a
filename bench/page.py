"""Measures the web app: the time to the next query, the size, and the start-up time. Run `python bench/page.py`.

A real Chromium uses a real server process over loopback. The time to the next query is measured from the key press to
the frame that shows the next query. A page of a few bytes shows how long the browser alone takes. The tables also have
the numbers of Label Studio, measured in the same way. The script prints tables and asserts nothing.
"""

import argparse
import gzip
import statistics
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx2
from bench.assignments import machine, serving
from playwright.sync_api import Browser, BrowserContext, Page, Response
from tests.browser.conftest import WEB, WIDE
from tests.browser.kit import VOCABULARY, ask, chromium

PAUSES = (0.0, 0.5)  # seconds between the display of a query and the key press that answers it
FIRST_LOADS = 15
OPENED = 1.5  # seconds that a new window needs for its own views before it loads a page: they share the cores
# Label Studio Community, `label-studio start` on SQLite, with one user and a task with two choices: 15 answers by key
# and one cold load in headless Chromium 156, on a machine with two busy cores. It sends JS and CSS uncompressed.
LABEL_STUDIO = {"p50 ms": 501, "max ms": 567, "JS + CSS, kB gzipped": 2_080, "requests": 35, "first task, ms": 3_300}

WATCH = """() => {
    window.latencies = [];
    let pressed = null;
    window.addEventListener('keydown', () => { pressed ??= performance.now(); }, true);
    let last = null;
    const seen = now => {
        const shown = document.querySelector('#question')?.dataset.query ?? null;
        if (shown !== null && shown !== last) {
            if (last === null) window.firstTask = now;
            else if (pressed !== null) window.latencies.push(now - pressed);
            [last, pressed] = [shown, null];
        }
        requestAnimationFrame(() => seen(performance.now()));
    };
    seen(performance.now());
}"""


class Asker:
    """A learner that creates runs with a given number of queries."""

    def __init__(self, url: str, headers: dict[str, str]) -> None:
        self._http = httpx2.Client(base_url=f"{url}/api/v1", headers=headers, timeout=60)

    def run(self, n: int) -> str:
        """Create a run, ask n queries with one per episode, and return the run's id."""
        body = {"name": f"{n} questions", "algorithm": "hg-dagger", "seed": 0, "vocabulary": VOCABULARY}
        run = str(self._call("/runs", body)["id"])
        asks = [ask("inspect_full", episode, question=f"Question {episode}") for episode in range(n)]
        self._call(f"/runs/{run}/queries", {"queries": asks})
        return run

    def _call(self, path: str, body: Any) -> Any:
        reply = self._http.post(path, json=body)
        reply.raise_for_status()
        return reply.json()


@contextmanager
def person(browser: Browser, url: str, headers: dict[str, str]) -> Iterator[BrowserContext]:
    """Open a browser with an empty cache for a person who is signed in."""
    context = browser.new_context(base_url=url, viewport=WIDE, extra_http_headers=headers)
    context.add_init_script(f"({WATCH})()")
    yield context
    context.close()


def wait_for_task(page: Page, last: str | None = None) -> str:
    """Wait until the web app shows another query than `last`, and return its id."""
    found = page.wait_for_function(
        """last => {
            const now = document.querySelector('#question')?.dataset.query;
            return now && now !== last ? now : false;
        }""",
        arg=last,
    )
    return str(found.json_value())


def latencies(context: BrowserContext, run: str, n: int, pause: float) -> list[float]:
    """Answer n queries, and return the milliseconds from each key press to the next query."""
    page = context.new_page()
    page.goto(f"/work?run={run}")
    shown = wait_for_task(page)
    for _ in range(n):
        time.sleep(pause)
        page.keyboard.press("p")
        shown = wait_for_task(page, shown)
    page.wait_for_timeout(100)
    return [float(one) for one in page.evaluate("window.latencies")]


def opened(context: BrowserContext) -> Page:
    """Open a window and wait until the browser has loaded what it shows beside the page."""
    page = context.new_page()
    time.sleep(OPENED)
    return page


def first_load(context: BrowserContext, run: str) -> tuple[float, list[Response]]:
    """Open the web app without a cache; return the milliseconds to the first query, and the responses until then."""
    page, fetched = opened(context), list[Response]()
    page.on("response", lambda response: fetched.append(response))
    page.goto(f"/work?run={run}")
    wait_for_task(page)
    return float(page.evaluate("window.firstTask")), fetched


def least_load(context: BrowserContext) -> float:
    """Open a page of a few bytes from the same server; return the milliseconds until the browser has painted it."""
    page = opened(context)
    page.goto("/healthz")
    painted = page.wait_for_function("() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime")
    return float(str(painted.json_value()))


def gzipped(responses: list[Response]) -> float:
    """Return the total size of all scripts and style sheets after gzip, in kB."""
    files = [one.body() for one in responses if one.request.resource_type in {"script", "stylesheet"}]
    return sum(len(gzip.compress(file, 6)) for file in files) / 1_000


def table(header: list[str], rows: list[list[object]]) -> None:
    for row in (header, ["---"] * len(header), *rows):
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--answers", type=int, default=200, help="answers per row of the first table")
    options = parser.parse_args()
    if not (WEB / "dist" / "index.html").is_file():
        print("Nothing was measured, because the web app is not built. Run `make web` first.")
        return
    print(f"{machine()}\n")
    with tempfile.TemporaryDirectory(prefix="wp", dir=Path.cwd()) as folder, chromium() as browser:
        print(f"Chromium {browser.version}.\n")
        with serving(f"sqlite:///{folder}/waypost.db") as (url, _, learner, annotators):
            measure(browser, url, Asker(url, learner), annotators[0], options.answers)


def measure(browser: Browser, url: str, asker: Asker, annotator: dict[str, str], n_answers: int) -> None:
    rows: list[list[object]] = []
    for pause in PAUSES:
        with person(browser, url, annotator) as context:
            times = sorted(latencies(context, asker.run(n_answers + 1), n_answers, pause))
        p95 = times[min(len(times) - 1, int(0.95 * len(times)))]
        name = f"Waypost, {pause:g} s to think" if pause else "Waypost, no pause"
        rows.append([name, len(times), f"{statistics.median(times):.0f}", f"{p95:.0f}", f"{times[-1]:.0f}"])
    rows.append(["Label Studio", 15, LABEL_STUDIO["p50 ms"], "", LABEL_STUDIO["max ms"]])
    table(["key press to next query", "answers", "p50 ms", "p95 ms", "max ms"], rows)

    starts, least, fetched = list[float](), list[float](), list[Response]()
    for _ in range(FIRST_LOADS):
        with person(browser, url, annotator) as context:
            least.append(least_load(context))
        with person(browser, url, annotator) as context:
            start, fetched = first_load(context, asker.run(1))
            starts.append(start)
            weight, n_requests = gzipped(fetched), len(fetched)
    limit = [0, 1, f"{statistics.median(least):.0f}"]
    ours = [f"{weight:.0f}", n_requests, f"{statistics.median(starts):.0f}"]
    theirs = [LABEL_STUDIO[name] for name in ("JS + CSS, kB gzipped", "requests", "first task, ms")]
    table(
        [
            "first load, without cache",
            "JS + CSS, kB gzipped",
            "requests to the first task",
            "time to the first task, ms",
        ],
        [["a page of a few bytes", *limit], ["Waypost", *ours], ["Label Studio", *theirs]],
    )


if __name__ == "__main__":
    main()
