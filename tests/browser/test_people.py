"""People in the page: let in, sent away, their tokens and numbers; practice; gold queries nobody can tell apart."""

import json
from contextlib import closing
from pathlib import Path

import httpx2
from playwright.sync_api import Page, expect
from tests.browser.access.axe import violations
from tests.browser.conftest import Open
from tests.browser.kit import VOCABULARY, Complaints, Learner, ask, login_link, wait_for_heading

from waypost_server import serving
from waypost_server.gold.practice import SHIPPED
from waypost_server.serving import Served
from waypost_server.settings import Settings

QUESTION = ask("inspect_full")["question"]


def shown_once(page: Page, name: str) -> str:
    """Read what a dialog shows this once, have it copied, and close it."""
    field = page.get_by_role("textbox", name=name)
    expect(field).to_be_focused()
    secret = field.input_value()
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog").get_by_role("status")).to_contain_text("opied")
    page.keyboard.press("Escape")
    expect(field).to_be_hidden()
    return secret


def test_an_administrator_lets_somebody_in_and_sends_them_away(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    learner.finish_all()
    complaints.expect("401")
    complaints.expect("403")
    admin = open_page("/people", role="admin")
    admin.get_by_label("Name").fill("zoe of the lab")
    admin.keyboard.press("Enter")
    link = shown_once(admin, "Login link for zoe of the lab")
    zoe = open_page(link, role=None)
    zoe.get_by_text("Worked example").wait_for()  # somebody new practices first
    zoe.keyboard.press("Enter")
    wait_for_heading(zoe, "Did it do the whole task?")
    zoe.keyboard.press("y")
    wait_for_heading(zoe, "Right")
    zoe.keyboard.press("Escape")
    wait_for_heading(zoe, "No question right now")
    zoe.goto(login_link(learner.served, "zoe of the lab", "annotator"))
    wait_for_heading(zoe, "No question right now")  # the first practice comes once
    admin.get_by_role("link", name="zoe of the lab").click()
    admin.get_by_role("combobox", name="Role").select_option("viewer")
    expect(admin.get_by_text("Sees everything except people, and changes nothing.")).to_be_visible()
    expect(zoe.get_by_role("heading", name="This account cannot answer questions")).to_be_visible()
    assert link.partition("#")[2] not in admin.content()
    admin.get_by_role("button", name="Deactivate").click()
    admin.get_by_role("dialog").get_by_role("button", name="Deactivate").press("Enter")
    expect(admin.get_by_text("Deactivated just now")).to_be_visible()
    admin.get_by_role("link", name="People").first.click()
    admin.get_by_role("link", name="Audit log").press("Enter")
    log = admin.get_by_role("region", name="Audit log")
    expect(log.get_by_role("row", name="deactivated a user").first).to_contain_text("zoe of the lab")
    admin.get_by_role("combobox", name="Action").select_option("user.role_changed")
    expect(log.get_by_text("deactivated a user")).to_have_count(0)
    expect(log.get_by_role("row").nth(1)).to_contain_text("from: annotator, name: zoe of the lab, to: viewer")
    admin.get_by_role("textbox", name="Who").fill("nobody")
    admin.keyboard.press("Tab")
    expect(admin.get_by_text("No rows match.")).to_be_visible()
    admin.get_by_role("link", name="Clear").press("Enter")
    with admin.expect_download() as download:
        admin.get_by_role("link", name="JSON Lines").press("Enter")
    assert link.partition("#")[2] not in download.value.path().read_text()
    zoe.goto("/me")
    expect(zoe.get_by_role("heading", name="You are not signed in")).to_be_visible()
    zoe.goto(link)
    zoe.reload()
    expect(zoe.get_by_role("heading", name="Sign in with a link")).to_be_visible()


def test_everybody_has_a_page_of_their_own(open_page: Open, complaints: Complaints) -> None:
    complaints.expect("401")
    complaints.expect("403")
    page = open_page("/people", role="annotator")
    expect(page.get_by_role("heading", name="Your account may not see this")).to_be_visible()
    expect(page.get_by_text("This needs the role admin.")).to_be_visible()
    page.get_by_role("link", name="your own account").click()
    page.get_by_label("What it is for").fill("my laptop")
    page.get_by_role("combobox", name="Valid for").select_option("30 days")
    page.get_by_role("checkbox", name="see what the account sees").press("Space")
    page.get_by_role("button", name="Create a token").press("Enter")
    token = {"Authorization": f"Bearer {(secret := shown_once(page, 'New API token'))}"}
    with closing(httpx2.Client(base_url=page.url.removesuffix("/me"), headers=token)) as program:
        assert program.get("/api/v1/me").is_success
        [made] = program.get("/api/v1/me/tokens").json()["tokens"]
        assert 29 <= (made["expires_at"] - made["created_at"]) / 86_400 <= 31
        refused = program.post("/api/v1/assignments", json={"wait": 0})
        assert (refused.status_code, refused.json()["type"].rpartition("/")[2]) == (403, "out-of-scope")
    expect(page.get_by_role("row", name="my laptop")).to_contain_text("see what the account sees")
    expect(page.get_by_role("row", name="my laptop")).to_be_visible()
    assert secret not in page.content()
    page.get_by_role("button", name="Revoke my laptop").click()
    page.get_by_role("button", name="Revoke it").press("Enter")
    expect(page.get_by_role("row", name="my laptop")).to_be_hidden()
    expect(page.get_by_role("heading", name="API tokens")).to_be_focused()
    page.get_by_role("button", name="Log out everywhere").click()
    expect(page.get_by_role("heading", name="Sign in with a link")).to_be_visible()
    page.goto("/me")
    expect(page.get_by_role("heading", name="You are not signed in")).to_be_visible()


def test_somebody_new_practices_by_keyboard(open_page: Open, served: Served, learner: Learner) -> None:
    learner.finish_all()
    run = learner.create_run("not touched")
    page = open_page("/practice")
    page.get_by_role("heading", name="Practice").wait_for()
    page.keyboard.press("Enter")
    wait_for_heading(page, "Did it do the whole task?")
    page.keyboard.press("f")
    wait_for_heading(page, "Not right")
    expect(page.get_by_text("The task is accomplished in the last state.")).to_be_visible()
    page.keyboard.press("u")
    wait_for_heading(page, "Did it do the whole task?")
    page.keyboard.press("p")
    wait_for_heading(page, "Right")
    for verdict in ("f", "p", "f"):
        page.keyboard.press("Enter")
        page.locator("#question[data-query]").wait_for()
        page.keyboard.press(verdict)
        wait_for_heading(page, "Right")
    for _ in range(6):  # the learner errs in each of these
        page.keyboard.press("Enter")
        page.locator("#question[data-query]").wait_for()
        page.keyboard.press("Shift+Enter")
        page.get_by_role("heading", name="right").wait_for()
        wrong = page.locator("[aria-current=step]")
        expect(wrong).to_contain_text("is not right")
        page.keyboard.press("ArrowUp")
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="4 of 10 right")).to_be_visible()
    page.get_by_role("button", name="Again").click()
    wait_for_heading(page, "Did it do the whole task?")
    assert learner.call("GET", f"/runs/{run}/costs")["total"] == 0
    page.get_by_role("link", name="Go to work").click()
    wait_for_heading(page, "No question right now")
    expect(page.get_by_text("0 answers")).to_be_visible()


def test_people_practice_in_the_domains_of_learners_at_work(open_page: Open, built_page: Path, tmp_path: Path) -> None:
    own, file = json.loads(SHIPPED.read_text()), tmp_path / "taxi.json"
    own["vocabulary"]["domain"] = "taxi"
    file.write_text(json.dumps(own | {"exercises": own["exercises"][:4]}))
    database = f"sqlite:///{tmp_path / 'waypost.db'}"
    with (
        serving.background(Settings(database=database, page=built_page, practice=(SHIPPED, file))) as served,
        closing(Learner(served)) as learner,
    ):
        learner.create_run("of mazes")
        learner.create_run("of taxis", vocabulary=VOCABULARY | {"domain": "taxi"})
        page = open_page("/practice", at=served)
        expect(page.get_by_role("radio", name="taxi")).to_be_checked()
        expect(page.get_by_text("These are 4 questions about “taxi”")).to_be_visible()
        page.get_by_role("radio", name="taxi").press("ArrowLeft")
        expect(page.get_by_text("These are 10 questions")).to_be_visible()
        expect(page.get_by_role("radio", name="maze")).to_be_focused()
        assert violations(page) == []
        page.get_by_role("radio", name="maze").press("ArrowRight")
        expect(page.get_by_text("These are 4 questions about “taxi”")).to_be_visible()
        page.keyboard.press("Tab")
        page.keyboard.press("Enter")
        wait_for_heading(page, "Did it do the whole task?")
        page.keyboard.press("p")
        wait_for_heading(page, "Right")


def test_gold_queries_are_set_in_the_page_and_not_seen_by_annotators(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("403")
    run = learner.create_run("golden")
    learner.ask(run, *(ask("inspect_full", episode=episode) for episode in range(5)))
    author = open_page(f"/work?run={run}")
    for answered in (1, 2):  # one may be held ahead while the other's turn comes
        wait_for_heading(author, QUESTION)
        author.keyboard.press("f")
        expect(author.get_by_text(f"{answered} answer")).to_be_visible()
    admin = open_page(f"/runs/{run}/gold", role="admin")
    for marked in (1, 2):
        admin.get_by_role("button", name="Mark as gold").first.click()
        expect(admin.get_by_role("heading", name=f"{marked} gold")).to_be_focused()
    admin.get_by_label("Share of each annotator").fill("50")
    admin.keyboard.press("Enter")
    expect(admin.get_by_text("Saved: 50%")).to_be_visible()
    author.close()
    other = open_page(f"/work?run={run}")
    before = learner.call("GET", f"/runs/{run}/costs")["total"]
    for answered in range(1, 5):  # two of them gold
        wait_for_heading(other, QUESTION)
        other.keyboard.press("f")
        expect(other.get_by_text(f"{answered} answer")).to_be_visible()
        expect(other.get_by_text("unit")).to_have_count(0)
    other.goto("/me")
    own = other.get_by_role("row", name="Did the whole task work?")
    expect(own).to_contain_text("4")
    expect(other.get_by_text("unit")).to_have_count(0)
    expect(own).not_to_contain_text("%")  # annotators see their own results in steps of ten gold queries
    admin.goto("/people")
    expect(admin.get_by_text("100%").first).to_be_visible()
    assert learner.call("GET", f"/runs/{run}/costs")["total"] == before + 2
    other.goto(f"/runs/{run}/gold")
    expect(other.get_by_role("heading", name="Your account may not see this")).to_be_visible()
