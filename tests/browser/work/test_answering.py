"""Every kind of query, answered with the keyboard alone; what is stored is exactly what was meant."""

import re
import time
from statistics import median

import pytest
from playwright.sync_api import Page, expect
from tests.browser.conftest import Open
from tests.browser.kit import ROLLOUT, Json, Learner, ask, wait_for_heading

SUBGOALS = [one["subgoal"] for one in ROLLOUT]


def press(page: Page, *keys: str) -> None:
    """Press keys one after the other."""
    for key in keys:
        page.keyboard.press(key)


@pytest.mark.parametrize(
    ("kind", "keys", "answer"),
    [
        ("inspect_full", ["p"], {"verdict": "pass"}),
        ("inspect_full", ["Home", "]", "ArrowRight", "Shift+ArrowLeft", " ", " ", "f"], {"verdict": "fail"}),
        ("inspect_lo", ["f"], {"verdict": "fail"}),
        ("inspect_lo", ["p"], {"verdict": "pass"}),
        ("label_hi", ["Shift+Enter"], {"subgoals": SUBGOALS}),
        ("label_hi", ["Enter"] * 6, {"subgoals": SUBGOALS}),
        (
            "label_hi",
            ["Enter", "w", "3", "ArrowDown", "t", "ArrowUp", "s", "Enter"],
            {"subgoals": ["north", "west", "west", "south", "go_to_target"]},
        ),
        ("label_hi", ["5", "Backspace", "n", "Shift+Enter"], {"subgoals": SUBGOALS}),
        (
            "label_lo",
            ["Enter"] * 8,
            {"actions": ["up", "up", "right", "right", "right", "right"], "terminations": [False] * 6 + [True]},
        ),
        (
            "label_lo",
            ["Shift+Enter"],
            {"actions": ["up", "up", "right", "right", "right", "right"], "terminations": [False] * 6 + [True]},
        ),
        (
            "label_lo",
            ["ArrowUp", "Enter", "ArrowDown", "4", "d", "Enter"],
            {"actions": ["up", "up", "down", "right", None, None], "terminations": [False] * 4 + [True] + [False] * 2},
        ),
        (
            "label_lo",
            [".", ".", ".", "x", "ArrowLeft", "Enter", "Enter", "n", "Enter"],
            {"actions": ["up", "up", "right", "left", "right", "right"], "terminations": [False] * 7},
        ),
        (
            "label_full",
            ["Enter", "ArrowDown", "]", "x", "ArrowLeft", "Shift+Enter"],
            {
                "actions": [
                    "up",
                    "down",
                    "up",
                    "left",
                    "left",
                    "up",
                    "up",
                    "up",
                    "up",
                    "right",
                    "right",
                    "right",
                    "right",
                ]
            },
        ),
    ],
)
def test_the_keyboard_alone_answers(
    open_page: Open, learner: Learner, kind: str, keys: list[str], answer: Json
) -> None:
    run = learner.create_run(kind)
    [query] = learner.ask(run, ask(kind))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask(kind)["question"])
    press(page, *keys)
    assert learner.answer_of(query) == {"kind": kind} | answer


def test_a_run_of_all_kinds_is_answered_without_a_pause(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("all kinds")
    kinds = ["inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full"]
    queries = learner.ask(run, *[ask(kind, ordinal=ordinal) for ordinal, kind in enumerate(kinds)])
    page = open_page(f"/work?run={run}")
    for kind in kinds:
        wait_for_heading(page, ask(kind)["question"])
        press(page, "f" if "inspect" in kind else "Shift+Enter")
    wait_for_heading(page, "No question right now")
    assert [learner.answer_of(query)["kind"] for query in queries] == kinds
    expect(page.get_by_text("5 answers")).to_be_visible()


def test_the_next_query_is_there_at_once_and_has_the_focus(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("latency")
    learner.ask(run, *[ask("inspect_full", episode, question=f"Question {episode}") for episode in range(26)])
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, "Question 0")
    page.evaluate(
        """() => {
            window.latencies = [];
            let pressed = 0;
            window.addEventListener('keydown', () => { pressed = performance.now(); }, true);
            let last = document.querySelector('#question').textContent;
            const seen = () => {
                const now = document.querySelector('#question')?.textContent;
                if (now?.startsWith('Question') && now !== last) {
                    last = now;
                    window.latencies.push(performance.now() - pressed);
                }
                requestAnimationFrame(seen);
            };
            seen();
        }"""
    )
    heading, shown = page.locator("#question"), ["Question 0"]
    for _ in range(25):
        press(page, "p")
        expect(heading).not_to_have_text(shown[-1])
        expect(heading).to_have_text(re.compile("Question"))
        expect(heading).to_be_focused()
        shown.append(heading.text_content() or "")
    assert sorted(shown) == sorted(f"Question {number}" for number in range(26))
    latencies = sorted(page.evaluate("new Promise(done => requestAnimationFrame(() => done(window.latencies)))"))
    print(f"\nkey press to next query on screen: p50 {median(latencies):.0f} ms, p95 {latencies[-2]:.0f} ms")


def test_without_a_renderer_the_states_are_shown_as_text(open_page: Open, learner: Learner) -> None:
    vocabulary = {"domain": "doors", "subgoals": ["open"], "actions": ["push", "pull"], "renderer": "unheard-of"}
    run = learner.create_run("plain", vocabulary=vocabulary)
    segment = {"subgoal": "open", "states": [{"door": "shut"}, {"door": "ajar"}], "actions": ["push"]}
    asked = ask("label_lo", segments=[segment], context=[], suggestion=None, question="What opens the door?")
    [query] = learner.ask(run, asked)
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, "What opens the door?")
    expect(page.get_by_text('"door": "shut"')).to_be_visible()
    press(page, "2")
    expect(page.get_by_text('"door": "ajar"')).to_be_visible()
    press(page, "d", "Enter")
    assert learner.answer_of(query) == {"kind": "label_lo", "actions": ["pull"], "terminations": [False, True]}


def test_the_mouse_does_what_the_keys_do(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("mouse")
    [query] = learner.ask(run, ask("label_lo"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("label_lo")["question"])
    page.get_by_role("button", name="State 4: ").click()  # the first wrong step
    page.get_by_role("button", name="left").click()
    page.get_by_role("button", name="Done here").click()
    page.get_by_role("button", name="Send answer").click()
    assert learner.answer_of(query) == {
        "kind": "label_lo",
        "actions": ["up", "up", "right", "left", None, None],
        "terminations": [False, False, False, False, True, False, False],
    }


def test_a_held_key_submits_once(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("held")
    first, second = learner.ask(run, ask("inspect_full", 0), ask("inspect_full", 1, question="And this one?"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("inspect_full")["question"])
    page.keyboard.down("p")
    for _ in range(5):
        page.keyboard.down("p")  # repeats
        time.sleep(0.02)
    page.keyboard.up("p")
    learner.answer_of(first)
    wait_for_heading(page, "And this one?")
    assert learner.query(second)["answer"] is None


def test_labels_wait_while_a_field_is_typed_in(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("skip")
    learner.ask(run, ask("inspect_full", 0), ask("inspect_full", 1, question="The next one"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("inspect_full")["question"])
    press(page, "s")
    field = page.get_by_label("or in your own words")
    field.fill("")
    field.press_sequentially("puzzling pf")
    press(page, "Enter")
    wait_for_heading(page, "The next one")
    expect(page.get_by_text("Skipped.")).to_be_visible()


def test_reduced_motion_shows_the_end_and_plays_nothing(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("still")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", motion="reduce")
    scrubber = page.get_by_role("slider", name="Step")
    expect(scrubber).to_have_attribute("aria-valuetext", "step 21 of 21, subgoal east")
    press(page, "Home")
    expect(scrubber).to_have_attribute("aria-valuetext", "step 0 of 21, action up, subgoal north")


def test_a_key_can_be_changed_and_is_remembered(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("own keys")
    first, second = learner.ask(run, ask("inspect_full", 0), ask("inspect_full", 1, question="The next one"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("inspect_full")["question"])
    press(page, "?")
    dialog = page.get_by_role("dialog", name="Keys")
    dialog.get_by_role("button", name="Change the key of Yes, it worked").click()
    press(page, "f")
    expect(dialog.get_by_role("status")).to_contain_text("F already means “No, it failed”")
    press(page, "Escape")
    expect(dialog.get_by_role("status")).to_contain_text("Nothing was changed")
    dialog.get_by_role("button", name="Change the key of Yes, it worked").click()
    press(page, "j")
    expect(dialog.get_by_role("status")).to_contain_text("is J now")
    press(page, "Escape")
    expect(dialog).to_be_hidden()
    expect(page.get_by_role("button", name="Yes, it worked")).to_contain_text("J")
    press(page, "p")
    press(page, "j")
    assert learner.answer_of(first)["verdict"] == "pass"
    wait_for_heading(page, "The next one")
    page.reload()
    wait_for_heading(page, "The next one")
    press(page, "?")
    dialog.get_by_role("button", name="Reset all keys").click()
    press(page, "Escape")
    press(page, "j")
    press(page, "p")
    assert learner.answer_of(second)["verdict"] == "pass"


def test_every_key_of_a_mode_is_in_the_help(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("help")
    learner.ask(run, ask("label_hi"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("label_hi")["question"])
    press(page, "?")
    dialog = page.get_by_role("dialog", name="Keys")
    for words in ("go to target", "Play or pause", "Take back my last answer", "Skip, with a reason"):
        expect(dialog.get_by_text(words)).to_be_visible()
    press(page, "n", "Escape")  # the keys rest while the dialog is open
    expect(dialog).to_be_hidden()
    expect(page.get_by_text("0 of 5")).to_be_visible()
