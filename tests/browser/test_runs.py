"""The list of runs and the page of a run, live."""

from playwright.sync_api import expect

from tests.browser.conftest import Open
from tests.browser.kit import Complaints, Learner, ask, wait_for_heading


def test_a_run_is_followed_live(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("live one", budget=100.0)
    page = open_page(f"/runs/{run}")
    expect(page.get_by_text("● live")).to_be_visible()
    expect(page.get_by_text("No episode has been reported yet.")).to_be_visible()
    expect(page.get_by_text("The learner has asked nothing yet.")).to_be_visible()
    learner.ask(run, ask("inspect_full"), ask("label_hi", ordinal=1))
    expect(page.get_by_text("6 units reserved")).to_be_visible()
    expect(page.get_by_role("row", name="Label_HI 0.1 open")).to_be_visible()
    learner.report(run, [False, True])
    expect(page.get_by_role("row", name="1 50%")).to_be_hidden()
    page.get_by_text("As a table").first.click()
    expect(page.get_by_role("row", name="1 50%")).to_be_visible()
    expect(page.locator("canvas").first).to_be_visible()

    worker = open_page(f"/work?run={run}")
    wait_for_heading(worker, ask("inspect_full")["question"])
    worker.keyboard.press("f")
    expect(page.get_by_role("row", name="Inspect_FULL 0.0 answered ✗ fail person-")).to_be_visible()
    expect(page.get_by_text("of 100 units")).to_be_visible()


def test_pause_and_resume(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("to pause")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/runs/{run}", role="admin")
    page.get_by_role("button", name="Pause").click()
    expect(page.get_by_role("button", name="Resume")).to_be_visible()
    assert learner.call("GET", f"/runs/{run}")["state"] == "paused"
    worker = open_page(f"/work?run={run}")
    wait_for_heading(worker, "Waiting for the learner")
    page.get_by_role("button", name="Resume").click()
    wait_for_heading(worker, ask("inspect_full")["question"])


def test_only_who_may_pauses(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("not mine")
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_role("heading", name="not mine")).to_be_visible()
    expect(page.get_by_text("person-")).to_be_visible()
    expect(page.get_by_role("button", name="Pause")).to_be_hidden()
    expect(page.get_by_role("link", name="Answer its queries")).to_be_hidden()


def test_the_list_leads_to_the_run_and_back(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("on the list", budget=50.0)
    learner.report(run, [True])
    page = open_page("/runs")
    row = page.get_by_role("row", name="on the list")
    expect(row).to_contain_text("1/500")
    expect(row).to_contain_text("0/50")
    row.get_by_role("link").click()
    expect(page).to_have_url(f"{page.url.split('/runs')[0]}/runs/{run}")
    expect(page.get_by_role("heading", name="on the list")).to_be_visible()
    page.go_back()
    expect(page.get_by_role("heading", name="Runs")).to_be_visible()


def test_names_are_text(open_page: Open, learner: Learner) -> None:
    name = "<img src=x onerror=alert(1)>"
    run = learner.create_run(name)
    learner.ask(run, ask("inspect_full", question=f"{name}?"))
    page = open_page(f"/runs/{run}")
    expect(page.get_by_role("heading", name=name)).to_be_visible()
    wait_for_heading(open_page(f"/work?run={run}"), f"{name}?")


def test_what_is_not_there(open_page: Open, complaints: Complaints) -> None:
    complaints.expect("404")
    page = open_page("/runs/none-such")
    expect(page.get_by_role("heading", name="There is no such run")).to_be_visible()
    page.goto("/what/is/this")
    expect(page.get_by_role("heading", name="There is nothing at this address")).to_be_visible()
