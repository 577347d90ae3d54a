"""Measures the time of one step of a demonstration, from the key press to the next state: `python bench/play.py`.

A server, a learner and a Chromium are separate processes and communicate over loopback. The script plays
demonstrations of the maze with the keyboard, and waits for each state before the next key. It prints a table and
asserts nothing.
"""

import argparse
import os
import platform
import statistics
import tempfile
from pathlib import Path

from playwright.sync_api import Page
from tests.acceptance.processes import ServerProcess, free_port, start_learner
from tests.browser.conftest import WIDE
from tests.browser.hands.keyboard import press
from tests.browser.kit import chromium

from waypost import wire
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.experts.oracle import OracleExpert

RUN = ("h-bc", "--instances", "corners", "--episodes", "100")
WATCH = """() => {
    const times = { pressed: 0, sent: 0, back: [], drawn: [] };
    window.times = times;
    addEventListener('keydown', () => { times.pressed = performance.now(); }, true);
    const Socket = window.WebSocket;
    window.WebSocket = class extends Socket {
        constructor(...given) {
            super(...given);
            this.addEventListener('message', (event) => {
                if (JSON.parse(event.data).type !== 'states') return;
                times.back.push(performance.now() - times.pressed);
                requestAnimationFrame(() => {
                    setTimeout(() => times.drawn.push(performance.now() - times.pressed));
                });
            });
        }
    };
}"""


def play(page: Page, answer: wire.HierDemoAnswer) -> None:
    """Play a demonstration step by step."""
    for segment in answer.segments:
        press(page, "Subgoal", segment.subgoal)
        for action in segment.actions:
            n = page.evaluate("times.drawn.length")
            press(page, "Action", action)
            page.wait_for_function("n => times.drawn.length > n", arg=n)
        if segment is not answer.segments[-1]:
            page.keyboard.press("Enter")
    page.get_by_text("The task is accomplished.").wait_for()
    page.keyboard.press("Enter")


def measure(server: ServerProcess, page: Page, steps: int) -> dict[str, list[float]]:
    """Return the milliseconds from each key press until the next state arrived, and until it was drawn."""
    expert, client = OracleExpert(MazeDomain()), server.client("learner", "learner")
    page.add_init_script(f"({WATCH})()")
    page.goto(server.login_link("person"))
    found: dict[str, list[float]] = {"back": [], "drawn": []}
    last = ""
    while len(found["drawn"]) < steps:
        page.locator(f"#question[data-query]:not([data-query='{last}'])").wait_for(timeout=120_000)
        page.locator("[data-stage=here]").wait_for()
        last = str(page.locator("#question").get_attribute("data-query"))
        answer = expert(client.query(int(last)).ask)
        assert isinstance(answer, wire.HierDemoAnswer)
        page.evaluate("times.back = [], times.drawn = []")
        play(page, answer)
        for name, values in page.evaluate("({ back: times.back, drawn: times.drawn })").items():
            found[name] += values
    return found


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=300, help="the number of steps to measure")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        server = ServerProcess(Path(folder), free_port())
        server.start()
        learner = start_learner(server, RUN)
        try:
            found = measure(server, browser.new_page(viewport=WIDE), arguments.steps)
        finally:
            learner.kill()
            learner.communicate()
            server.stop()
    load = ", ".join(f"{average:.1f}" for average in os.getloadavg())
    print(f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, load {load}")
    print(f"{len(found['drawn'])} steps\n")
    print("| time from the key press until | p50 ms | p95 ms | max ms |\n|---|---|---|---|")
    for name, words in (("back", "the state arrives in the web app"), ("drawn", "the state is drawn")):
        values = found[name]
        p95 = statistics.quantiles(values, n=20)[-1]
        print(f"| {words} | {statistics.median(values):.1f} | {p95:.1f} | {max(values):.1f} |")


if __name__ == "__main__":
    main()
