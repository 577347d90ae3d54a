"""A domain without a renderer: a real learner's run of it is answered in the page, by the pictures it sends."""

import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, Route, expect
from tests.browser.conftest import Open
from tests.browser.kit import Complaints, Learner, wait_for_heading
from tests.learner.kit import corridor

from waypost import wire
from waypost.client import Client
from waypost.trajectory import Segment
from waypost_learner.algorithms.queries import LabelHi
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.training import RunOptions, train
from waypost_server.auth import tokens
from waypost_server.serving import Served
from waypost_server.users import service as users

LABEL_HI = "Which subgoal should it have chosen for each segment?"
AGENTS_CELL = """async img => {
    await img.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [img.naturalWidth, img.naturalHeight];
    const brush = canvas.getContext('2d', { willReadFrequently: true });
    brush.drawImage(img, 0, 0);
    const side = img.naturalHeight;
    for (let cell = 0; cell * side < img.naturalWidth; cell++) {
        const [red, green, blue] = brush.getImageData((cell + 0.5) * side, side / 2, 1, 1).data;
        if (red === 11 && green === 92 && blue === 150) return cell;
    }
    return null;
}"""


def agents_cell(page: Page) -> int:
    """Where the agent stands in the picture on the screen."""
    return int(page.locator("img.shown").evaluate(AGENTS_CELL))


@contextmanager
def client_of(served: Served) -> Iterator[Client]:
    user = served.db.write_now(lambda tx: users.ensure_user(tx, "corridor-learner", "learner"))
    client = Client(served.url, served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "test")).token)
    yield client
    client.close()


@dataclass
class Training:
    """A learner at work in a thread."""

    runs: list[str] = field(default_factory=list)
    ended: list[dict[str, Any]] = field(default_factory=list)


@pytest.fixture
def training(served: Served, tmp_path: Path) -> Iterator[Training]:
    """A learner of the corridor that asks people."""
    training, began = Training(), threading.Event()

    def note(run: wire.Run, _first: int) -> None:
        training.runs.append(run.id)
        began.set()

    with ExitStack() as stack:
        connection = Connection(stack.enter_context(client_of(served)), None)
        options = RunOptions(name="corridor", checkpoints=tmp_path, threads=1)
        config = corridor(episodes=2, warm_start=0)
        thread = threading.Thread(target=lambda: training.ended.append(train(config, connection, options, note)))
        thread.start()
        assert began.wait(30)
        yield training
        thread.join(30)


def next_query(page: Page, last: str | None, training: Training) -> str | None:
    """The number of the query that comes after the last one, or None when the run is over."""
    while not training.ended:
        shown = page.locator("#question").get_attribute("data-query")
        if shown not in (None, last):
            return shown
        page.wait_for_timeout(50)
    return None


def test_a_run_of_a_domain_without_a_renderer_is_answered_in_the_page(
    open_page: Open, learner: Learner, training: Training
) -> None:
    page = open_page(f"/work?run={training.runs[0]}")
    query, kinds = None, []
    while (query := next_query(page, query, training)) is not None:
        ask = learner.query(int(query))["ask"]
        kinds.append(ask["kind"])
        for key, state in (("Home", ask["segments"][0]["states"][0]), ("End", ask["segments"][-1]["states"][-1])):
            page.keyboard.press(key)
            assert agents_cell(page) == state
        page.keyboard.press("f" if "inspect" in ask["kind"] else "Shift+Enter")
    assert kinds[:2] == ["inspect_full", "label_hi"]
    assert {"inspect_lo", "label_lo"} <= set(kinds)
    assert training.ended[0]["episodes"] == 2


def ask_label_hi(client: Client) -> str:
    """Ask which subgoals were right on a way east and back, with pictures; return the run."""
    domain, instance = CorridorDomain(), Corridor(2, 8)
    simulator = Simulator(domain)
    state, sigma = simulator.reset(instance), []
    for subgoal, actions in ((1, (1, 1)), (0, (0, 0, 0)), (2, (1, 1))):
        states = [state, *(simulator.step(action) for action in actions)]
        sigma.append(Segment(subgoal, tuple(states), actions, terminated=True))
        state = states[-1]
    camera = Camera(domain, instance)
    asked = Translator(domain, instance, camera).ask(LabelHi(tuple(sigma)), 0, 0)
    client.upload(camera.developed())
    run = client.create_run(wire.RunCreate(name="seen", algorithm="hg-dagger", seed=0, vocabulary=vocabulary(domain)))
    client.ask(run.id, [asked])
    return run.id


def test_pictures_show_where_each_subgoal_was_decided(open_page: Open, served: Served) -> None:
    with client_of(served) as client:
        run = ask_label_hi(client)
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, LABEL_HI)
    strip = page.get_by_role("list", name="Where each subgoal was chosen").get_by_role("listitem")
    expect(strip).to_have_text(["1E", "2W", "3T"])
    page.keyboard.press("ArrowDown")
    expect(strip.nth(1)).to_have_attribute("aria-current", "step")
    assert agents_cell(page) == 4
    size = strip.first.get_by_role("presentation").bounding_box()
    assert size is not None
    assert size["height"] >= 72
    page.keyboard.press("?")
    help_ = page.get_by_role("dialog", name="Keys")
    expect(help_).to_contain_text("Under the picture are the states where a subgoal was chosen.")
    expect(help_).not_to_contain_text("ring")
    page.keyboard.press("Escape")
    page.keyboard.press("Shift+Enter")


def test_a_picture_that_does_not_load_gives_way_to_the_state_as_text(
    open_page: Open, served: Served, complaints: Complaints
) -> None:
    complaints.expect("net::ERR_FAILED")
    with client_of(served) as client:
        run = ask_label_hi(client)
    page = open_page("/login", intercepted=True)
    page.route("**/api/v1/frames/*", lambda route: route.abort())
    page.goto(f"/work?run={run}")
    wait_for_heading(page, LABEL_HI)
    expect(page.get_by_text("this is the state as the learner sent it")).to_be_visible()
    page.keyboard.press("Shift+Enter")


def test_pictures_are_there_before_they_are_shown(open_page: Open, served: Served) -> None:
    with client_of(served) as client:
        run = ask_label_hi(client)
    page = open_page("/login", intercepted=True)
    fetched: list[str] = []

    def note(route: Route) -> None:
        fetched.append(route.request.url)
        route.continue_()

    page.route("**/api/v1/frames/*", note)
    page.goto(f"/work?run={run}")
    wait_for_heading(page, LABEL_HI)
    while len(set(fetched)) < 4:  # the cells from 1 to 4
        page.wait_for_timeout(20)
    for _ in range(7):
        page.keyboard.press("ArrowRight")
    assert agents_cell(page) == 3
    assert len(fetched) == 4, "each of them once"
    page.keyboard.press("Shift+Enter")
