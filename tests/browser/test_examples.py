"""The domains in `examples`: one query of each kind is answered in the page with the keyboard alone."""

from collections.abc import Iterator, Sequence
from contextlib import closing

import pytest
from playwright.sync_api import Page, expect
from tests.browser.conftest import WIDE, Open
from tests.browser.kit import Learner, wait_for_heading
from tests.browser.test_access import violations

from waypost import wire
from waypost.client import Client
from waypost.domains import find_domain
from waypost_learner.algorithms.learner import Learner as Policies
from waypost_learner.algorithms.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Query
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.presets import find_preset
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.stage import offer
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_server.auth import tokens
from waypost_server.serving import Served
from waypost_server.users import service as users

DOMAINS = ["waypost_minigrid:unlock_pickup"]
SIZES = {"desktop": WIDE, "tablet": {"width": 768, "height": 1024}}
PRESSED = {"←": "ArrowLeft", "→": "ArrowRight", "↑": "ArrowUp", "↓": "ArrowDown"}


@pytest.fixture
def client(served: Served) -> Iterator[Client]:
    """A learner's client."""
    user = served.db.write_now(lambda tx: users.ensure_user(tx, "example-learner", "learner"))
    token = served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "test")).token
    with closing(Client(served.url, token)) as client:
        yield client


def key_of(page: Page, name: str) -> str:
    """The key that the page prints on the button with this name."""
    button = page.get_by_title(name.replace("_", " "), exact=True)
    printed = button.locator("kbd").inner_text()
    return PRESSED.get(printed, printed.lower())


def press(page: Page, keys: Sequence[str]) -> None:
    for key in keys:
        page.keyboard.press(key)


def play(page: Page, answer: wire.HierDemoAnswer) -> None:
    """Play a demonstration as the oracle would."""
    page.locator("[data-stage=here]").wait_for()
    for segment in answer.segments:
        if segment is not answer.segments[0]:
            page.keyboard.press("Enter")
        page.keyboard.press(key_of(page, str(segment.subgoal)))
        press(page, [key_of(page, action) for action in segment.actions])
    page.get_by_text("The task is accomplished. Send the demonstration.").wait_for()
    page.keyboard.press("Enter")


def keys_of(page: Page, answer: wire.Answer) -> list[str]:
    """The keys that give an answer."""
    match answer:
        case wire.InspectAnswer():
            return ["p" if answer.verdict == "pass" else "f"]
        case wire.LabelHiAnswer():
            return [*(key_of(page, name) for name in answer.subgoals), "Enter"]
        case wire.LabelLoAnswer():
            ended = answer.terminations.index(True) if True in answer.terminations else None
            labels = [key_of(page, name) for name in answer.actions[:ended] if name is not None]
            return [*labels, "n" if ended is None else "d", "Enter"]
        case wire.LabelFullAnswer():
            return [*(key_of(page, name) for name in answer.actions), "Enter"]
        case wire.HierDemoAnswer():
            raise AssertionError("a demonstration is played")


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("place", DOMAINS)
def test_one_query_of_each_kind_is_answered_with_the_keyboard_alone(
    open_page: Open, learner: Learner, client: Client, place: str, size: str
) -> None:
    domain = find_domain(place)
    instance = domain.instances("random").train[0]
    policies = Policies(domain, find_preset("lean"), seed=0, threads=1)
    s = policies.start(instance, 0)
    sigma = policies.roll_out(s)
    queries: list[Query] = [
        InspectFull(sigma),
        LabelHi(sigma),
        InspectLo(sigma[0]),
        LabelLo(sigma[0]),
        LabelFull(sigma[:2]),
        HierDemo(s.state),
    ]
    camera = Camera(domain, instance)
    translator, expert = Translator(domain, instance, camera), OracleExpert(domain)
    run = client.create_run(wire.RunCreate(name=place, algorithm="hg-dagger", seed=0, vocabulary=vocabulary(domain))).id
    page = open_page(f"/work?run={run}", size=SIZES[size])
    for ordinal, query in enumerate(queries):
        ask = translator.ask(query, 0, ordinal)
        client.upload(camera.developed())
        [asked] = client.ask(run, [ask])
        answer = expert(ask)
        wait_for_heading(page, ask.question)
        if isinstance(answer, wire.HierDemoAnswer):
            withdraw = offer(lambda number=asked.id: client.play(number), translator, client.upload)
            play(page, answer)
            withdraw()
        else:
            if isinstance(query, LabelHi):
                expect(page.locator("img.shown")).to_be_visible()
                assert violations(page) == []
            press(page, keys_of(page, answer))
        assert learner.answer_of(asked.id) == answer.model_dump(mode="json")
