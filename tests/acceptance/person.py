"""A person at the page, as a script: reads the question's number off the page and answers with the keyboard alone."""

from collections.abc import Callable, Sequence

from playwright.sync_api import Page

from waypost import wire
from waypost.client import Client
from waypost.domains import find_domain
from waypost_learner.experts.oracle import OracleExpert

ARROWS = {"up": "ArrowUp", "down": "ArrowDown", "left": "ArrowLeft", "right": "ArrowRight"}
POLL_MILLISECONDS = 10


class Person:
    """Knows what the oracle knows, and has a keyboard."""

    def __init__(self, page: Page, client: Client) -> None:
        self._page, self._client = page, client
        domain = find_domain("maze")
        self._subgoals = list(domain.subgoals)
        self._expert = OracleExpert(domain)
        self.answered: list[wire.Kind] = []

    def work_until(self, over: Callable[[], bool]) -> None:
        """Answer whatever the page shows until there is nothing more to come."""
        last = None
        while not over():
            query = self._page.evaluate("document.querySelector('#question')?.dataset.query ?? null")
            if query is None or query == last:
                self._page.wait_for_timeout(POLL_MILLISECONDS)
                continue
            self._answer(int(query))
            last = query

    def _answer(self, query: int) -> None:
        asked = self._client.query(query)
        answer = self._expert(asked.ask)
        if isinstance(answer, wire.HierDemoAnswer):
            self._play(answer)
        else:
            self._press(self._keys(answer))
        self.answered.append(asked.ask.kind)

    def _play(self, answer: wire.HierDemoAnswer) -> None:
        """Play a demonstration as the expert would, and send it once the page says that it succeeded."""
        self._page.locator("[data-stage=here]").wait_for()
        *before, last = answer.segments
        for segment in before:
            self._press([*self._moves(segment), "Enter"])
        self._press(self._moves(last))
        self._page.get_by_text("The task is accomplished. Send the demonstration.").wait_for()
        self._press(["Enter"])

    def _moves(self, segment: wire.DemoSegment) -> list[str]:
        assert segment.subgoal is not None
        return [str(self._subgoals.index(segment.subgoal) + 1), *(ARROWS[action] for action in segment.actions)]

    def _press(self, keys: Sequence[str]) -> None:
        for key in keys:
            self._page.keyboard.press(key)

    def _keys(self, answer: wire.Answer) -> Sequence[str]:
        match answer:
            case wire.InspectAnswer():
                return ["p" if answer.verdict == "pass" else "f"]
            case wire.LabelHiAnswer():
                return [*(str(self._subgoals.index(name) + 1) for name in answer.subgoals), "Enter"]
            case wire.LabelLoAnswer():
                done = answer.terminations.index(True) if True in answer.terminations else None
                arrows = [ARROWS[action] for action in answer.actions[:done] if action is not None]
                return [*arrows, "n" if done is None else "d", "Enter"]
            case wire.LabelFullAnswer():
                return [*(ARROWS[action] for action in answer.actions), "Enter"]
            case wire.HierDemoAnswer():
                raise AssertionError("a demonstration is played")
