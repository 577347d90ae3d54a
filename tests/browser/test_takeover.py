"""Playing on in the page from where a learner failed: what it did is seen first, and one segment answers."""

from contextlib import closing
from typing import Any

from playwright.sync_api import Page, expect
from tests.browser.conftest import Open, Stage
from tests.browser.kit import Learner, maze, wait_for_heading
from tests.browser.test_play import press, walk

from waypost.client import Client
from waypost.trajectory import Segment, Trajectory
from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.maze import Maze
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_server.auth import tokens
from waypost_server.users import service as users

UP, LEFT = 0, 2
WEST, EAST = 0, 1


def walked(domain: Any, instance: Any, *legs: tuple[int, list[int]]) -> Trajectory:
    """What a learner did: subgoals, and the actions toward them."""
    simulator, sigma = Simulator(domain), list[Segment]()
    state = simulator.reset(instance)
    for subgoal, actions in legs:
        states = [state, *(simulator.step(action) for action in actions)]
        sigma.append(Segment(subgoal, tuple(states), tuple(actions), terminated=True))
        state = states[-1]
    return tuple(sigma)


def played_on(learner: Learner, domain: Any, instance: Any, sigma: Trajectory) -> tuple[str, int, Translator]:
    """Ask somebody to play on from the end of `sigma`: the run, the query and its translator."""
    run = learner.create_run("taken over", vocabulary=vocabulary(domain).model_dump())
    camera = Camera(domain, instance)
    translator = Translator(domain, instance, camera)
    ask = translator.ask(HierDemo(sigma[-1].states[-1], before=sigma, max_segments=1), 0, 0)
    user = learner.served.db.write_now(lambda tx: users.ensure_user(tx, "learner", "learner"))
    token = learner.served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "pictures")).token
    with closing(Client(learner.served.url, token)) as client:
        client.upload(camera.developed())
    [query] = learner.ask(run, ask.model_dump())
    return run, query, translator


def is_here(page: Page, failed: str) -> None:
    """Wait until the question and the learner's environment are there."""
    wait_for_heading(page, f"It failed at “{failed}”. Play on from here, until a subgoal is reached.")
    page.locator("[data-stage=here]").wait_for()


def failed_in_a_maze(learner: Learner) -> tuple[str, int, Translator]:
    instance = Maze.from_json(maze())
    sigma = walked(MazeDomain(), instance, (0, [UP, UP, UP]), (0, [UP, LEFT]))
    return played_on(learner, MazeDomain(), instance, sigma)


def test_in_a_maze_an_expert_sees_how_the_learner_failed_and_plays_on_from_there(
    open_page: Open, learner: Learner, stage: Stage
) -> None:
    run, query, translator = failed_in_a_maze(learner)
    stage(learner.served, query, translator)
    page = open_page(f"/work?run={run}", role="admin")
    is_here(page, "north")
    expect(page.locator(".failed").get_by_text("failed")).to_have_count(1)
    slider = page.get_by_role("slider", name="Step")
    expect(slider).to_have_value("5")  # after the first showing, in the failed state
    press(page, "[")
    expect(slider).to_have_value("3")
    expect(page.get_by_text("This is what the learner did.")).to_be_visible()
    press(page, "Home", "Backspace")
    expect(page.get_by_text("No step is played yet.").first).to_be_visible()
    press(page, "n")
    expect(slider).to_have_value("5")
    walk(page, "l")
    expect(slider).to_have_value("6")
    press(page, "Backspace", "Backspace", "Backspace")  # not beyond the failed state
    expect(slider).to_have_attribute("max", "5")
    press(page, "n")
    walk(page, "uuu")
    expect(page.get_by_text("this answer costs 5 units")).to_be_visible()  # 3 steps, a subgoal, a termination
    expect(slider).to_have_value("8")  # all three are carried out: before that, nothing is sent
    press(page, "Enter")
    expect(page.get_by_text("Send the demonstration, or undo a move.")).to_be_visible()
    press(page, "Enter")
    assert learner.answer_of(query)["segments"] == [{"subgoal": "north", "actions": ["up"] * 3}]
    assert learner.query(query)["units"] == 5

    page = open_page(f"/runs/{run}/queries/{query}", role="viewer")
    slider = page.get_by_role("slider", name="Step")
    expect(slider).to_have_attribute("max", "8")  # what the learner did, and what the expert showed
    expect(page.get_by_label("Answer").locator("abbr")).to_have_text("3N")


def test_pictures_show_what_the_learner_did_and_the_steps_that_are_played_on(
    open_page: Open, learner: Learner, stage: Stage
) -> None:
    domain, instance = CorridorDomain(), Corridor(2, 8)
    sigma = walked(domain, instance, (EAST, [1, 1]), (EAST, [1, 0, 1]))
    run, query, translator = played_on(learner, domain, instance, sigma)
    stage(learner.served, query, translator)
    page = open_page(f"/work?run={run}", motion="reduce")
    is_here(page, "east")
    strip = page.get_by_role("list", name="Steps").get_by_role("listitem")
    expect(strip.locator("abbr")).to_have_text(["1E", "2E"])
    expect(strip.get_by_text("✗")).to_have_count(1)
    strip.first.get_by_role("button").click()
    expect(page.get_by_text("This is what the learner did.")).to_be_visible()
    expect(page.get_by_role("img", name="The state, step 0 of 5")).to_be_visible()
    page.keyboard.press("End")
    page.get_by_role("button", name="Choose the subgoal east").click()
    press(page, *["ArrowRight"] * 3)
    expect(page.get_by_role("img", name="The state, step 8 of 8")).to_be_visible()
    press(page, "Enter", "Enter")
    answer = learner.answer_of(query)
    assert answer["segments"] == [{"subgoal": "east", "actions": ["east"] * 3}]
    assert answer["replay"]["states"] == [5, 6, 7, 8]
    assert len(answer["replay"]["frames"]) == 4

    page = open_page(f"/runs/{run}/queries/{query}", role="viewer")
    expect(page.get_by_role("slider", name="Step")).to_have_attribute("max", "8")
    for key, step in (("End", 8), ("Home", 5), ("[", 2)):
        page.keyboard.press(key)
        expect(page.get_by_role("img", name=f"The state, step {step} of 8")).to_be_visible()
