"""The page of a run, live."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from playwright.sync_api import expect
from sqlalchemy import update
from tests.browser.access.axe import violations_in_every_look
from tests.browser.conftest import Open
from tests.browser.kit import Complaints, Learner, ask, log_in, wait_for_heading

from waypost import wire
from waypost_server.db.tables import queries
from waypost_server.serving import Served

WHY_BACK = "The second step east leads into the lava."


def test_a_run_is_followed_live(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("live one", budget=100.0)
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_text("● live")).to_be_visible()
    expect(page.get_by_text("No episode has been reported yet.")).to_be_visible()
    expect(page.get_by_text("The learner has asked nothing yet.")).to_be_visible()
    learner.ask(run, ask("inspect_full"), ask("label_hi", ordinal=1))
    expect(page.get_by_text("6 units reserved")).to_be_visible()
    asked = page.get_by_role("row", name="Label_HI 0, query 1")
    expect(asked).to_contain_text("open")
    learner.report(run, [False, True])
    expect(page.get_by_role("row", name="1 50%")).to_be_hidden()
    expect(page.locator("td").get_by_text("50%", exact=True)).to_have_count(1)  # a browser's search finds it
    page.get_by_text("As a table").first.click()
    expect(page.get_by_role("row", name="1 50%")).to_be_visible()
    chart = page.get_by_role("slider", name="Success on unseen instances")
    expect(chart.locator("svg")).to_be_visible()
    learner.report(run, [False, True, True])
    expect(chart).to_have_attribute("aria-valuetext", re.compile("^episode 2: Success 66.7%"))

    worker = open_page(f"/work?run={run}")
    wait_for_heading(worker, ask("inspect_full")["question"])
    worker.keyboard.press("f")
    answered = page.get_by_role("row", name="Inspect_FULL 0, query 0")
    expect(answered).to_contain_text("answered")
    expect(answered).to_contain_text("✗ fail")
    expect(answered).to_contain_text("person-")
    expect(page.get_by_text("of 100 units")).to_be_visible()


def test_the_page_of_a_run_with_very_many_episodes_draws_some_and_loads_each_thing_once(
    open_page: Open, learner: Learner
) -> None:
    run = learner.create_run("a long one")
    learner.report(run, [episode % 3 > 0 for episode in range(2_501)])
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_text("The charts show 834 of 2,501 episodes, evenly spaced.")).to_be_visible()
    requests = page.evaluate("performance.getEntriesByType('resource').map(({name, startTime}) => [name, startTime])")
    first = requests[0][1]  # a second later, all is read again
    begun = [name.partition("/api/v1/")[2].partition("?")[0] for name, at in requests if at < first + 900]
    ahead = ("me", f"runs/{run}", f"runs/{run}/costs", f"runs/{run}/curves")
    assert [begun.count(path) for path in ahead] == [1] * 4, "what the header Link names is what the scripts ask for"
    chart = page.get_by_role("slider", name="Success on unseen instances")
    expect(chart).to_have_attribute("aria-valuetext", re.compile("^episode 2,500: Success 67%"))
    learner.report(run, [episode % 3 > 0 for episode in range(2_501)] + [False])
    expect(chart).to_have_attribute("aria-valuetext", re.compile("^episode 2,501: Success 66%"))


def test_annotators_watch_a_run_but_not_its_single_queries(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("without queries", budget=100.0)
    learner.ask(run, ask("inspect_full"), ask("label_hi", ordinal=1))
    learner.report(run, [False, True])
    wait_for_heading(open_page(f"/work?run={run}"), ask("inspect_full")["question"])
    page = open_page(f"/runs/{run}")
    expect(page.get_by_role("slider", name="Success on unseen instances")).to_be_visible()
    expect(page.get_by_role("listitem").filter(has_text="Did the whole task work?, ep. 0")).to_be_visible()
    sections = page.get_by_role("navigation", name="This run").get_by_role("link")
    expect(sections).to_have_text(["Overview"])
    for words in ("reserved|units", "Cost so far", "Until success reaches"):  # they do not pay
        expect(page.get_by_text(re.compile(words))).to_have_count(0)
    expect(page.get_by_role("heading", name="Recent queries")).to_be_hidden()
    expect(page.get_by_role("link", name=re.compile("Inspect_FULL|CSV"))).to_have_count(0)
    page.goto(f"/runs/{run}/queries")
    expect(page.get_by_text("Annotators see no single queries")).to_be_visible()


def test_pause_and_resume(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("to pause")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/runs/{run}", role="admin")
    page.get_by_role("button", name="Pause").click()
    expect(page.get_by_role("button", name="Resume")).to_be_visible()
    assert learner.call("GET", f"/runs/{run}")["state"] == "paused"
    worker = open_page(f"/work?run={run}")
    wait_for_heading(worker, "No question right now")
    page.get_by_role("button", name="Resume").click()
    wait_for_heading(worker, ask("inspect_full")["question"])


def test_only_the_learner_of_a_run_may_pause_it(open_page: Open, learner: Learner, served: Served) -> None:
    run = learner.create_run("mine")
    page = open_page("/login", role=None)
    log_in(page.context, served, "learner", "learner")
    page.goto(f"/runs/{run}")
    page.get_by_role("button", name="Pause").click()
    expect(page.get_by_role("button", name="Resume")).to_be_visible()
    assert learner.call("GET", f"/runs/{run}")["state"] == "paused"


@pytest.mark.parametrize("role", ["viewer", "learner"])
def test_only_who_may_pauses(open_page: Open, learner: Learner, role: wire.Role) -> None:
    run = learner.create_run("not mine")
    page = open_page(f"/runs/{run}", role=role)
    expect(page.get_by_role("heading", name="not mine")).to_be_visible()
    expect(page.get_by_text("person-")).to_be_visible()
    expect(page.get_by_role("button", name="Pause")).to_be_hidden()
    expect(page.get_by_role("link", name="Answer its queries")).to_be_hidden()


def test_a_run_shows_what_each_kind_of_query_cost(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("kinds that cost")
    worker = open_page(f"/work?run={run}")
    learner.ask(run, ask("inspect_full"))
    wait_for_heading(worker, ask("inspect_full")["question"])
    page = open_page(f"/runs/{run}", role="viewer")
    table = page.get_by_role("region", name="What each kind of query cost")
    expect(table).to_have_count(0)  # nothing was paid for
    worker.keyboard.press("n")
    expect(table.get_by_role("row")).to_have_count(2)
    expect(table.get_by_role("row").last).to_contain_text("Inspect_FULL")
    expect(table.get_by_role("cell").nth(0)).to_have_text("1")
    expect(table.get_by_role("cell").nth(2)).to_have_text("100%")
    annotator = open_page(f"/runs/{run}")
    expect(annotator.get_by_role("heading", name="kinds that cost")).to_be_visible()
    expect(annotator.get_by_text("What each kind of query cost")).to_have_count(0)  # units are not theirs


def test_a_query_is_seen_with_its_trajectory_its_answer_and_its_price(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("watched query")
    learner.ask(run, ask("label_lo"), ask("inspect_full", ordinal=1))
    worker = open_page(f"/work?run={run}")
    wait_for_heading(worker, ask("label_lo")["question"])
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_role("listitem").filter(has_text="Label_LO, ep. 0")).to_contain_text("person-")
    page.get_by_role("link", name="Queries", exact=True).click()
    page.get_by_role("searchbox", name="Find a query").fill("WHOLE task")
    page.keyboard.press("Enter")
    expect(page.get_by_role("row")).to_have_count(2)
    expect(page.get_by_role("row").last).to_contain_text(ask("inspect_full")["question"])
    page.get_by_role("link", name="Clear").click()
    page.get_by_role("combobox", name="Kind").select_option("label_lo")
    expect(page.get_by_role("row").last).to_contain_text("Label_LO")
    expect(page.get_by_role("row")).to_have_count(2)
    page.get_by_role("link", name="Label_LO").click()
    expect(page.get_by_role("heading", name=ask("label_lo")["question"])).to_be_visible()
    expect(page.get_by_text("No answer yet.")).to_be_visible()
    worker.keyboard.press("x")
    worker.keyboard.press("Shift+Enter")
    expect(page.get_by_role("list", name="Label by state")).to_be_visible()
    expect(page.get_by_role("row", name="answered: ")).to_be_visible()
    expect(page.get_by_role("region", name="In the ledger")).to_contain_text("charge")
    slider = page.get_by_role("slider", name="Step")
    page.keyboard.press("Home")
    expect(slider).to_have_attribute("aria-valuetext", re.compile("subgoal east"))
    page.keyboard.press("ArrowLeft")
    expect(slider).to_have_attribute("aria-valuetext", re.compile("subgoal north"))
    page.get_by_role("link", name="Next →").click()
    expect(page.get_by_role("heading", name=ask("inspect_full")["question"])).to_be_visible()
    page.goto(f"/runs/{run}/ledger")
    expect(page.get_by_text("✓ balance verified")).to_be_visible()


@pytest.mark.parametrize(("last", "explained"), [("Enter", False), ("ArrowUp", True)])
def test_a_label_that_the_segment_should_not_have_ended_is_shown(
    open_page: Open, learner: Learner, last: str, explained: bool
) -> None:
    run = learner.create_run("without an end")
    asked = ask("label_lo")
    [query] = learner.ask(run, asked)
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, asked["question"])
    for key in (*["Enter"] * (len(asked["suggestion"]["actions"]) - 1), last, "n", "Enter"):
        page.keyboard.press(key)
    assert not any(learner.answer_of(query)["terminations"])
    page = open_page(f"/runs/{run}/queries/{query}", role="viewer")
    labels = page.get_by_role("list", name="Label by state").get_by_role("listitem")
    expect(labels.last).to_contain_text("not done")
    expect(page.get_by_text("Dashed: different")).to_have_count(int(explained))


def test_a_finished_run_waits_for_nobody(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("over")
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_text("What is asked waits for an annotator.")).to_be_visible()
    learner.call("PATCH", f"/runs/{run}", {"state": "finished"})
    expect(page.get_by_text("Nobody. The run is finished.")).to_be_visible()


def test_a_run_is_renamed_preferred_limited_and_finished(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("409")  # the refusal
    run = learner.create_run("to change")
    learner.ask(run, ask("label_hi"))
    page = open_page(f"/runs/{run}", role="admin")
    page.get_by_role("button", name="Change…").click()
    page.get_by_role("textbox", name="Name").fill("another name")
    page.get_by_role("spinbutton", name="Priority").fill("7")
    page.get_by_role("checkbox", name="The run may cost at most").check()
    page.get_by_role("spinbutton", name="Units").fill("4")
    page.get_by_role("button", name="Save").click()
    expect(page.get_by_role("alert")).to_contain_text("the budget must be at least 5")
    page.get_by_role("spinbutton", name="Units").fill("5.5")
    page.get_by_role("button", name="Save").click()
    expect(page.get_by_role("dialog")).to_be_hidden()
    expect(page.get_by_role("heading", name="another name")).to_be_visible()
    now = learner.call("GET", f"/runs/{run}")
    assert (now["name"], now["priority"], now["budget"]) == ("another name", 7, 5.5)
    page.get_by_role("button", name="Finish…").click()
    expect(page.get_by_role("dialog")).to_contain_text("1 open query will be cancelled")
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_be_hidden()
    assert learner.call("GET", f"/runs/{run}")["state"] == "running"
    page.get_by_role("button", name="Finish…").click()
    page.get_by_role("button", name="Finish it").click()
    expect(page.get_by_text("finished").first).to_be_visible()
    expect(page.get_by_role("button", name="Finish…")).to_be_hidden()
    assert learner.call("GET", f"/runs/{run}")["reserved"] == 0


def test_charts_and_tables_are_downloaded(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("<svg onload=alert(1)> & =1+1")
    learner.report(run, [False, True])
    page = open_page(f"/runs/{run}", role="viewer", scheme="dark")
    group = page.get_by_role("group", name="Download Success on unseen instances")

    def downloaded(name: str) -> bytes:
        with page.expect_download() as waiting:
            group.get_by_role("button", name=name).click()
        assert waiting.value.suggested_filename.endswith(f".{name.lower()}")
        return Path(waiting.value.path()).read_bytes()

    drawing = ElementTree.fromstring(downloaded("SVG"))
    texts = [element.text for element in drawing.iter("{http://www.w3.org/2000/svg}text")]
    assert "Success on unseen instances, last 100 episodes" in texts
    assert "<svg onload=alert(1)> & =1+1 · hg-dagger, maze, seed 0" in texts
    (line,) = (path for path in drawing.iter() if path.get("stroke-width") == "2px" and path.get("d"))
    assert line.get("stroke", "").startswith("rgb"), "its colors are its own"
    picture = downloaded("PNG")
    assert picture.startswith(b"\x89PNG")
    width = int.from_bytes(picture[16:20], "big")
    assert width == 2 * int(drawing.get("width", "0"))
    assert downloaded("CSV").decode().splitlines() == [
        "series,episode,value,low,high",
        "Success,0,0,,",
        "Success,1,0.5,,",
    ]
    with page.expect_download() as waiting:
        page.get_by_role("group", name="Download the curves").get_by_role("link", name="CSV").click()
    assert waiting.value.suggested_filename == f"{run}-curves.csv"


def test_reading_one_chart_as_a_table_leaves_its_neighbours_drawing_beside_its_own(
    open_page: Open, learner: Learner
) -> None:
    run = learner.create_run("two charts")
    learner.ask(run, ask("inspect_full"))
    worker = open_page(f"/work?run={run}")
    wait_for_heading(worker, ask("inspect_full")["question"])
    worker.keyboard.press("p")
    wait_for_heading(worker, "No question right now")
    learner.report(run, [False, True])
    page = open_page(f"/runs/{run}", role="viewer")

    def tops() -> list[float]:
        drawings = [page.get_by_role("slider", name=name) for name in ("Success on unseen", "Cost so far")]
        return [drawing.evaluate("one => one.getBoundingClientRect().top + scrollY") for drawing in drawings]

    expect(page.get_by_role("slider")).to_have_count(2)
    (top, beside) = tops()
    assert beside == top
    page.get_by_text("As a table").first.click()
    expect(page.get_by_role("row", name="1 50%")).to_be_visible()
    assert tops() == [top, top]


def test_names_are_text(open_page: Open, learner: Learner) -> None:
    name = "<img src=x onerror=alert(1)>"
    run = learner.create_run(name)
    learner.ask(run, ask("inspect_full", question=f"{name}?"))
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_role("heading", name=name)).to_be_visible()
    wait_for_heading(open_page(f"/work?run={run}"), f"{name}?")


def test_what_is_not_there(open_page: Open, complaints: Complaints) -> None:
    complaints.expect("404")
    page = open_page("/runs/none-such")
    expect(page.get_by_role("heading", name="There is no such run")).to_be_visible()
    page.goto("/what/is/this")
    expect(page.get_by_role("heading", name="There is nothing at this address")).to_be_visible()


def test_the_configuration_and_what_the_domain_lacks_are_shown(open_page: Open, learner: Learner) -> None:
    instead = {"views": "Policies see whole observations.", "places": "There is no repeat penalty."}
    config = {"preset": "lean", "values": "relabeling=false " * 12, "not_provided": instead}
    run = learner.create_run("lacking", config=config)
    page = open_page(f"/runs/{run}", role="viewer")
    shown = page.get_by_role("region", name="Configuration")
    expect(shown).to_contain_text("preset lean")
    expect(shown.get_by_role("heading", name="does not provide")).to_be_visible()
    for part, words in instead.items():
        expect(shown).to_contain_text(f"{part} {words}")
    plain = open_page(f"/runs/{learner.create_run('complete', config={'preset': 'lean'})}")
    expect(plain.get_by_role("region", name="Configuration")).to_contain_text("preset lean")
    expect(plain.get_by_role("heading", name="does not provide")).to_have_count(0)


def test_an_answer_is_found_sent_back_and_read_by_its_annotator(
    open_page: Open, learner: Learner, served: Served
) -> None:
    run = learner.create_run("to review")
    hi = ask("label_hi")
    first, second, third = learner.ask(run, hi, hi | {"ordinal": 1}, ask("inspect_full", ordinal=2))
    worker = open_page(f"/work?run={run}")
    for query in (first, second):
        heading = worker.locator(f"h1[data-query='{query}']")
        expect(heading).to_be_focused()
        worker.keyboard.press("s")  # south: the learner chose north
        worker.keyboard.press("Shift+Enter")
    expect(worker.locator(f"h1[data-query='{third}']")).to_be_focused()
    worker.keyboard.press("f")
    wait_for_heading(worker, "No question right now")
    learner.use(second)

    page = open_page("/login", role=None)
    log_in(page.context, served, "learner", "learner")
    page.goto(f"/runs/{run}")
    page.get_by_role("link", name="Review").click()
    shown = page.locator("h2[data-query]")
    expect(shown).to_have_attribute("data-query", str(third))
    expect(page.get_by_text("Demonstrations are not answered twice")).to_be_visible()
    page.get_by_label("Differs from").select_option("suggestion")
    expect(page.get_by_text("2 answers to review")).to_be_visible()
    expect(shown).to_have_attribute("data-query", str(second))
    expect(page.get_by_text("The learner has used this answer")).to_be_visible()
    expect(page.get_by_role("button", name="Send back")).to_be_disabled()
    page.get_by_label("Differs from").blur()
    page.keyboard.press("j")
    expect(shown).to_have_attribute("data-query", str(first))
    expect(shown).to_be_focused()
    expect(page).to_have_url(re.compile(rf"disagrees=suggestion&query={first}$"))
    page.keyboard.press("b")
    expect(page.get_by_text("Write what should be different")).to_be_visible()
    expect(page.get_by_role("textbox", name="Comment")).to_be_focused()
    page.keyboard.type(WHY_BACK)
    page.keyboard.press("Escape")
    page.keyboard.press("k")
    expect(shown).to_have_attribute("data-query", str(second))
    page.keyboard.press("j")
    expect(page.get_by_role("textbox", name="Comment")).to_have_value(WHY_BACK)
    page.keyboard.press("b")
    expect(page.get_by_text("Sent back. The query is open again.")).to_be_visible()
    expect(page.get_by_role("list", name="Comments")).to_contain_text(WHY_BACK)

    wait_for_heading(worker, hi["question"])
    expect(worker.get_by_role("note")).to_contain_text(WHY_BACK)
    worker.goto("/me")
    back = worker.get_by_role("region", name="Answers that came back")
    expect(back).to_contain_text(WHY_BACK)
    expect(back).to_contain_text("to review")


def test_what_is_stuck_is_listed_with_the_reason_and_a_link(open_page: Open, learner: Learner, served: Served) -> None:
    run = learner.create_run("stuck")
    [asked] = learner.ask(run, ask("inspect_full"))
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_role("heading", name="Recent queries")).to_be_visible()
    expect(page.get_by_role("heading", name="What is stuck")).to_have_count(0)
    earlier = update(queries).where(queries.c.id == asked).values(created_at=queries.c.created_at - 3_600)
    served.db.write_now(lambda tx: tx.conn.execute(earlier))
    page.reload()
    stuck = page.get_by_role("region", name="What is stuck: 1")
    expect(stuck.get_by_role("listitem")).to_contain_text("nobody has taken it for 1 h 0 min")
    assert violations_in_every_look(page) == []
    stuck.get_by_role("link").click()
    expect(page).to_have_url(re.compile(rf"/runs/{run}/queries/{asked}$"))
