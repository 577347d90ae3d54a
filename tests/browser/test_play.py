"""A demonstration played in the page with the keyboard, and all that can come in between."""

from pathlib import Path

import httpx2
import pytest
from playwright.sync_api import Locator, Page, expect
from sqlalchemy import update
from tests.browser.conftest import Open, Stage
from tests.browser.kit import LETTERS, START, Complaints, Json, Learner, maze, wait_for_heading

from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_server import serving
from waypost_server.db.tables import assignments
from waypost_server.settings import Settings

QUESTION = "Do the whole task yourself, one subgoal after the other."
KEYS = {"u": "ArrowUp", "d": "ArrowDown", "l": "ArrowLeft", "r": "ArrowRight"}
WAY = [("n", "uuu"), ("1", "uluuu"), ("e", "urrrr"), ("4", "drrrr"), ("n", "uuruu"), ("e", "rrr"), ("t", "ur")]
SEGMENTS = [
    {"subgoal": subgoal, "actions": [LETTERS[step] for step in steps]}
    for subgoal, (_, steps) in zip(
        ["north", "north", "east", "east", "north", "east", "go_to_target"], WAY, strict=True
    )
]

CORRIDOR = Translator(CorridorDomain(), Corridor(3, 6))


def ask(**more: object) -> Json:
    common = {"kind": "hier_demo", "episode": 0, "ordinal": 0, "instance": maze(), "question": QUESTION}
    return common | {"state": list(START), "max_segments": 16, "max_actions": 100} | more


def is_here(page: Page) -> None:
    """Wait until the learner's environment is there."""
    wait_for_heading(page, QUESTION)
    page.locator("[data-stage=here]").wait_for()


def press(page: Page, *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)


def walk(page: Page, steps: str) -> None:
    press(page, *(KEYS[step] for step in steps))


def way(page: Page, legs: list[tuple[str, str]]) -> None:
    """Play segments, each reached."""
    for key, steps in legs:
        press(page, key)
        walk(page, steps)
        press(page, "Enter")


def send(page: Page) -> None:
    """Send what succeeded."""
    page.get_by_text("The task is accomplished. Send the demonstration.").wait_for()
    press(page, "Enter")


def steps(page: Page) -> Locator:
    return page.locator("[aria-label=Progress] strong").first


def test_a_demonstration_is_played_with_the_keyboard(open_page: Open, learner: Learner, stage: Stage) -> None:
    run = learner.create_run("played")
    [query] = learner.ask(run, ask())
    page = open_page(f"/work?run={run}", role="admin")  # only those who pay see prices
    wait_for_heading(page, QUESTION)
    expect(page.get_by_text("The learner is away.")).to_be_visible()
    stage(learner.served, query)
    is_here(page)
    expect(page.get_by_text("Choose the first subgoal.")).to_be_visible()
    walk(page, "u")
    expect(page.get_by_text("Choose a subgoal first.")).to_be_visible()
    press(page, "s", "n")  # another choice before the first step
    walk(page, "uu")
    press(page, "w")
    expect(page.get_by_text("First press “Reached” for the last subgoal.")).to_be_visible()
    walk(page, "l")
    press(page, "Backspace")
    walk(page, "u")
    expect(page.get_by_text("this answer costs 5 units")).to_be_visible()  # 3 steps, a subgoal, a termination
    press(page, "Shift+Backspace")
    expect(page.get_by_text("No step is played yet.")).to_be_visible()
    press(page, "Backspace", "Enter")
    way(page, WAY[1:-1])
    assert learner.query(query)["state"] == "leased"
    press(page, WAY[-1][0])
    walk(page, WAY[-1][1])
    expect(page.get_by_text("this answer costs 42 units")).to_be_visible()
    send(page)
    assert learner.answer_of(query)["segments"] == SEGMENTS
    assert learner.query(query)["units"] == 28 + 2 * 7


def test_it_goes_on_after_a_reload_and_when_the_learner_was_gone(
    open_page: Open, learner: Learner, stage: Stage
) -> None:
    run = learner.create_run("reloaded")
    [query] = learner.ask(run, ask())
    withdraw = stage(learner.served, query)
    page = open_page(f"/work?run={run}")
    is_here(page)
    way(page, WAY[:2])
    press(page, WAY[2][0])
    walk(page, "ur")
    page.reload()
    is_here(page)
    expect(steps(page)).to_have_text("10")
    withdraw()
    expect(page.get_by_text("The learner is away.")).to_be_visible()
    walk(page, "r")
    expect(page.get_by_text("a step cannot be carried out now")).to_be_visible()
    expect(steps(page)).to_have_text("10")
    stage(learner.served, query)
    is_here(page)
    walk(page, "rrr")
    press(page, "Enter")
    way(page, WAY[3:-1])
    press(page, WAY[-1][0])
    walk(page, WAY[-1][1])
    send(page)
    assert learner.answer_of(query)["segments"] == SEGMENTS


def test_it_goes_on_when_the_server_was_started_again(
    built_page: Path, open_page: Open, stage: Stage, complaints: Complaints, tmp_path: Path
) -> None:
    complaints.expect("ERR_CONNECTION_REFUSED")
    complaints.expect("ERR_EMPTY_RESPONSE")
    settings = Settings(database=f"sqlite:///{tmp_path / 'waypost.db'}", page=built_page)
    with serving.background(settings) as served:
        learner = Learner(served)
        run = learner.create_run("restarted")
        [query] = learner.ask(run, ask())
        stage(served, query)
        page = open_page(f"/work?run={run}", at=served)
        is_here(page)
        way(page, WAY[:1])
        port = httpx2.URL(served.url).port
        learner.close()
    expect(page.get_by_text("The connection is lost.")).to_be_visible()
    assert port is not None
    with serving.background(settings, port=port) as served:
        is_here(page)
        expect(steps(page)).to_have_text("3")
        way(page, WAY[1:-1])
        press(page, WAY[-1][0])
        walk(page, WAY[-1][1])
        send(page)
        learner = Learner(served)
        assert learner.answer_of(query)["segments"] == SEGMENTS
        learner.close()
        page.close()


def test_a_laptop_that_slept_past_the_lease_finds_the_demonstration_as_it_was(
    open_page: Open, learner: Learner, stage: Stage, complaints: Complaints
) -> None:
    complaints.expect("409")
    run = learner.create_run("asleep")
    [query] = learner.ask(run, ask())
    stage(learner.served, query)
    page = open_page(f"/work?run={run}")
    is_here(page)
    way(page, WAY[:1])
    over = update(assignments).where(assignments.c.query_id == query).values(expires_at=assignments.c.leased_at)
    learner.served.db.write_now(lambda tx: tx.conn.execute(over))
    page.evaluate("document.dispatchEvent(new Event('visibilitychange'))")  # as on waking up
    expect(page.get_by_text("went back to the queue")).to_be_visible()
    is_here(page)
    expect(steps(page)).to_have_text("3")
    way(page, WAY[1:-1])
    press(page, WAY[-1][0])
    walk(page, WAY[-1][1])
    send(page)
    assert learner.answer_of(query)["segments"] == SEGMENTS


CLOSE_AND_ENTER = """async () => {
  document.activeElement.click();
  await null;
  document.activeElement.dispatchEvent(new KeyboardEvent('keydown', { key: 'Enter', bubbles: true, cancelable: true }));
}"""  # a key right after the dialog closed, before the browser says that it closed


def test_what_does_not_succeed_is_sent_only_after_a_question(open_page: Open, learner: Learner, stage: Stage) -> None:
    run = learner.create_run("burnt")
    [query] = learner.ask(run, ask())
    stage(learner.served, query)
    page = open_page(f"/work?run={run}")
    is_here(page)
    way(page, WAY[:4])
    press(page, "n")
    walk(page, "uuuuu")  # into the lava, and keys beyond it
    expect(page.get_by_text("The episode ended and the task is not accomplished.")).to_be_visible()
    press(page, "Enter")
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("button", name="Keep playing")).to_be_focused()
    press(page, "Enter")
    expect(dialog).to_be_hidden()
    assert learner.query(query)["state"] == "leased"
    press(page, "Enter")
    expect(dialog).to_be_visible()
    page.evaluate(CLOSE_AND_ENTER)
    expect(dialog).to_be_visible()
    press(page, "Tab", "Enter")
    assert learner.answer_of(query)["segments"] == [*SEGMENTS[:4], {"subgoal": "north", "actions": ["up"] * 3}]


def test_a_move_gets_a_key_of_its_own_but_none_that_is_in_use(open_page: Open, learner: Learner, stage: Stage) -> None:
    run = learner.create_run("own move keys")
    [query] = learner.ask(run, ask())
    stage(learner.served, query)
    page = open_page(f"/work?run={run}")
    is_here(page)
    press(page, "?")
    dialog = page.get_by_role("dialog", name="Keys")
    dialog.get_by_role("button", name="Change the key of up").click()
    for key, meaning in (("?", "Show every key"), ("Enter", "The subgoal is reached"), ("ArrowDown", "down")):
        press(page, key)
        expect(dialog.get_by_role("status")).to_contain_text(f"already means “{meaning}")
    press(page, "k")
    expect(dialog.get_by_role("status")).to_contain_text("“up” is K now")
    press(page, "Escape", "n", "k")
    expect(steps(page)).to_have_text("1")


def test_a_click_in_a_box_of_the_picture_chooses_the_next_subgoal(
    open_page: Open, learner: Learner, stage: Stage
) -> None:
    run = learner.create_run("boxes", vocabulary=vocabulary(CorridorDomain()).model_dump())
    demo = HierDemo(Simulator(CORRIDOR.domain).reset(CORRIDOR.instance), flat=False)
    [query] = learner.ask(run, CORRIDOR.ask(demo, 0, 0).model_dump())
    stage(learner.served, query, CORRIDOR)
    page = open_page(f"/work?run={run}", motion="reduce")
    page.locator("[data-stage=here]").wait_for()
    for subgoal, keys in (("east", ["ArrowRight", "Enter"]), ("target", ["ArrowRight", "ArrowRight"])):
        page.get_by_role("button", name=f"Choose the subgoal {subgoal}").click()
        press(page, *keys)
    send(page)
    segments = learner.answer_of(query)["segments"]
    assert [(one["subgoal"], one["actions"]) for one in segments] == [("east", ["east"]), ("target", ["east", "east"])]


@pytest.mark.parametrize("flat", [False, True])
def test_a_domain_without_a_renderer_is_played_with_keys(
    open_page: Open, learner: Learner, stage: Stage, flat: bool
) -> None:
    run = learner.create_run("corridor", vocabulary=vocabulary(CorridorDomain()).model_dump())
    demo = HierDemo(Simulator(CORRIDOR.domain).reset(CORRIDOR.instance), flat)
    [query] = learner.ask(run, CORRIDOR.ask(demo, 0, 0).model_dump())
    stage(learner.served, query, CORRIDOR)
    page = open_page(f"/work?run={run}")
    page.locator("[data-stage=here]").wait_for()
    expect(page.get_by_text("the end", exact=True)).to_have_count(0)
    # The subgoals west and east have letters, so the actions of these names have the arrows of their directions.
    left, right = "ArrowLeft", "ArrowRight"
    press(page, *([left, right, "2", "1"] if flat else ["2", right, "Enter", "t", right, right]))
    if flat:
        expect(steps(page)).to_have_text("4")
        press(page, "Backspace", "2", right)
    send(page)
    answer = learner.answer_of(query)
    actions = [segment["actions"] for segment in answer["segments"]]
    assert actions == ([["west", "east", "east", "east", "east"]] if flat else [["east"], ["east", "east"]])
    assert len(answer["replay"]["states"]) == len(answer["replay"]["frames"]) == sum(map(len, actions)) + 1
    page = open_page(f"/runs/{run}/queries/{query}", role="viewer")
    slider = page.get_by_role("slider")
    expect(slider).to_have_attribute("max", str(sum(map(len, actions))))
    for key in ("End", "Home", "ArrowRight"):
        page.keyboard.press(key)
        expect(page.get_by_role("img", name="The state, step")).to_be_visible()
