"""Measures what an expert does to label: actions and seconds by keys, mouse and touch. Run `python -m bench.expert`.

A script answers Label_LO of a segment of 9 steps and Label_HI of 10 segments in a real Chromium. It knows the right
answer, and every suggestion of the learner is wrong, so that it has to give every label. It answers with the buttons of
the panel, and by drawing on the picture. Two times are printed:

- machine: from the first action to the next query, in the browser. The script does not think and does not move a hand.
- hand: an estimate for a person, by the keystroke-level model (Card, Moran and Newell 1980): 0.28 s for a key, 1.1 s
  to point, 0.2 s to click or tap. For a stroke, the hand points at its beginning (1.1 s), presses and releases (0.2 s),
  and points at the end of each straight line (1.1 s). The time to think is left out.
"""

import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack, closing
from dataclasses import dataclass, field

from playwright.sync_api import Browser, Page
from tests.browser.conftest import WEB, WIDE
from tests.browser.hands.pointer import Finger, Mouse
from tests.browser.kit import Cell, Json, Learner, ask, chromium, log_in, wait_for_heading, way
from tests.browser.test_narrow import PHONE

from waypost_server import serving
from waypost_server.settings import Settings

KEY, POINT, CLICK = 0.28, 1.1, 0.2  # seconds
NAMED = {"up": "ArrowUp", "down": "ArrowDown", "left": "ArrowLeft", "right": "ArrowRight"}
NEXT = "And now?"

# One segment of nine steps, and ten segments through four rooms, of which each has the begin of one to three.
NINE = way((14, 2), ("north", "uuuuluuuu"))
NINE_WAY: tuple[Cell, ...] = ((14, 2), (10, 2), (10, 1), (5, 1))
TEN = way((14, 2), *[("south", moves) for moves in ("u", "uu", "u", "ul", "uu", "u", "rrrr", "rr", "uuuu", "r")])
TEN_RIGHT = ["north"] * 5 + ["east"] * 2 + ["north"] * 2 + ["east"]
TEN_WAY: tuple[Cell, ...] = ((14, 2), (10, 2), (10, 1), (6, 1), (6, 7), (2, 7), (2, 9))


@dataclass
class Expert:
    """Acts on the page, and counts."""

    page: Page
    hand: Mouse
    actions: int = 0
    seconds: float = 0.0  # of a person's hand
    machine: float = 0.0  # seconds that it took
    begun: float = field(default_factory=time.perf_counter)

    def key(self, key: str) -> None:
        """Press a key."""
        self._act(KEY)
        self.page.keyboard.press(key)

    def button(self, name: str) -> None:
        """Point at a button and press it."""
        self._act(POINT + CLICK)
        self.hand.press(name)

    def draw(self, *cells: Cell) -> None:
        """Point at the beginning of a way and draw it."""
        self._act(POINT + CLICK + POINT * (len(cells) - 1))
        self.hand.draw(*cells)

    def _act(self, seconds: float) -> None:
        self.actions += 1
        self.seconds += seconds


def lo_by_keys(expert: Expert) -> None:
    for action in NINE[0]["actions"]:
        expert.key(NAMED[action])
    expert.key("d")
    expert.key("Enter")


def lo_by_buttons(expert: Expert) -> None:
    for action in NINE[0]["actions"]:
        expert.button(action)
    expert.button("Done here")
    expert.button("Send answer")


def lo_by_drawing(expert: Expert) -> None:
    expert.draw(*NINE_WAY)
    expert.button("Done here")
    expert.button("Send answer")


def hi_by_keys(expert: Expert) -> None:
    for subgoal in TEN_RIGHT:
        expert.key(subgoal[0])
    expert.key("Enter")


def hi_by_buttons(expert: Expert) -> None:
    for subgoal in TEN_RIGHT:
        expert.button(subgoal)
    expert.button("Send answer")


def hi_by_drawing(expert: Expert) -> None:
    expert.draw(*TEN_WAY)
    expert.button("Send answer")


def question(kind: str, episode: int) -> Json:
    """A query whose suggestion is wrong at every label."""
    if kind == "label_hi":
        return ask(kind, episode, segments=TEN, suggestion={"kind": kind, "subgoals": ["south"] * len(TEN)})
    suggestion = {"kind": kind, "actions": ["down"] * 9, "terminations": [False] * 10}
    return ask(kind, episode, segments=NINE, context=[], suggestion=suggestion)


def right_answer(kind: str) -> Json:
    if kind == "label_hi":
        return {"kind": kind, "subgoals": TEN_RIGHT}
    return {"kind": kind, "actions": NINE[0]["actions"], "terminations": [False] * 9 + [True]}


Way = Callable[[Expert], None]
WAYS: dict[str, dict[str, Way]] = {
    "label_lo": {"keys": lo_by_keys, "buttons": lo_by_buttons, "drawing": lo_by_drawing},
    "label_hi": {"keys": hi_by_keys, "buttons": hi_by_buttons, "drawing": hi_by_drawing},
}


def measured(browser: Browser, url: str, learner: Learner, kind: str, how: str, touch: bool) -> Expert:
    """Answer one query, check the answer, and return what the expert did, with its seconds on the machine."""
    size = PHONE if touch else WIDE
    context = browser.new_context(base_url=url, viewport=size, has_touch=touch, is_mobile=touch)
    log_in(context, learner.served, f"{kind}-{how}-{touch}", "annotator")
    run = learner.create_run(f"{kind} {how}")
    [query, _] = learner.ask(run, question(kind, 0), ask("inspect_full", 1, question=NEXT))
    page = context.new_page()
    page.goto(f"/work?run={run}")
    wait_for_heading(page, question(kind, 0)["question"])
    expert = Expert(page, Finger(page) if touch else Mouse(page))
    WAYS[kind][how](expert)
    wait_for_heading(page, NEXT)
    expert.machine = time.perf_counter() - expert.begun
    assert learner.answer_of(query) == right_answer(kind)
    context.close()
    learner.call("PATCH", f"/runs/{run}", {"state": "finished"})
    return expert


def main() -> None:
    if not (WEB / "dist" / "index.html").is_file():
        print("Nothing was measured, because the web app is not built. Run `make web` first.")
        return
    print("| query | by | with | actions | hand, s | machine, s |\n| --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        settings = Settings(database=f"sqlite:///{folder}/waypost.db", page=WEB / "dist")
        served = stack.enter_context(serving.background(settings))
        learner = stack.enter_context(closing(Learner(served)))
        browser = stack.enter_context(chromium())
        for kind in WAYS:
            for by, touch, how in (
                ("keyboard", False, "keys"),
                ("mouse", False, "buttons"),
                ("mouse", False, "drawing"),
                ("touch, 390 px", True, "buttons"),
                ("touch, 390 px", True, "drawing"),
            ):
                one = measured(browser, served.url, learner, kind, how, touch)
                print(f"| {kind} | {by} | {how} | {one.actions} | {one.seconds:.1f} | {one.machine:.2f} |")


if __name__ == "__main__":
    main()
