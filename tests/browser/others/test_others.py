"""The page in Firefox and WebKit: each kind of question is answered from the keyboard, as in Chromium."""

import time
from collections.abc import Iterator

import pytest
from tests.browser.kit import Learner, ask, login_link
from tests.browser.others.drivers import OtherBrowser, started

from waypost_server.serving import Served

ESCAPE, ENTER, BACKSPACE, SHIFT, CONTROL = "\ue00c", "\ue007", "\ue003", "\ue008", "\ue009"
UP = "\ue013"
PATIENCE_SECONDS = 20
SHOWN = "return document.querySelector('#question')?.textContent ?? document.querySelector('h1')?.textContent"
pytestmark = [  # of the libraries that drive the browsers
    pytest.mark.filterwarnings("ignore:distro.linux_distribution"),
    pytest.mark.filterwarnings("ignore:'telnetlib' is deprecated"),
    pytest.mark.filterwarnings("ignore:unclosed"),
    pytest.mark.filterwarnings("ignore:setting remote_server_addr"),
]
ERRORS = "window.errors ??= []; window.addEventListener('error', (event) => window.errors.push(event.message))"


@pytest.fixture(params=["firefox", "webkit"])
def other(request: pytest.FixtureRequest) -> Iterator[OtherBrowser]:
    with started(request.param) as browser:
        yield browser


def wait_for(browser: OtherBrowser, script: str, wanted: object) -> None:
    """Wait until a script has this result."""
    deadline = time.monotonic() + PATIENCE_SECONDS
    while (found := browser.script(script)) != wanted:
        assert time.monotonic() < deadline, f"{script} gives {found!r}, not {wanted!r}"
        time.sleep(0.05)


def test_each_kind_of_question_is_answered_from_the_keyboard(
    other: OtherBrowser, learner: Learner, served: Served, request: pytest.FixtureRequest
) -> None:
    run = learner.create_run("other browsers")
    kinds = ("inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")
    asks = [ask(kind, 0, ordinal, question=f"{ordinal}: {kind}") for ordinal, kind in enumerate(kinds)]
    queries = learner.ask(run, *asks)
    other.open(login_link(served, f"in {request.node.name}", "annotator"))
    wait_for(other, "return document.body.innerText.includes('Skip the practice')", True)
    assert other.script("return location.search") == "?first=yes"
    other.press(ESCAPE)
    wait_for(other, "return location.pathname", "/work")
    other.open(f"{served.url}/work?run={run}")
    other.script(ERRORS)

    wait_for(other, SHOWN, "0: inspect_full")
    other.press("n")
    wait_for(other, SHOWN, "1: label_hi")
    other.press("u")
    wait_for(other, SHOWN, "0: inspect_full")
    other.press("y")
    wait_for(other, SHOWN, "1: label_hi")
    other.press("s")
    other.press(BACKSPACE)
    other.press("w")
    other.press(SHIFT, ENTER)
    wait_for(other, SHOWN, "2: inspect_lo")
    other.press("n")
    wait_for(other, SHOWN, "3: label_lo")
    other.press(UP)
    other.press("d")
    other.press(SHIFT, ENTER)
    wait_for(other, SHOWN, "4: label_full")
    other.press(CONTROL, "k")
    wait_for(other, "return document.querySelector('dialog[open] h1')?.textContent", "Find")
    for letter in "practice":
        other.press(letter)
    wait_for(other, "return document.querySelector('[aria-selected=true] .words')?.textContent", "Practice")
    other.press(ESCAPE)
    wait_for(other, "return document.querySelector('dialog[open]')", None)
    other.press(SHIFT, ENTER)
    wait_for(other, SHOWN, "No question right now")

    after = len(asks[3]["segments"][0]["actions"]) - 1
    everything = [action for segment in asks[4]["segments"] for action in segment["actions"]]
    assert [learner.answer_of(query) for query in queries] == [
        {"kind": "inspect_full", "verdict": "pass"},
        {"kind": "label_hi", "subgoals": ["west", "north", "east", "north", "east"]},
        {"kind": "inspect_lo", "verdict": "fail"},
        {"kind": "label_lo", "actions": ["up", *[None] * after], "terminations": [False, True, *[False] * after]},
        {"kind": "label_full", "actions": everything},
    ]
    assert other.script("return window.errors") == []
