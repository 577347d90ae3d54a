"""Deleting a run: its content goes for good, every sum stays, and nobody can read or change what is gone."""

import base64
import json
import sqlite3
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import create_engine, select, text, update
from sqlalchemy.exc import DBAPIError
from tests.server.auth.test_access import RESULT
from tests.server.db.test_checking import check, use
from tests.server.kit import (
    API,
    Json,
    Service,
    frame,
    in_process,
    make_older_store,
    png,
    query,
    right_answer,
    segment,
)
from typer.testing import CliRunner

from waypost_server.cli.main import app
from waypost_server.db import tables
from waypost_server.db.engine import migrate, parse
from waypost_server.db.tables import answers, frames, ledger, runs
from waypost_server.db.transaction import Tx
from waypost_server.queries import frame_uses
from waypost_server.runs import deletion
from waypost_server.runs import service as run_service

SECRET = "the-treasure-is-under-the-old-oak"
OWN, SHARED, PRACTICE = frame(png(1)), frame(png(2)), frame(png(3))


def sound(url: str) -> bool:
    return all(one["n_faults"] == 0 for one in check(url))


def command(url: str, *arguments: str, status: int = 0) -> str:
    done = CliRunner().invoke(app, [*arguments, "--database", url])
    assert done.exit_code == status, done.output
    return done.output.strip()


def seen(*pictures: Json) -> Json:
    """A segment with a picture of each state."""
    return segment(len(pictures) - 1) | {"frames": [one["hash"] for one in pictures]}


def used_run(service: Service, **more: Any) -> str:
    """A finished run with an answer, a retracted answer, a late one, a skip, a comment, gold, pictures and a result."""
    service.learner.call("PUT", "/frames", {"frames": [OWN, SHARED]}, 204)
    run = service.learner.create_run(name=SECRET, config={"note": SECRET}, **more)
    asked = service.learner.ask(
        run,
        query("label_hi", question=SECRET, segments=[seen(OWN, SHARED, OWN)]),
        query(ordinal=1, instance={"map": SECRET}),
        query(ordinal=2),
    )
    passed = {"kind": "inspect_full", "verdict": "pass"}
    known = {"known": [{"ask": query(episode=9, question=SECRET), "known": passed}]}
    service.learner.post(f"/runs/{run}/gold", known)
    service.learner.post(f"/runs/{run}/episodes", {"episodes": [RESULT]})
    held = service.annotator.lease(run=run)
    service.annotator.answer(held, headers={"Idempotency-Key": f"{SECRET}-{run}"})
    again = service.annotator.retract(held)
    service.annotator.answer(again)
    service.learner.post(f"/queries/{asked[0]['id']}/comments", {"text": SECRET}, 201)
    service.annotator.release(service.annotator.lease(run=run, tab=SECRET), skip=True, reason=SECRET)
    service.admin.answer(service.admin.lease(run=run))
    service.learner.patch(run, state="finished", result={"note": SECRET})
    return run


def numbers(service: Service, run: str) -> Json:
    """Every sum that must stay."""
    tests = {"tests": 0}  # results of episodes go
    lines = service.client.get(f"{API}/runs/{run}/export?table=ledger&format=jsonl", headers=service.viewer.headers)
    return {
        "costs": service.viewer.costs(run) | tests,
        "ledger": service.viewer.get(f"/runs/{run}/ledger"),
        "export": lines.text,
        "me": {name: service.annotator.get("/me")[name] for name in ("answers", "units", "median_seconds")},
        "numbers": service.admin.get("/numbers"),
        "answers": service.db.read_now(
            lambda tx: tx.conn.execute(
                select(answers.c.id, answers.c.units, answers.c.seconds, answers.c.revision).order_by(answers.c.id)
            ).all()
        ),
    }


def test_a_deleted_run_keeps_every_sum_and_nothing_else(service: Service, database_url: str) -> None:
    other = service.learner.create_run(name="another")
    run = used_run(service, budget=100.0)
    before = numbers(service, run)
    deleted = service.learner.call("DELETE", f"/runs/{run}")
    assert (deleted["queries"], deleted["answers"], deleted["gold"], deleted["comments"]) == (3, 3, 1, 1)
    assert (deleted["run"], deleted["dry_run"], deleted["kept_entries"]) == (run, False, 4)
    assert deleted["kept_units"] == before["costs"]["total"] == 2
    assert numbers(service, run) == before
    assert sound(database_url)
    assert [one["id"] for one in service.viewer.get("/runs")["runs"]] == [other]
    (row,) = [one for one in service.admin.get("/audit")["rows"] if one["action"] == "run.deleted"]
    assert (row["actor"], row["object"], row["details"]) == ("lea", f"run/{run}", {"queries": 3, "answers": 3})


def test_a_dry_run_says_exactly_what_goes_and_changes_nothing(service: Service, database_url: str) -> None:
    run = used_run(service)
    told = service.learner.call("DELETE", f"/runs/{run}", params={"dry_run": True})
    assert told["dry_run"]
    assert service.viewer.get(f"/runs/{run}")["name"] == SECRET
    told_by_command = json.loads(command(database_url, "run", "delete", run, "--dry-run", "--json"))
    assert told_by_command == told
    assert service.learner.call("DELETE", f"/runs/{run}") | {"dry_run": True} == told
    assert all(told[name] > 0 for name in told.keys() - {"run", "dry_run", "messages"}), told


def test_what_was_deleted_is_not_found(service: Service) -> None:
    run = used_run(service)
    held = service.learner.get(f"/runs/{run}/queries")["queries"]
    service.learner.call("DELETE", f"/runs/{run}")
    for path in ("", "/queries", "/query-rows", "/answers", "/curves", "/events", "/gold", "/review", "/agreement"):
        service.learner.get(f"/runs/{run}{path}", 404)
    service.learner.get(f"/runs/{run}/export?table=queries", 404)
    service.learner.get(f"/runs/{run}/records?part=queries", 404)
    for one in held:
        service.learner.get(f"/queries/{one['id']}", 404)
        service.learner.get(f"/queries/{one['id']}/history", 404)
    service.learner.ask(run, query(), expect=404)
    service.learner.patch(run, 404, name="back")
    service.learner.call("DELETE", f"/runs/{run}", expect=404)
    assert service.annotator.get("/me/returned")["returned"] == []
    assert service.annotator.get("/outlook")["runs"] == []


def test_an_answer_that_comes_after_the_deletion_is_refused(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    answered, late = service.annotator.lease(), service.annotator.lease()
    service.annotator.answer(answered)
    service.learner.patch(run, state="finished")
    service.learner.call("DELETE", f"/runs/{run}")
    for held in (answered, late):
        service.annotator.answer(held, right_answer(query()), expect=404)
    service.annotator.retract(answered, 404)
    service.learner.costs(run)


def test_only_a_finished_run_is_deleted(service: Service) -> None:
    run = service.learner.create_run()
    for state in ("running", "paused"):
        service.learner.patch(run, state=state)
        for dry_run in (True, False):
            said = service.learner.call("DELETE", f"/runs/{run}", params={"dry_run": dry_run}, expect=409)
            assert said["type"] == "/problems/not-finished"
            assert said["detail"] == f"Run {run} is {state}; finish it before you delete it."


def test_pictures_go_with_the_last_run_that_shows_them(service: Service) -> None:
    run = used_run(service)
    other = service.learner.create_run()
    service.learner.ask(other, query("label_hi", segments=[seen(SHARED, SHARED)]))
    told = service.learner.call("DELETE", f"/runs/{run}")
    assert (told["frames"], told["frame_bytes"]) == (1, len(png(1)))
    service.viewer.get(f"/frames/{OWN['hash']}", 404)
    assert service.client.get(f"{API}/frames/{SHARED['hash']}", headers=service.viewer.headers).content == png(2)
    service.learner.patch(other, state="finished")
    assert service.learner.call("DELETE", f"/runs/{other}")["frames"] == 1
    service.viewer.get(f"/frames/{SHARED['hash']}", 404)


def test_a_played_demonstration_shows_pictures_too(service: Service) -> None:
    service.learner.call("PUT", "/frames", {"frames": [OWN]}, 204)
    run = service.learner.create_run()
    service.learner.ask(run, query("hier_demo"))
    segments = [{"subgoal": "south", "actions": ["up"]}]
    replay = {"states": [1, 2], "frames": [OWN["hash"], OWN["hash"]]}
    service.annotator.answer(service.annotator.lease(), {"kind": "hier_demo", "segments": segments, "replay": replay})
    service.learner.patch(run, state="finished")
    assert service.learner.call("DELETE", f"/runs/{run}")["frames"] == 1


def test_pictures_that_nobody_ever_showed_go_after_a_day_and_those_of_practice_stay(service: Service) -> None:
    service.learner.call("PUT", "/frames", {"frames": [OWN, SHARED, PRACTICE]}, 204)
    run = service.learner.create_run()
    service.learner.patch(run, state="finished")

    def age(tx: Tx) -> None:
        tx.conn.execute(update(frames).where(frames.c.hash != SHARED["hash"]).values(created_at=1.0))
        tx.conn.execute(update(frames).where(frames.c.hash == PRACTICE["hash"]).values(pinned=True))

    service.db.write_now(age)
    assert service.learner.call("DELETE", f"/runs/{run}")["frames"] == 1
    missing = service.learner.post("/frames/missing", {"hashes": [one["hash"] for one in (OWN, SHARED, PRACTICE)]})
    assert missing["hashes"] == [OWN["hash"]]


def shown_once(service: Service) -> tuple[str, str, Json]:
    """A finished run that shows a picture, a run that does not yet, and a question about the picture."""
    service.learner.call("PUT", "/frames", {"frames": [OWN]}, 204)
    run, other = service.learner.create_run(), service.learner.create_run()
    service.learner.ask(run, query("label_hi", segments=[seen(OWN, OWN)]))
    service.learner.patch(run, state="finished")
    return run, other, query("label_hi", segments=[seen(OWN, OWN)])


def test_a_picture_that_another_run_begins_to_show_meanwhile_stays(service: Service, database_url: str) -> None:
    run, other, _ = shown_once(service)
    is_shown, is_deleted = threading.Event(), threading.Event()

    def show(tx: Tx) -> None:
        frame_uses.show(tx, other, [OWN["hash"]])
        is_shown.set()
        assert not is_deleted.wait(0.5)

    def delete() -> int:
        assert is_shown.wait(10)
        deleted = service.learner.call("DELETE", f"/runs/{run}")
        is_deleted.set()
        return int(deleted["frames"])

    with ThreadPoolExecutor(2) as pool:
        shown, deleted = pool.submit(service.db.write_now, show), pool.submit(delete)
        shown.result()
        assert deleted.result() == 0
    assert service.learner.post("/frames/missing", {"hashes": [OWN["hash"]]})["hashes"] == []
    assert sound(database_url)


def test_a_question_about_a_picture_that_goes_meanwhile_is_refused(service: Service, database_url: str) -> None:
    run, other, asked = shown_once(service)
    is_gone, is_asked = threading.Event(), threading.Event()

    def delete(tx: Tx) -> None:
        deletion.delete(tx, run_service.lock(tx, run))
        is_gone.set()
        assert not is_asked.wait(0.5)

    def ask() -> Any:
        assert is_gone.wait(10)
        said = service.learner.ask(other, asked, expect=422)
        is_asked.set()
        return said

    with ThreadPoolExecutor(2) as pool:
        deleted, refused = pool.submit(service.db.write_now, delete), pool.submit(ask)
        deleted.result()
        assert "upload it before asking" in refused.result()["detail"]
    assert sound(database_url)


def test_the_content_of_a_run_that_is_not_deleted_cannot_be_removed(service: Service) -> None:
    run = used_run(service)
    hollow = "UPDATE answers SET content = '', digest = '', idempotency_key = NULL"
    refuse(service, hollow, "DELETE FROM events", "DELETE FROM comments", "DELETE FROM answers", "DELETE FROM ledger")
    service.learner.call("DELETE", f"/runs/{run}")
    refuse(
        service,
        f"{hollow}, units = 0",
        f"{hollow}, user_id = 1",
        "UPDATE answers SET content = 'another'",
        "DELETE FROM answers",
        "UPDATE ledger SET units = 0",
        "DELETE FROM ledger",
        "UPDATE audit SET actor = 'nobody'",
    )


def refuse(service: Service, *statements: str) -> None:
    for statement in statements:
        with pytest.raises((DBAPIError, Exception), match="append-only"):
            service.db.write_now(lambda tx, statement=statement: tx.conn.execute(text(statement)))


def test_an_account_that_was_used_in_every_way_is_sound_after_its_deletion(service: Service, database_url: str) -> None:
    use(service)

    def own(tx: Tx) -> list[str]:
        return list(tx.conn.execute(select(runs.c.id).where(runs.c.gold_of.is_(None))).scalars())

    def entries(tx: Tx) -> list[Any]:
        return list(tx.conn.execute(select(ledger).order_by(ledger.c.id)))

    before = service.db.read_now(entries)
    for run in service.db.read_now(own):
        service.learner.patch(run, state="finished")
        service.learner.call("DELETE", f"/runs/{run}")
    assert service.db.read_now(entries) == before
    assert sound(database_url)


def test_a_store_of_an_earlier_version_knows_which_pictures_its_runs_show(empty_url: str) -> None:
    make_older_store(empty_url, "0010")
    other = frame(png(4))
    shown = json.dumps({"segments": [{"frames": [OWN["hash"]]}]}, separators=(",", ":"))
    replayed = json.dumps({"replay": {"frames": [SHARED["hash"]]}}, separators=(",", ":"))
    engine = create_engine(parse(empty_url))
    with engine.begin() as conn:
        for picture in (OWN, SHARED, PRACTICE, other):
            row = {"hash": picture["hash"], "png": base64.b64decode(picture["png"])}
            conn.execute(text("INSERT INTO frames (hash, png, created_at) VALUES (:hash, :png, 1)"), row)
        for statement in OLD_ROWS:
            conn.execute(text(statement), {"shown": shown, "replayed": replayed})
    engine.dispose()
    migrate(empty_url)
    with in_process(empty_url) as service:
        uses = service.db.read_now(lambda tx: tx.conn.execute(select(tables.frame_uses.c.hash)).scalars().all())
        assert set(uses) == {OWN["hash"], SHARED["hash"]}
        assert service.admin.call("DELETE", "/runs/0123456789ab")["frames"] == 4  # nobody ever showed two of them
    assert sound(empty_url)


OLD_ROWS = (
    "INSERT INTO runs (id, user_id, name, algorithm, seed, state, vocabulary, config, prices, spent, reserved, "
    "created_at, finished_at) VALUES ('0123456789ab', 1, 'old', 'h-bc', 0, 'finished', '{}', '{}', '{}', 0, 0, 1, 2)",
    "INSERT INTO queries (id, run_id, episode, ordinal, kind, state, priority, ask, digest, reserve, revision, used, "
    "created_at) VALUES (1, '0123456789ab', 0, 0, 'hier_demo', 'cancelled', 0, :shown, '', 0, 0, false, 1)",
    "INSERT INTO assignments (id, query_id, user_id, token, state, deferring, leased_at, expires_at, ended_at) "
    "VALUES (1, 1, 1, 'token', 'expired', false, 1, 2, 2)",
    "INSERT INTO answers (run_id, query_id, assignment_id, user_id, content, digest, units, seconds, active_seconds, "
    "created_at) VALUES ('0123456789ab', 1, 1, 1, :replayed, '', 0, 1, 1, 3)",
)


def files(folder: Path) -> Iterator[bytes]:
    for file in folder.glob("*.db*"):
        yield file.read_bytes()


def test_no_file_of_the_store_has_what_was_deleted(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path / 'waypost.db'}"
    with in_process(url) as service:
        run = used_run(service)
    assert any(SECRET.encode() in file for file in files(tmp_path))
    assert png(1) in next(files(tmp_path))
    said = command(url, "run", "delete", run)
    assert said == (
        f"Deleted 3 queries, 3 answers, 1 comments and 2 pictures ({len(png(1)) + len(png(2))} bytes) of run {run}. "
        "Its ledger stays: 2 units."
    )
    assert not any(SECRET.encode() in file or png(1) in file for file in files(tmp_path))
    with closing(sqlite3.connect(tmp_path / "waypost.db")) as conn:
        assert conn.execute("SELECT sum(units) FROM ledger").fetchone() == (2_000_000,)
    assert sound(url)


def test_old_runs_are_deleted_by_a_command(database_url: str) -> None:
    with in_process(database_url) as service:
        old, new, running = used_run(service), used_run(service), service.learner.create_run()
        service.db.write_now(lambda tx: tx.conn.execute(update(runs).where(runs.c.id == old).values(finished_at=1.0)))
        days = ("run", "delete-old", "--days", "30")
        assert old in command(database_url, *days, "--dry-run")
        assert [one["run"] for one in json.loads(command(database_url, *days, "--json"))] == [old]
        assert command(database_url, *days) == "No run finished more than 30 days ago."
        assert {one["id"] for one in service.viewer.get("/runs")["runs"]} == {new, running}
        assert sound(database_url)
    assert "finish it before" in command(database_url, "run", "delete", running, status=2)
    assert "There is no run" in command(database_url, "run", "delete", old, status=2)


def test_a_frame_is_shown_once_per_run(lite: Service) -> None:
    lite.learner.call("PUT", "/frames", {"frames": [OWN]}, 204)
    run = lite.learner.create_run()
    for _ in range(2):
        absent = lite.db.write_now(lambda tx: frame_uses.show(tx, run, [OWN["hash"], SHARED["hash"], OWN["hash"]]))
        assert absent == [SHARED["hash"]]
