"""Quotas: what is too much is refused and leaves no trace, and what was accepted stays."""

import pytest
from tests.server.db.test_checking import check
from tests.server.kit import Json, Service, frame, in_process, png, query, segment, together

SIZE = len(png(1))


def pictures(*shades: int) -> Json:
    return {"frames": [frame(png(shade)) for shade in shades]}


def used(service: Service, name: str) -> int:
    (user,) = [one for one in service.admin.get("/users")["users"] if one["name"] == name]
    return int(user["frame_bytes"])


def test_a_learner_uploads_pictures_up_to_a_size_and_is_told_what_to_do(database_url: str) -> None:
    with in_process(database_url, max_user_frame_bytes=2 * SIZE) as service:
        learner = service.learner
        learner.call("PUT", "/frames", pictures(1), 204)
        said = learner.call("PUT", "/frames", pictures(2, 3), 409)
        assert said["type"] == "/problems/too-many-pictures"
        assert said["detail"] == (
            f"Your pictures have {SIZE} bytes, and these have {2 * SIZE} more; they may have at most {2 * SIZE}. "
            "Delete finished runs that you no longer need, or ask the operator for more."
        )
        hashes = [one["hash"] for one in pictures(1, 2, 3)["frames"]]
        assert learner.post("/frames/missing", {"hashes": hashes})["hashes"] == hashes[1:]
        assert used(service, "lea") == SIZE
        learner.call("PUT", "/frames", pictures(1, 2, 2), 204)  # one of them is new
        assert used(service, "lea") == 2 * SIZE
        other = service.user("leo", "learner")
        other.call("PUT", "/frames", pictures(1, 2, 4), 204)  # only what nobody uploaded before counts
        assert (used(service, "leo"), used(service, "lea")) == (SIZE, 2 * SIZE)


def test_the_deletion_of_a_run_makes_room(database_url: str) -> None:
    with in_process(database_url, max_user_frame_bytes=2 * SIZE) as service:
        learner = service.learner
        learner.call("PUT", "/frames", pictures(1, 2), 204)
        shown = segment(1) | {"frames": [one["hash"] for one in pictures(1, 2)["frames"]]}
        run = learner.create_run()
        learner.ask(run, query("label_hi", segments=[shown]))
        learner.call("PUT", "/frames", pictures(3), 409)
        learner.patch(run, state="finished")
        assert learner.call("DELETE", f"/runs/{run}")["frame_bytes"] == 2 * SIZE
        assert used(service, "lea") == 0
        learner.call("PUT", "/frames", pictures(3), 204)
        assert all(one["n_faults"] == 0 for one in check(database_url))


def test_uploads_at_once_do_not_exceed_the_size(database_url: str) -> None:
    with in_process(database_url, max_user_frame_bytes=3 * SIZE) as service:

        def upload(number: int) -> int:
            headers = service.learner.headers
            body = pictures(number + 1, 100)  # all of them upload one of the pictures
            return service.client.request("PUT", "/api/v1/frames", json=body, headers=headers).status_code

        replies = together(upload, 8)
        assert sorted(set(replies)) == [204, 409]
        assert used(service, "lea") == SIZE * (replies.count(204) + 1) == 3 * SIZE
        assert all(one["n_faults"] == 0 for one in check(database_url))


def test_all_runs_of_a_learner_have_a_bounded_number_of_open_queries(database_url: str) -> None:
    with in_process(database_url, max_user_open_queries=3) as service:
        learner = service.learner
        first, second = learner.create_run(), learner.create_run()
        asked = learner.ask(first, query(), query(ordinal=1))
        learner.ask(second, query())
        said = learner.ask(second, query(), query(ordinal=1), expect=429)
        assert said["type"] == "/problems/too-many-queries"
        assert said["detail"] == (
            "The runs of this learner have 3 open queries and may have at most 3; wait for answers, or finish a run."
        )
        assert learner.ask(first, query(), query(ordinal=1)) == asked
        service.admin.ask(second, query(ordinal=1), expect=429)  # the run counts for its owner
        other = service.user("leo", "learner")
        other.ask(other.create_run(), query())
        service.annotator.answer(service.annotator.lease(run=first))
        learner.ask(second, query(ordinal=1))
        learner.patch(first, state="finished")
        learner.ask(second, query(ordinal=2))


@pytest.mark.parametrize("most", [1, 5])
def test_questions_at_once_in_many_runs_do_not_exceed_the_number(database_url: str, most: int) -> None:
    with in_process(database_url, max_user_open_queries=most) as service:
        runs = [service.learner.create_run() for _ in range(8)]

        def ask(number: int) -> int:
            body = {"queries": [query()]}
            path = f"/api/v1/runs/{runs[number]}/queries"
            return service.client.post(path, json=body, headers=service.learner.headers).status_code

        replies = together(ask, 8)
        assert replies.count(200) == most
        assert replies.count(429) == 8 - most
