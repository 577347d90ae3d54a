"""Practice: known answers, marked label by label, and nothing stored."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.server.kit import API, Json, Service, frame, in_process, png

from waypost_server.gold.practice import SHIPPED, BadPractice, PracticeSet, PracticeSets
from waypost_server.settings import Settings

OWN = json.loads(SHIPPED.read_text())
EXERCISES, DEMONSTRATIONS = OWN["exercises"], OWN["demonstrations"]


def best(exercise: Json, choice: int) -> Json:
    """A right answer to an exercise, of those with several the first or the last."""
    known, ask = exercise["known"], exercise["ask"]
    if "verdict" in known:
        return {"kind": known["kind"], "verdict": known["verdict"]}
    field = "subgoals" if "subgoals" in known else "actions"
    labels = [right[choice] for right in known[field]]
    if known["kind"] != "label_lo":
        return {"kind": known["kind"], field: labels}
    n_actions = len(ask["segments"][0]["actions"])
    terminations = [state == known["end"] for state in range(n_actions + 1)]
    return {"kind": "label_lo", "actions": labels + [None] * (n_actions - len(labels)), "terminations": terminations}


@pytest.mark.parametrize("number", range(len(EXERCISES)))
@pytest.mark.parametrize("choice", [0, -1])
def test_every_best_answer_is_right_and_every_label_has_its_reason(lite: Service, number: int, choice: int) -> None:
    answer = best(EXERCISES[number], choice)
    feedback = lite.annotator.post(f"/practice/{number}", {"answer": answer})
    assert feedback["is_right"]
    assert len(feedback["reasons"]) == len(feedback["marks"])
    assert all(mark["is_right"] and mark["given"] in mark["right"] for mark in feedback["marks"])


def test_all_kinds_but_demonstrations_are_practiced_and_only_examples_give_the_answer_away(lite: Service) -> None:
    found = lite.viewer.get("/practice")
    kinds = [one["ask"]["kind"] for one in found["queries"]]
    assert sorted(set(kinds)) == ["inspect_full", "inspect_lo", "label_full", "label_hi", "label_lo"]
    assert all(set(one) == {"id", "ask"} for one in found["queries"])
    examples = {found["queries"][one["query"]]["ask"]["kind"]: one for one in found["examples"]}
    assert sorted(examples) == sorted(set(kinds)), "a worked example of each kind"
    for kind, one in examples.items():
        assert one["query"] > kinds.index(kind), "another query of the kind is left to answer"
        marks = one["feedback"]["marks"]
        assert all(mark["is_right"] and mark["given"] in mark["right"] for mark in marks)
        assert len(marks) == len(one["feedback"]["reasons"])
    assert found["demonstrations"] == DEMONSTRATIONS, "they are looked at, because nobody can play one in practice"
    verdicts = [one["known"]["verdict"] for one in EXERCISES if "verdict" in one["known"]]
    assert sorted(verdicts) == ["fail", "fail", "pass", "pass"]


def test_what_was_wrong_is_said_where_it_was(lite: Service) -> None:
    number = next(n for n, one in enumerate(EXERCISES) if one["known"]["kind"] == "label_lo")
    answer = best(EXERCISES[number], 0)
    end = answer["terminations"].index(True)
    answer["terminations"] = [False] * len(answer["terminations"])
    answer["actions"] = [action or "up" for action in answer["actions"]]
    feedback = lite.annotator.post(f"/practice/{number}", {"answer": answer})
    wrong = [mark for mark in feedback["marks"] if not mark["is_right"]]
    assert [(mark["place"], mark["right"]) for mark in wrong] == [(end, ["(done)"])]
    assert not feedback["is_right"]
    assert lite.annotator.get("/me/numbers")["total"]["answers"] == 0


def test_answers_that_do_not_fit_are_refused(lite: Service) -> None:
    lite.annotator.post("/practice/0", {"answer": {"kind": "label_hi", "subgoals": []}}, 422)
    lite.annotator.post("/practice/999", {"answer": {"kind": "inspect_full", "verdict": "pass"}}, 404)


def test_a_server_can_have_practice_of_its_own(sqlite_url: str, tmp_path: Path) -> None:
    file = tmp_path / "practice.json"
    own = json.loads(SHIPPED.read_text())
    own["exercises"] = own["exercises"][:1]
    file.write_text(json.dumps(own))
    with in_process(sqlite_url, practice=(file,)) as service:
        assert len(service.annotator.get("/practice")["queries"]) == 1
    own["exercises"][0]["known"]["kind"] = "inspect_lo"
    file.write_text(json.dumps(own))
    for path in (file, tmp_path / "missing.json"):
        with pytest.raises(BadPractice, match="has no practice queries"):
            PracticeSet(path)


def test_each_domain_can_have_practice_of_its_own(sqlite_url: str, tmp_path: Path) -> None:
    own, file = json.loads(SHIPPED.read_text()), tmp_path / "taxi.json"
    own["vocabulary"]["domain"] = "taxi"
    file.write_text(json.dumps(own | {"exercises": own["exercises"][:3]}))
    with in_process(sqlite_url, practice=(SHIPPED, file)) as service:
        maze, taxi = (service.annotator.get(f"/practice{search}") for search in ("", "?domain=taxi"))
        assert [one["vocabulary"]["domain"] for one in (maze, taxi)] == ["maze", "taxi"]
        assert maze["domains"] == taxi["domains"] == ["maze", "taxi"]
        assert [one["id"] for one in maze["queries"] + taxi["queries"]] == list(range(len(EXERCISES) + 3))
        for query in taxi["queries"]:
            answer = best(EXERCISES[query["id"] - len(EXERCISES)], 0)
            assert service.annotator.post(f"/practice/{query['id']}", {"answer": answer})["is_right"]
        service.annotator.post(f"/practice/{len(EXERCISES) + 3}", {"answer": answer}, 404)
        refused = service.annotator.get("/practice?domain=none", 404)
        assert refused["detail"] == "There is no practice for 'none', only for: maze, taxi."
    with pytest.raises(BadPractice, match="a second file of practice queries about 'taxi'"):
        PracticeSets((file, file))


def test_a_demonstration_to_look_at_is_one_that_could_be_an_answer_with_all_its_states(tmp_path: Path) -> None:
    file = tmp_path / "practice.json"

    def refuses(change: Callable[[Json], None], why: str) -> None:
        own = json.loads(SHIPPED.read_text())
        change(own["demonstrations"][0])
        file.write_text(json.dumps(own))
        with pytest.raises(BadPractice, match=why):
            PracticeSet(file)

    refuses(lambda one: one["answer"].update(replay=None), "has no states, so there is nothing to show")
    refuses(lambda one: one["answer"]["replay"]["states"].pop(), "one per state")
    refuses(lambda one: one["answer"]["segments"][0].update(subgoal="up"), "'up' is not a subgoal")
    refuses(lambda one: one["answer"]["segments"][0]["actions"].append("jump"), "'jump' is not an action")


def test_several_files_are_named_in_one_setting(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("WAYPOST_PRACTICE", "maze.json, taxi.json")
    assert Settings().practice == (Path("maze.json"), Path("taxi.json"))


def test_the_pictures_of_practice_queries_are_served_like_those_of_a_run(sqlite_url: str, tmp_path: Path) -> None:
    own, picture = json.loads(SHIPPED.read_text()), frame(png(7))
    ask = own["exercises"][0]["ask"]
    for one in ask["segments"]:
        one["frames"] = [picture["hash"]] * len(one["states"])
    own |= {"frames": [picture], "exercises": own["exercises"][:1]}
    file = tmp_path / "practice.json"
    file.write_text(json.dumps(own))
    with in_process(sqlite_url, practice=(file,)) as service:
        (query,) = service.annotator.get("/practice")["queries"]
        assert query["ask"]["segments"] == ask["segments"]
        reply = service.client.get(f"{API}/frames/{picture['hash']}", headers=service.annotator.headers)
        assert reply.content == png(7)
    own["frames"][0] |= {"hash": "0" * 64}
    file.write_text(json.dumps(own))
    with pytest.raises(BadPractice, match="not the SHA-256"):
        PracticeSet(file)


def of_taxi(**more: Json) -> Json:
    """A run of a domain that the server has no file for."""
    return {"vocabulary": OWN["vocabulary"] | {"domain": "taxi", "renderer": "none"}, **more}


def sent(n: int = 3) -> Json:
    """What a learner sends."""
    return {"exercises": EXERCISES[:n], "demonstrations": DEMONSTRATIONS}


def test_a_learner_sends_the_practice_of_its_domain(service: Service) -> None:
    run = service.learner.create_run(**of_taxi())
    service.learner.call("PUT", f"/runs/{run}/practice", sent(), 204)
    found = service.annotator.get("/practice?domain=taxi")
    assert found["vocabulary"]["domain"] == "taxi"
    assert found["domains"] == ["maze", "taxi"]
    assert [one["ask"] for one in found["queries"]] == [one["ask"] for one in EXERCISES[:3]]
    assert found["demonstrations"] == DEMONSTRATIONS
    for one, exercise in zip(found["queries"], EXERCISES, strict=False):
        assert service.annotator.post(f"/practice/{one['id']}", {"answer": best(exercise, 0)})["is_right"]
    service.annotator.post(f"/practice/{found['queries'][-1]['id'] + 1}", {"answer": best(EXERCISES[0], 0)}, 404)
    assert service.annotator.get("/practice")["vocabulary"]["domain"] == "maze"


def test_the_newest_run_counts_and_a_deleted_one_takes_its_practice_with_it(service: Service) -> None:
    runs = [service.learner.create_run(**of_taxi()) for _ in range(2)]
    for n, run in enumerate(runs):
        service.learner.call("PUT", f"/runs/{run}/practice", sent(9), 204)
        service.learner.call("PUT", f"/runs/{run}/practice", sent(n + 1), 204)
    for n in (2, 1):
        assert len(service.annotator.get("/practice?domain=taxi")["queries"]) == n
        service.learner.patch(runs[n - 1], state="finished")
        service.learner.call("DELETE", f"/runs/{runs[n - 1]}")
    service.annotator.get("/practice?domain=taxi", 404)


def test_a_file_counts_more_than_what_a_learner_sends(lite: Service) -> None:
    run = lite.learner.create_run(vocabulary=OWN["vocabulary"])
    lite.learner.call("PUT", f"/runs/{run}/practice", sent(1), 204)
    found = lite.annotator.get("/practice")
    assert found["domains"] == ["maze"]
    assert len(found["queries"]) == len(EXERCISES)


def test_practice_that_does_not_fit_its_run_is_refused(lite: Service) -> None:
    run = lite.learner.create_run(**of_taxi())
    place = f"/runs/{run}/practice"
    other = json.loads(json.dumps(EXERCISES[0]))
    other["ask"]["segments"][0]["subgoal"] = "fly"
    lite.learner.call("PUT", place, {"exercises": [other], "demonstrations": []}, 422)
    picture = json.loads(json.dumps(EXERCISES[0]))
    for one in picture["ask"]["segments"]:
        one["frames"] = ["0" * 64] * len(one["states"])
    refused = lite.learner.call("PUT", place, {"exercises": [picture], "demonstrations": []}, 422)
    assert "is not stored; upload it before" in refused["detail"]
    lite.learner.call("PUT", place, {"exercises": [], "demonstrations": []}, 422)
    lite.annotator.get("/practice?domain=taxi", 404)
