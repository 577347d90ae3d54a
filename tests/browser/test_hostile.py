"""Whatever somebody has stored, nobody's browser runs it: with the content security policy, and by the page alone."""

from collections.abc import Iterator
from itertools import product

import pytest
from playwright.sync_api import Browser, Page
from tests.browser.kit import VOCABULARY, Learner, ask, login_link, wait_for_heading

from waypost_server.auth import tokens
from waypost_server.serving import Served
from waypost_server.users import service as users

# --- texts that would run as code if a page let them: each sets `window.ran` to its number when it does

NUMBER = 200

# What a page might put a text into: an element, an attribute in either quotes, a comment, a title, a style, a script.
_OUT_OF = ("", '">', "'>", "-->", "</title>", "</style>", "</script>", "</textarea>", "]]>", "{{1}}")

_RUNS = (
    "<script>{}</script>",
    "<img src=x onerror={}>",
    "<svg onload={}>",
    "<IMG SRC=x oNeRrOr={}>",
    "<svg/onload={}>",
    "<body onload={}>",
    "<input autofocus onfocus={}>",
    "<details open ontoggle={}>",
    "<video src=x onerror={}>",
    "<audio src=x onerror={}>",
    "<a href=javascript:{}>x</a>",
    "<iframe src=javascript:parent.{}>",
    '<iframe srcdoc="<script>parent.{}</script>">',
    "<math><mtext><img src=x onerror={}>",
    "<p onmouseover={}>x",
    "<style onload={}></style>",
    "<object data=javascript:{}>",
    "<svg><script>{}</script></svg>",
    '" onmouseover={} x="',
    "' autofocus onfocus={} x='",
    "javascript:{}",
    "${{{}}}",
)


def payloads() -> list[str]:
    """Return 200 different ones, none longer than a name may be."""
    texts = [out + runs.format(f"ran={number}") for number, (runs, out) in enumerate(product(_RUNS, _OUT_OF), start=1)]
    return [text for text in texts if len(text) <= 100][:NUMBER]


PAYLOADS = payloads()


@pytest.fixture(params=["with its policy", "without its policy"])
def page(request: pytest.FixtureRequest, browser: Browser, served: Served) -> Iterator[Page]:
    """An administrator's browser, which sees everything."""
    context = browser.new_context(
        base_url=served.url, viewport={"width": 1440, "height": 900}, bypass_csp=request.param.startswith("without")
    )
    page = context.new_page()
    page.add_init_script("Object.defineProperty(window, 'ran', { value: undefined, writable: true })")
    page.goto(login_link(served, f"guard-{request.param}", "admin"))
    page.wait_for_url("**/work")
    yield page
    context.close()


def nothing_ran(page: Page) -> None:
    """Point at everything there is, as a person would sooner or later, and see that nothing ran."""
    page.evaluate(
        "for (const one of document.querySelectorAll('*')) one.dispatchEvent(new Event('mouseover', { bubbles: true }))"
    )
    page.wait_for_timeout(200)
    assert page.evaluate("window.ran") is None
    assert page.evaluate("document.querySelectorAll('iframe, object, [onerror], [onload]').length") == 0


def look(page: Page, *addresses: str) -> None:
    """Look at views, each drawn to its end."""
    for address in addresses:
        page.goto(address)
        page.get_by_role("heading", level=1).first.wait_for()
        page.wait_for_timeout(300)
        nothing_ran(page)


def test_there_are_200_and_a_careless_page_would_run_them(browser: Browser) -> None:
    assert len(set(PAYLOADS)) == NUMBER
    careless = browser.new_page()
    for text in PAYLOADS[10:20]:
        careless.evaluate("text => { window.ran = undefined; document.body.innerHTML = text }", text)
        careless.wait_for_function("window.ran !== undefined")
    careless.close()


def test_names_and_questions_and_states_are_only_ever_text(page: Page, learner: Learner) -> None:
    hostile = {"domain": PAYLOADS[0], "subgoals": PAYLOADS, "actions": PAYLOADS, "renderer": PAYLOADS[1]}
    instance = {"rows": PAYLOADS, PAYLOADS[2]: PAYLOADS[3]}
    segments = [
        {"subgoal": text, "states": [PAYLOADS, {text: text}], "actions": [action]}
        for text, action in zip(PAYLOADS, reversed(PAYLOADS), strict=True)
    ]
    run = learner.create_run(PAYLOADS[4], algorithm=PAYLOADS[5], vocabulary=hostile, config={PAYLOADS[6]: PAYLOADS[7]})
    question = "".join(PAYLOADS)[:500]
    suggestion = {"kind": "label_hi", "subgoals": PAYLOADS}
    asked = {"question": question, "instance": instance, "segments": segments}
    page.goto(f"/work?run={run}")
    for one in (
        ask("label_hi", **asked, suggestion=suggestion),
        ask("label_full", 1, **asked),
        ask("inspect_lo", 2, **asked | {"context": segments, "segments": segments[:1]}),
    ):
        wait_for_heading(page, "No question right now")
        learner.ask(run, one)
        wait_for_heading(page, question)
        nothing_ran(page)
        page.keyboard.press("Shift+S")
        page.get_by_role("dialog").get_by_role("textbox").fill(question)
        page.keyboard.press("Enter")
    queries = [one["id"] for one in page.request.get(f"/api/v1/runs/{run}/query-rows").json()["rows"]]
    views = ["", "/queries", "/ledger", "/gold", *(f"/queries/{query}" for query in queries)]
    look(page, *(f"/runs/{run}{view}" for view in views), f"/runs/compare?run={run}")
    learner.call("PATCH", f"/runs/{run}", {"state": "finished"})  # nobody else is to get these


def test_names_of_runs_are_only_ever_text(page: Page, learner: Learner) -> None:
    runs = [learner.create_run(text) for text in PAYLOADS]
    look(page, "/runs", *(f"/runs?page={number}" for number in range(2, 6)))
    look(page, "/runs/compare?" + "&".join(f"run={run}" for run in runs[:24]))


def test_names_of_people_and_tokens_are_only_ever_text(page: Page, learner: Learner, served: Served) -> None:
    for text in PAYLOADS:
        served.db.write_now(lambda tx, name=text: users.ensure_user(tx, name, "annotator"))
    hostile = served.db.write_now(lambda tx: users.ensure_user(tx, PAYLOADS[20], "annotator"))
    for text in PAYLOADS[:20]:
        served.db.write_now(lambda tx, label=text: tokens.create_token(tx, hostile.id, label))
    look(page, "/people", f"/people/{hostile.id}")
    page.goto(login_link(served, PAYLOADS[20], "annotator"))
    page.wait_for_url(lambda url: "/login" not in url)
    look(page, "/me")
    run = learner.create_run("quiet", vocabulary=VOCABULARY)
    learner.ask(run, ask("inspect_full"))
    page.goto(f"/work?run={run}")
    wait_for_heading(page, ask("inspect_full")["question"])
    nothing_ran(page)
    page.keyboard.press("p")
    page.goto(f"/runs/{run}")
    page.get_by_text(PAYLOADS[20], exact=True).first.wait_for()
    nothing_ran(page)
    page.goto(login_link(served, "watcher", "admin"))
    page.wait_for_url("**/work")
    page.goto(f"/runs/{run}")
    page.get_by_text(PAYLOADS[20], exact=True).first.wait_for()
    nothing_ran(page)
    look(page, f"/runs/{run}/queries", f"/runs/{run}/ledger")
