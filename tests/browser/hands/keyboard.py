"""Answers in the page by keyboard, with the keys that the page shows. It works for every domain."""

from playwright.sync_api import Page

from waypost import wire

DEMO_MS = 120_000  # a demonstration may have hundreds of steps, which the learner carries out one by one
NAMED = {"←": "ArrowLeft", "→": "ArrowRight", "↑": "ArrowUp", "↓": "ArrowDown", "Space": "Space"}


def give(page: Page, answer: wire.Answer) -> None:
    """Give an answer with the keys that the page shows."""
    match answer:
        case wire.HierDemoAnswer():
            page.locator("[data-stage=here]").wait_for()
            for n, segment in enumerate(answer.segments):
                if n > 0:
                    page.keyboard.press("Enter")  # the last subgoal is reached
                press(page, "Subgoal", segment.subgoal)
                for action in segment.actions:
                    press(page, "Action", action)
            page.get_by_text("The task is accomplished. Send the demonstration.").wait_for(timeout=DEMO_MS)
        case wire.InspectAnswer():
            page.keyboard.press(answer.verdict[0])
            return
        case wire.LabelHiAnswer():
            for subgoal in answer.subgoals:
                press(page, "Subgoal", subgoal)
        case wire.LabelLoAnswer():
            for action in answer.actions:
                if action is not None:
                    press(page, "Action", action)
            page.keyboard.press("d" if True in answer.terminations else "n")  # done here, or not done
        case wire.LabelFullAnswer():
            for action in answer.actions:
                press(page, "Action", action)
    page.keyboard.press("Enter")


def press(page: Page, group: str, name: str | None) -> None:
    """Press the key that the page shows for a subgoal or an action."""
    button = page.locator(f"[role=group][aria-label^={group}] button[title='{str(name).replace('_', ' ')}']")
    printed = button.locator("kbd").inner_text()
    *shift, key = printed.split()
    page.keyboard.press("+".join([*("Shift" for _ in shift), NAMED.get(key, key.lower())]))
