"""A domain without a renderer: a real learner's run of it is answered in the page, by the pictures it sends."""

import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, Route, expect
from tests.browser.access.axe import violations_in_every_look
from tests.browser.conftest import Open
from tests.browser.kit import Complaints, Learner, wait_for_heading
from tests.learner.kit import corridor

from waypost import wire
from waypost.client import Client
from waypost.trajectory import Segment, Trajectory
from waypost_learner.algorithms.queries import InspectLo, LabelHi, LabelLo, Query
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


def ask_with_pictures(client: Client, query_of: Callable[[Trajectory], Query]) -> tuple[int, str]:
    """Ask about a way east and back, with pictures; return the query and its run."""
    domain, instance = CorridorDomain(), Corridor(2, 8)
    simulator = Simulator(domain)
    state, sigma = simulator.reset(instance), []
    for subgoal, actions in ((1, (1, 1)), (0, (0, 0, 0)), (2, (1, 1))):
        states = [state, *(simulator.step(action) for action in actions)]
        sigma.append(Segment(subgoal, tuple(states), actions, terminated=True))
        state = states[-1]
    camera = Camera(domain, instance)
    asked = Translator(domain, instance, camera).ask(query_of(tuple(sigma)), 0, 0)
    client.upload(camera.developed())
    run = client.create_run(wire.RunCreate(name="seen", algorithm="hg-dagger", seed=0, vocabulary=vocabulary(domain)))
    [query] = client.ask(run.id, [asked])
    return query.id, run.id


def ask_label_hi(client: Client) -> str:
    """Ask which subgoals were right on this way; return the run."""
    return ask_with_pictures(client, LabelHi)[1]


def steps(page: Page) -> Locator:
    """The stills on the film strip."""
    return page.get_by_role("list", name="Steps").get_by_role("listitem")


def box(page: Page, subgoal: str) -> Locator:
    """The box of a subgoal in the picture."""
    return page.get_by_role("button", name=f"Choose the subgoal {subgoal}")


def test_a_frame_on_the_strip_is_as_wide_and_as_high_as_its_picture(open_page: Open, served: Served) -> None:
    with client_of(served) as client:
        run = ask_label_hi(client)
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, LABEL_HI)
    for size in ({"width": 1440, "height": 900}, {"width": 768, "height": 1024}):
        page.set_viewport_size(size)
        expect(steps(page).locator("img").first).to_have_js_property("complete", True)
        for still in steps(page).locator("img").all():
            shown = still.bounding_box()
            assert shown is not None
            assert shown["width"] >= 180
            assert shown["width"] / shown["height"] == pytest.approx(13, rel=0.05), "thirteen cells side by side"


def test_pictures_show_where_each_subgoal_was_decided(open_page: Open, served: Served) -> None:
    with client_of(served) as client:
        run = ask_label_hi(client)
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, LABEL_HI)
    strip = steps(page)
    marks = strip.locator("abbr")
    expect(marks).to_have_text(["1E", "2W", "3T"])
    expect(strip).to_have_count(4)  # and the second state of the current segment
    page.keyboard.press("ArrowDown")
    expect(strip).to_have_count(5)
    expect(strip.nth(1)).to_have_attribute("aria-current", "step")
    assert agents_cell(page) == 4
    page.keyboard.press("?")
    help_ = page.get_by_role("dialog", name="Keys")
    expect(help_).to_contain_text("Under the picture are the states where a subgoal was chosen, and the steps")
    expect(help_).not_to_contain_text("ring")
    page.keyboard.press("Escape")
    page.keyboard.press("Shift+Enter")


def test_a_click_in_a_box_chooses_its_subgoal_and_one_on_the_strip_goes_there(
    open_page: Open, served: Served, learner: Learner
) -> None:
    with client_of(served) as client:
        query, run = ask_with_pictures(client, LabelHi)
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, LABEL_HI)
    box(page, "east").click()
    expect(page.get_by_text("1 of 3")).to_be_visible()
    steps(page).nth(4).get_by_role("button").click()  # where the third subgoal was chosen
    expect(page.locator("li [aria-current=step]")).to_contain_text("3")
    assert agents_cell(page) == 1
    shown = page.locator("img.shown").bounding_box()
    target = box(page, "target").bounding_box()
    assert shown is not None
    assert target is not None
    assert target["x"] - shown["x"] == pytest.approx(shown["width"] * 8 / 13, abs=1)
    box(page, "target").click()
    expect(page.get_by_role("list", name="Places of subgoals").get_by_role("button", pressed=True)).to_have_text("T")
    assert violations_in_every_look(page) == []
    page.keyboard.press("Shift+Enter")
    assert learner.answer_of(query)["subgoals"] == ["east", "west", "target"]


def test_boxes_are_only_looked_at_where_no_subgoal_is_asked_for(open_page: Open, served: Served) -> None:
    with client_of(served) as client:
        _, run = ask_with_pictures(client, lambda sigma: InspectLo(sigma[1], sigma[:1]))
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, "It tried “west”. Did that work?")
    places = page.get_by_role("list", name="Places of subgoals")
    expect(places.locator(".asked abbr")).to_have_text("W")
    expect(places.get_by_role("button")).to_have_count(0)
    steps(page).nth(2).get_by_role("button").click()
    assert agents_cell(page) == 3
    assert violations_in_every_look(page) == []


def test_a_click_on_the_strip_marks_the_first_wrong_step(open_page: Open, served: Served, learner: Learner) -> None:
    with client_of(served) as client:
        query, run = ask_with_pictures(client, lambda sigma: LabelLo(sigma[1], sigma[:1]))
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, "It tried “west”. What should it have done at each step?")
    strip = steps(page)
    expect(strip).to_have_count(5)  # the earlier segment's start, and four states
    strip.nth(3).get_by_role("button").click()
    expect(page.get_by_text("2 of 4")).to_be_visible()
    expect(strip.nth(2)).to_contain_text("west")  # the label, under the picture
    assert agents_cell(page) == 2
    strip.nth(1).get_by_role("button").click()  # it is labeled, so this only goes there
    expect(page.get_by_text("2 of 4")).to_be_visible()
    strip.nth(3).get_by_role("button").click()
    assert violations_in_every_look(page) == []
    page.get_by_role("group", name="Action at state").get_by_role("button", name="east").click()
    page.keyboard.press("Shift+Enter")
    assert learner.answer_of(query)["actions"] == ["west", "west", "east"]


def test_the_strip_is_walked_by_keyboard(open_page: Open, served: Served) -> None:
    with client_of(served) as client:
        _, run = ask_with_pictures(client, lambda sigma: InspectLo(sigma[1], sigma[:1]))
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, "It tried “west”. Did that work?")
    steps(page).last.get_by_role("button").focus()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowLeft")
    expect(steps(page).nth(2).get_by_role("button")).to_be_focused()
    assert agents_cell(page) == 3


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
