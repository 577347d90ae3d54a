"""Reviewers see where the learner's policy, as it is now, would answer otherwise than the annotator did."""

from playwright.sync_api import expect
from tests.browser.access.axe import violations
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, wait_for_heading


def test_an_answer_is_found_that_the_policy_contradicts_after_it_has_learned(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("contradicted")
    hi = ask("label_hi")
    queries = learner.ask(run, hi, hi | {"ordinal": 1})
    worker = open_page(f"/work?run={run}")
    for query in queries:
        expect(worker.locator(f"h1[data-query='{query}']")).to_be_focused()
        worker.keyboard.press("s")  # south: the learner chose north
        worker.keyboard.press("Shift+Enter")
    wait_for_heading(worker, "No question right now")
    given = learner.answer_of(queries[0])
    others = given | {"subgoals": ["west" for _ in given["subgoals"]]}
    for query in queries:
        learner.use(query)
    predictions = [{"query": one, "answer": answer} for one, answer in zip(queries, (others, given), strict=True)]
    learner.call("PUT", f"/runs/{run}/predictions", {"episode": 1_024, "predictions": predictions})

    page = open_page(f"/runs/{run}/review", role="admin")
    shown, now = page.locator("h2[data-query]"), page.get_by_role("heading", name="policy after episode")
    expect(shown).to_have_attribute("data-query", str(queries[1]))
    expect(now).to_have_count(0)
    page.get_by_label("Differs from").select_option("the learner's policy now")
    expect(page.get_by_text("1 answer to review")).to_be_visible()
    expect(shown).to_have_attribute("data-query", str(queries[0]))
    expect(page.get_by_text("≠ the learner's policy now")).to_be_visible()
    expect(now).to_have_text("The learner's policy after episode 1,024")
    expect(now.locator("+ ul").get_by_role("listitem").first).to_have_text("1 west instead of south")
    assert violations(page) == []
