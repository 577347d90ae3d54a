"""Frames: pictures of states, kept by their hash, shown with the queries that name them."""

import pytest
from tests.server.kit import API, Json, Service, frame, in_process, png, query, segment

BLACK, WHITE = frame(png(0)), frame(png(255))


def seen(*frames: Json) -> Json:
    """A segment with a picture of each state."""
    return segment(len(frames) - 1) | {"frames": [one["hash"] for one in frames]}


def test_an_uploaded_frame_is_served_as_the_picture_it_is_and_for_good(service: Service) -> None:
    service.learner.call("PUT", "/frames", {"frames": [BLACK, WHITE]}, 204)
    reply = service.client.get(f"{API}/frames/{WHITE['hash']}", headers=service.viewer.headers)
    assert reply.content == png(255)
    assert reply.headers["content-type"] == "image/png"
    assert reply.headers["cache-control"] == "private, max-age=31536000, immutable"
    assert reply.headers["x-content-type-options"] == "nosniff"
    assert reply.headers["content-security-policy"] == "default-src 'none'; sandbox"


def test_frames_are_uploaded_once_and_again_without_harm(service: Service) -> None:
    hashes = [one["hash"] for one in (WHITE, BLACK, WHITE)]
    assert service.learner.post("/frames/missing", {"hashes": hashes})["hashes"] == hashes[:2]
    service.learner.call("PUT", "/frames", {"frames": [BLACK, BLACK]}, 204)
    assert service.learner.post("/frames/missing", {"hashes": hashes})["hashes"] == [WHITE["hash"]]
    service.learner.call("PUT", "/frames", {"frames": [BLACK, WHITE]}, 204)
    assert service.learner.post("/frames/missing", {"hashes": hashes})["hashes"] == []


@pytest.mark.parametrize(
    ("wrong", "field"),
    [
        (WHITE | {"hash": BLACK["hash"]}, "hash"),
        (frame(b"<svg onload=alert(1)>"), "png"),
        (frame(png()[:-1]), "png"),
        (frame(png(0, 5_000, 1)), "png"),
        (WHITE | {"png": "AAAAA"}, "png"),
    ],
)
def test_what_is_not_the_picture_it_says_is_refused_and_nothing_kept(lite: Service, wrong: Json, field: str) -> None:
    problem = lite.learner.call("PUT", "/frames", {"frames": [BLACK, wrong]}, 422)
    assert problem["errors"][0]["loc"] == ["body", "frames", 1, field]
    lite.viewer.get(f"/frames/{BLACK['hash']}", 404)


def test_a_frame_has_a_largest_size(sqlite_url: str) -> None:
    with in_process(sqlite_url, max_frame_bytes=len(png()) - 1) as service:
        problem = service.learner.call("PUT", "/frames", {"frames": [BLACK]}, 422)
        assert "a frame may have" in problem["detail"]


def test_a_query_shows_a_frame_of_each_state(lite: Service) -> None:
    lite.learner.call("PUT", "/frames", {"frames": [BLACK, WHITE]}, 204)
    run = lite.learner.create_run()
    shown = seen(BLACK, WHITE, BLACK)
    lite.learner.ask(run, query("inspect_lo", segments=[shown], context=[seen(WHITE, WHITE)]))
    held = lite.annotator.lease()
    assert held["query"]["ask"]["segments"][0]["frames"] == shown["frames"]
    problem = lite.learner.ask(run, query(ordinal=1, segments=[shown | {"actions": [], "states": [1]}]), expect=422)
    assert problem["errors"][0]["loc"] == ["body", "queries", 0, "segments", 0, "frames"]


def test_a_query_cannot_show_a_frame_that_was_not_uploaded(lite: Service) -> None:
    run = lite.learner.create_run()
    lite.learner.call("PUT", "/frames", {"frames": [BLACK]}, 204)
    problem = lite.learner.ask(run, query(segments=[seen(BLACK, WHITE)]), expect=422)
    assert WHITE["hash"] in problem["detail"]
    assert lite.learner.get(f"/runs/{run}")["open_queries"] == 0


def test_asking_again_with_other_pictures_changes_nothing(lite: Service) -> None:
    lite.learner.call("PUT", "/frames", {"frames": [BLACK, WHITE]}, 204)
    run = lite.learner.create_run()
    (first,) = lite.learner.ask(run, query(segments=[seen(BLACK, BLACK)]))
    assert lite.learner.ask(run, query(segments=[seen(WHITE, BLACK)])) == [first]
    boxes = {"north": {"left": 0, "top": 0, "right": 0.5, "bottom": 0.5}}
    assert lite.learner.ask(run, query(segments=[seen(BLACK, BLACK) | {"landmarks": [boxes]}])) == [first]
    boxes = {"up": {"left": 0, "top": 0, "right": 0.5, "bottom": 0.5}}
    assert lite.learner.ask(run, query(segments=[seen(BLACK, BLACK) | {"action_landmarks": [boxes]}])) == [first]
    other = seen(BLACK, BLACK) | {"actions": ["down"]}
    assert lite.learner.ask(run, query(segments=[other]), expect=409)["type"] == "/problems/different-content"
