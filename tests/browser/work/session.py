"""One person's session at the page, as a script that a seed fixes: answers, typing errors, reloads and worse.

The script knows what it meant to answer. The server must end with exactly that, each question charged once.
"""

import json
import random
import re
import time
from collections import Counter
from collections.abc import Callable

from playwright.sync_api import BrowserContext, Locator, Page, expect
from tests.browser.hands.keyboard import give, press
from tests.browser.kit import ROLLOUT, VOCABULARY, Complaints, Json, Learner, ask

from waypost import wire

KINDS = ("inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")
OPEN = 8  # questions that are open, so that the page can lease ahead
EDITS = 20  # more than a question can have: its labels, where it is done, typing errors
LAST = 120  # seconds in which everything is answered at the end; a lease that was left behind takes one minute
USED_AFTER = 12  # answers: then the learner has used an answer, as a rule
FILL = """() => {
  for (const storage of [localStorage, sessionStorage]) {
    for (let size = 2 ** 22; size >= 1; size /= 2)
      for (let part = 0; ; part++)
        try { storage.setItem(`full ${size} ${part}`, 'x'.repeat(size)) } catch { break }
  }
}"""
EMPTY = """() => {
  for (const storage of [localStorage, sessionStorage])
    for (const key of Object.keys(storage)) if (key.startsWith('full ')) storage.removeItem(key)
}"""


class Session:
    """Drives one or two tabs of one person.

    Args:
        seed: it fixes what the person does, but not how fast the server is.
        context: the browser of the person, who is signed in.
        learner: it asks and uses answers.
        pace: the mean pause before a key, in seconds; 0 is as fast as the browser allows.
    """

    def __init__(
        self, seed: int, context: BrowserContext, learner: Learner, complaints: Complaints, pace: float
    ) -> None:
        self._random = random.Random(seed)
        self._context, self._learner, self._complaints, self._pace = context, learner, complaints, pace
        self._run = learner.create_run(f"session {seed}")
        self._meant: dict[int, Json] = {}  # what was last sent as the answer of a question
        self._asked: dict[int, Json] = {}
        self._given: set[int] = set()  # questions with an answer that was not taken back
        self._answered: list[int] = []  # in the order of the answers; used ones are removed
        self._sent: dict[Page, int] = {}  # the question that was just answered may stay until the next one is there
        self._full = False
        self.did: Counter[str] = Counter()
        self._ask_more()
        self._tab = self._open_tab()

    def work(self, over: Callable[[], bool]) -> None:
        """Do one thing after another until it is over, and then answer what is left."""
        deeds = {
            self._answer: 100,
            self._err: 15,
            self._reload: 4,
            self._lose_the_network: 4,
            self._change_tabs: 5,
            self._fill_the_storage: 2,
        }
        while not over():
            [deed] = self._random.choices([*deeds], [*deeds.values()])
            deed()
            self._learn()
        deadline = time.monotonic() + LAST
        while self._without_answer():
            assert time.monotonic() < deadline, f"no answer: {self._without_answer()}"
            for tab in self._context.pages:  # each holds questions
                self._tab = tab
                tab.bring_to_front()
                while (shown := self._question(patience=1)) is not None:
                    self._give(shown)
        for tab in self._context.pages:
            expect(self._unsaved(tab)).to_have_count(0)

    def check(self) -> None:
        """What the server has is what the person meant, and what it charged is what that costs, once."""
        found = {number: self._learner.query(number) for number in self._asked}
        wrong = {
            n: (query["answer"], self._meant[n]) for n, query in found.items() if query["answer"] != self._meant[n]
        }
        assert not wrong, wrong
        costs = self._learner.call("GET", f"/runs/{self._run}/costs")
        assert costs["total"] == sum(query["units"] for query in found.values())
        assert costs["reserved"] == 0

    # --- what a person does

    def _answer(self) -> None:
        if (shown := self._question()) is not None:
            if self._random.random() < 0.3:
                self._mistype(shown)
            self._give(shown)
            self.did["answer"] += 1

    def _err(self) -> None:
        """Send a wrong answer, and take it back, unless the learner was faster."""
        if (shown := self._question()) is None:
            return
        self._give(shown)
        self._pause()
        if self._random.random() < 0.1:
            self._learner.answer_of(shown)
            self._learner.use(shown)
        self._take_back(shown)

    def _take_back(self, shown: int) -> None:
        """Take back the answer of a question, which was the last one in this tab, and give another."""
        before = self._said()
        self._tab.keyboard.press("u")
        deadline = time.monotonic() + 20
        while self._shown() != shown or "Taken back" not in self._said():
            said = self._said()
            if said != before and "used that answer" in said:
                self.did["too late to take back"] += 1
                return
            assert time.monotonic() < deadline, f"U after {shown} shows {self._shown()}: {said}"
            self._tab.wait_for_timeout(20)
        self._given.remove(shown)
        self._give(shown)
        self.did["taken back"] += 1

    def _reload(self) -> None:
        """Reload, perhaps within an answer, or just after one was sent."""
        if self._would_be_lost():
            return
        if (shown := self._question()) is not None:
            match self._random.randrange(3):
                case 0:
                    self._mistype(shown, undone=False)
                case 1:
                    self._give(shown)
        if not self._would_be_lost():
            self._tab.reload()
            self._sent.pop(self._tab, None)
            self.did["reload"] += 1

    def _lose_the_network(self) -> None:
        self._context.set_offline(True)
        last = None
        for _ in range(self._random.randrange(4)):
            if (shown := self._question(patience=0.5)) is not None:
                self._give(shown)
                last = shown
                self.did["answer without network"] += 1
        takes_back = last is not None and self._random.random() < 0.5
        if takes_back:
            self._tab.keyboard.press("u")
            expect(self._tab.get_by_text("not saved yet")).to_be_visible()
        self._tab.wait_for_timeout(1000 * self._random.uniform(0, 5 if self._pace else 1))
        self._context.set_offline(False)
        self.did["outage"] += 1
        if last is not None and takes_back:
            expect(self._unsaved(self._tab)).to_have_count(0)
            self._take_back(last)

    def _change_tabs(self) -> None:
        """Open a second tab, go to the other, or close one."""
        if len(self._context.pages) == 1:
            self._tab = self._open_tab()
        elif self._random.random() < 0.3 and self._unsaved(self._tab).count() == 0:
            self._tab.close()
            [self._tab] = self._context.pages
        else:
            [self._tab] = [tab for tab in self._context.pages if tab != self._tab]
            self._tab.bring_to_front()
        self.did["other tab"] += 1

    def _fill_the_storage(self) -> None:
        self._tab.evaluate(EMPTY if self._full else FILL)
        self._full = not self._full
        self.did["full storage" if self._full else "free storage"] += 1

    # --- how

    def _open_tab(self) -> Page:
        page = self._context.new_page()
        self._complaints.listen(page)
        page.on("dialog", lambda dialog: dialog.accept())  # a reload while an answer is unsaved
        page.goto(f"/work?run={self._run}")
        return page

    def _question(self, patience: float = 20) -> int | None:
        """Return the question on the screen, once there is one."""
        deadline = time.monotonic() + patience
        sent = self._sent.get(self._tab)
        while (shown := self._shown()) in {None, sent} and time.monotonic() < deadline:
            self._tab.wait_for_timeout(20)
        return None if shown == sent else shown

    def _shown(self) -> int | None:
        number = self._tab.evaluate("document.querySelector('#question')?.dataset.query ?? null")
        return None if number is None else int(number)

    def _said(self) -> str:
        return str(self._tab.evaluate("[...document.querySelectorAll('[role=status]')].map(e => e.innerText).join()"))

    def _unsaved(self, tab: Page) -> Locator:
        return tab.get_by_text(re.compile(r"\d unsaved"))

    def _would_be_lost(self) -> bool:
        """Whether the page says that an answer would be lost with the tab; then a person leaves it open."""
        return any(tab.get_by_text("lost if this tab closes").is_visible() for tab in self._context.pages)

    def _pause(self) -> None:
        if self._pace:
            self._tab.wait_for_timeout(1000 * self._random.expovariate(1 / self._pace))

    def _mistype(self, shown: int, undone: bool = True) -> None:
        """Label something by mistake; undo it, or not."""
        kind = self._asked[shown]["kind"]
        if not kind.startswith("label_"):
            return
        group, names = ("Subgoal", VOCABULARY["subgoals"]) if kind == "label_hi" else ("Action", VOCABULARY["actions"])
        count = self._random.randrange(1, 3)
        for _ in range(count):
            press(self._tab, group, self._random.choice(names))
            self._pause()
        for _ in range(count if undone else 0):
            self._tab.keyboard.press("Backspace")
            self._pause()
        self.did["typing error"] += 1

    def _give(self, shown: int) -> None:
        """Answer a question with something that the person means."""
        assert shown not in self._given, f"question {shown} was answered, and is asked again"
        for _ in range(EDITS if self._asked[shown]["kind"].startswith("label_") else 0):
            self._tab.keyboard.press("Backspace")  # whatever is there from an earlier try
        answer = self._any_answer(self._asked[shown])
        self._meant[shown] = json.loads(answer.model_dump_json())
        self._pause()
        give(self._tab, answer)
        self._given.add(shown)
        self._sent[self._tab] = shown
        self._answered.append(shown)

    def _any_answer(self, asked: Json) -> wire.Answer:
        subgoals, actions = VOCABULARY["subgoals"], VOCABULARY["actions"]
        draw = self._random
        match asked["kind"]:
            case "inspect_full" | "inspect_lo":
                return wire.InspectAnswer(kind=asked["kind"], verdict=draw.choice(["pass", "fail"]))
            case "label_hi":
                return wire.LabelHiAnswer(kind="label_hi", subgoals=draw.choices(subgoals, k=len(ROLLOUT)))
            case "label_lo":
                steps = len(asked["segments"][0]["actions"])
                done = [False] * steps + [draw.random() < 0.5]
                return wire.LabelLoAnswer(kind="label_lo", actions=draw.choices(actions, k=steps), terminations=done)
            case _:
                steps = sum(len(segment["actions"]) for segment in asked["segments"])
                return wire.LabelFullAnswer(kind="label_full", actions=draw.choices(actions, k=steps))

    # --- the learner

    def _without_answer(self) -> list[int]:
        return [number for number in self._asked if self._learner.query(number)["state"] != "answered"]

    def _ask_more(self) -> None:
        asks = []
        for _ in range(OPEN):
            number = len(self._asked) + len(asks)
            asks.append(ask(self._random.choice(KINDS), number // 3, number % 3, question=f"Question {number}"))
        self._asked |= dict(zip(self._learner.ask(self._run, *asks), asks, strict=True))

    def _learn(self) -> None:
        """Ask more, and use old answers, as a learner does."""
        if len(self._asked) - len(set(self._meant)) < OPEN:
            self._ask_more()
        while len(self._answered) > USED_AFTER:
            number = self._answered.pop(0)
            if self._learner.query(number)["state"] == "answered":  # not if it was just taken back
                self._learner.use(number)
