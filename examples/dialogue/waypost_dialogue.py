"""The flight dialogue: a domain in which a system books a flight for a simulated user by talking.

`FlightDialogue` is the environment with the simulated user. `flight_dialogue` is the domain for Waypost.
"""

import copy
import re
import zlib
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

import waypost

SLOTS = {
    "city": ("Lisbon", "Oslo", "Rome", "Vienna"),
    "day": ("Monday", "Wednesday", "Friday", "Sunday"),
    "time": ("morning", "afternoon", "evening"),
}
QUESTIONS = {"city": "Where would you like to fly?", "day": "On which day?", "time": "At what time of day?"}
REQUESTS, VERIFICATIONS = [f"request_{slot}" for slot in SLOTS], [f"verify_{slot}" for slot in SLOTS]
ACTIONS = [*REQUESTS, *VERIFICATIONS, "propose", "regret", "summarize", "book"]  # the system's dialogue acts
WORDS = 128  # places for words in an observation
PATIENCE = 3  # useless turns after which the user leaves

State = dict[str, Any]


class FlightDialogue(gymnasium.Env[NDArray[np.float32], np.int64]):
    """One dialogue with a simulated user, who is random but always the same for the same seed and the same acts.

    The user wants a city, a day and a time, and tells a wish when asked. The user may be hard to understand the first
    time, may name two wishes at once, may reject the first flight, and may change a wish before the booking. If no
    flight is left, the user takes another day. The user leaves after three useless turns.

    The observation float32[133] is whether the value of each slot is known, whether a flight is left, whether none is
    left, and the words of the last two utterances, each marked in one of 128 places by its hash. The reward is 1 for
    booking a flight to which the user agreed.
    """

    def __init__(self) -> None:
        self.observation_space = spaces.Box(0, 1, (len(SLOTS) + 2 + WORDS,), np.float32)
        self.action_space = spaces.Discrete(len(ACTIONS))

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Draw a user, who begins the dialogue. There are no options."""
        super().reset(seed=seed, options=options)
        self._wish = {slot: self._draw(values) for slot, values in SLOTS.items()}
        self._picky, self._fickle, self._disappointed = self._chance(0.3), self._chance(0.3), False
        self._asked: set[str] = set()
        self.state: State = {"turns": [], "known": {}, "unsure": {}, "flights": None, "accepted": False}
        self.state |= {"agreed": False, "useful": True, "useless": 0, "end": None}
        told = [self._tell(slot) for slot in SLOTS if self._chance(0.25)]
        self._say("user", f"Hello, I need a flight. {' '.join(told)}".strip())
        return self._observe(), {}

    def step(self, action: np.int64) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Let the system speak and the user reply."""
        act, *slot = ACTIONS[int(action)].split("_")
        utterance, reply = getattr(self, f"_{act}")(*slot)
        self.state["useful"] = reply is not None
        if reply is None:
            self.state["useless"] += 1
            reply = "That makes no sense to me."
            if self.state["useless"] == PATIENCE:
                self.state["end"], reply = "left", "This leads nowhere. Goodbye."
        self._say("system", utterance)
        self._say("user", reply)
        booked = self.state["end"] == "booked"
        return self._observe(), float(booked), self.state["end"] is not None, False, {}

    # --- the system's acts: each returns the utterance, and the user's reply, or None if the act is useless

    def _request(self, slot: str) -> tuple[str, str | None]:
        if slot in self.state["known"]:
            return QUESTIONS[slot], None
        manner = "clear" if slot in self._asked else self._draw(("clear", "clear", "clear", "unclear", "silent"))
        self._asked.add(slot)
        if manner == "silent":
            return QUESTIONS[slot], "Pardon?"
        if manner == "unclear":
            self.state["unsure"][slot] = self._wish[slot] if self._chance(0.6) else self._draw(SLOTS[slot])
            return QUESTIONS[slot], f"(hard to understand) … {self.state['unsure'][slot]} …"
        others = [other for other in SLOTS if other not in self.state["known"] and other != slot and self._chance(0.2)]
        return QUESTIONS[slot], " ".join(self._tell(told) for told in [slot, *others])

    def _verify(self, slot: str) -> tuple[str, str | None]:
        if slot not in self.state["unsure"]:
            return f"Is this the {slot} that you want?", None
        question = f"Did you say {self.state['unsure'].pop(slot)}?"
        if question != f"Did you say {self._wish[slot]}?":
            return question, "No."
        self._tell(slot)
        return question, "Yes."

    def _propose(self) -> tuple[str, str | None]:
        if not self.state["flights"] or self.state["accepted"]:
            return "I have a flight for you.", None
        self.state["flights"] -= 1
        offer = f"Flight {self.np_random.integers(100, 1000)} goes to {self._summary()}. Would you like it?"
        if self._picky:
            self._picky = False
            return offer, "No, it is too expensive. Is there another one?"
        self.state["accepted"] = True
        return offer, "Yes, I would."

    def _regret(self) -> tuple[str, str | None]:
        if self.state["flights"] != 0 or self.state["accepted"]:
            return "I am sorry, there is no flight.", None
        message = f"I am sorry, there is no other flight to {self._summary()}."
        self._disappointed = True
        self._reopen("day")
        return message, "Then I take another day."

    def _summarize(self) -> tuple[str, str | None]:
        summary = f"You fly to {self._summary()}. Is this right?"
        if not self.state["accepted"] or self.state["agreed"]:
            return summary, None
        if self._fickle:
            self._fickle = False
            slot = self._draw(tuple(SLOTS))
            self._reopen(slot)
            return summary, f"Sorry, I would like another {slot}."
        self.state["agreed"] = True
        return summary, "Yes, that is right."

    def _book(self) -> tuple[str, str | None]:
        if not self.state["accepted"]:
            return "I book the flight.", None
        self.state["end"] = "booked" if self.state["agreed"] else "refused"
        return "I book the flight.", "Thank you!" if self.state["agreed"] else "I have not agreed to that! Goodbye."

    # --- the tracker and the user

    def _tell(self, slot: str) -> str:
        """Let the user tell a wish clearly."""
        self.state["known"][slot] = self._wish[slot]
        self.state["unsure"].pop(slot, None)
        if len(self.state["known"]) == len(SLOTS):
            self.state["flights"] = int(self.np_random.integers(self._disappointed, 3))
        return f"The {slot}: {self._wish[slot]}."

    def _reopen(self, slot: str) -> None:
        """Let the user change a wish, which the system must then ask again."""
        self._wish[slot] = self._draw([value for value in SLOTS[slot] if value != self._wish[slot]])
        self._asked.discard(slot)
        del self.state["known"][slot]
        self.state |= {"flights": None, "accepted": False}

    def _summary(self) -> str:
        return ", ".join(self.state["known"].get(slot, f"any {slot}") for slot in SLOTS)

    def _say(self, speaker: str, text: str) -> None:
        self.state["turns"].append({"speaker": speaker, "text": text})

    def _draw(self, values: Any) -> str:
        return str(values[self.np_random.integers(len(values))])

    def _chance(self, probability: float) -> bool:
        return bool(self.np_random.random() < probability)

    def _observe(self) -> NDArray[np.float32]:
        known = [slot in self.state["known"] for slot in SLOTS]
        words = np.zeros(WORDS, np.float32)
        for turn in self.state["turns"][-2:]:
            for word in re.findall("[a-z…]+", turn["text"].lower()):
                words[zlib.crc32(word.encode()) % WORDS] = 1
        left, none = (self.state["flights"] or 0) > 0, self.state["flights"] == 0
        return np.array([*known, left, none, *words], np.float32)


def view(env: Any) -> State:
    """Return the tracker's state: what experts see, and the turns so far."""
    state: State = copy.deepcopy(env.state)
    return state


# --- the expert: what to say follows from the tracker's state, never from the user's hidden wishes


def good_subgoals(state: State) -> list[str]:
    """Ask for all wishes, in any order; then offer a flight; then confirm it."""
    if state["end"]:
        return []
    return [f"ask_{slot}" for slot in _open(state)] or ["confirm" if state["accepted"] else "offer"]


def reached(origin: State, state: State, subgoal: str) -> bool:
    """Asking ends when the wish is known; offering and confirming also end when the user opens a wish again.

    After a useless act nothing counts as accomplished: the segment should have ended before.
    """
    del origin
    act, _, slot = subgoal.partition("_")
    done = slot in state["known"] if act == "ask" else state["accepted"] if act == "offer" else succeeded(state)
    return state["useful"] and bool(done or (act != "ask" and _open(state)))


def good_actions(origin: State, state: State, subgoal: str) -> list[str]:
    """Return the dialogue act that brings the subgoal forward; none if the segment should have ended."""
    del origin
    act, _, slot = subgoal.partition("_")
    if state["end"] or slot in state["known"] or (act != "ask" and _open(state)):
        return []
    if act == "ask":
        return [f"verify_{slot}" if slot in state["unsure"] else f"request_{slot}"]
    if not state["accepted"]:  # also toward `confirm`, which needs an accepted flight
        return ["propose" if state["flights"] else "regret"]
    return [] if act == "offer" else ["book" if state["agreed"] else "summarize"]


def succeeded(state: State) -> bool:
    """Return whether a flight is booked to which the user agreed."""
    return bool(state["end"] == "booked")


def _open(state: State) -> list[str]:
    return [slot for slot in SLOTS if slot not in state["known"]]


flight_dialogue = waypost.domain(
    FlightDialogue,
    name="flight-dialogue",
    subgoals=[*(f"ask_{slot}" for slot in SLOTS), "offer", "confirm"],
    actions=ACTIONS,
    horizons=(8, 16, 40),
    state=view,
    succeeded=succeeded,
    reached=reached,
    good_subgoals=good_subgoals,
    good_actions=good_actions,
)
