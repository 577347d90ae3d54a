"""Records: everything of a run can be read in pages, and a store that takes them in has the same run."""

import json
from collections.abc import Callable
from contextlib import closing
from itertools import chain
from pathlib import Path
from typing import Any

import pytest
from tests.server.db.plans import plans
from tests.server.kit import Json, Service, frame, in_process, png, query, segment

from waypost import wire
from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.users import service as users
from waypost_server.watch.records import reading, restoring

EPISODE = {
    "warm_start": False,
    "train_success": False,
    "test_success": True,
    "train_steps": 2,
    "test_steps": 4,
    "hi_labels": 1,
    "lo_labels": 2,
    "seconds": 0.125,
}


def eventful_run(service: Service) -> str:
    """A finished run in which all happened that can happen to a query."""
    picture = frame(png(7))
    service.learner.call("PUT", "/frames", {"frames": [picture]}, 204)
    run = service.learner.create_run(budget=100, prices={"inspect_full": 0.1}, config={"seed": 3, "x": [1.0, None]})
    seen = segment(1) | {"frames": [picture["hash"]] * 2}
    one, other = service.user("ada", "annotator"), service.user("bea", "annotator")
    service.learner.ask(run, query("inspect_full", segments=[seen]))
    late = one.lease()
    service.db.write_now(lambda tx: tx.conn.exec_driver_sql("UPDATE assignments SET expires_at = leased_at"))
    one.answer(late, expect=409)
    held = other.lease()
    other.release(held, skip=True, reason="too dark")
    one.answer(one.lease())
    service.learner.ask(run, query("label_lo", 0, 1), query("label_hi", 1, 0))
    first = one.lease()
    one.answer(first)
    again = one.retract(first)
    one.answer(again)
    (asked,) = service.learner.ask(run, query("label_lo", 0, 1))
    service.learner.post(f"/queries/{asked['id']}/use")
    one.answer(one.lease())
    service.learner.ask(run, query("hier_demo", 2, 0), query("label_full", 2, 1))
    one.lease()
    service.learner.post(f"/runs/{run}/episodes", {"episodes": [EPISODE | {"episode": n} for n in range(3)]})
    service.learner.patch(run, state="finished", result={"weights": "abc"})
    return run


def pages(service: Service, run: str, part: str) -> list[Json]:
    """All records of a part, page by page."""
    found: list[Json] = []
    page: Json = {"cursor": ""}
    while page["cursor"] is not None:
        after = f"&after={page['cursor']}" if page["cursor"] != "" else ""
        page = service.viewer.get(f"/runs/{run}/records?part={part}{after}")
        found += page["records"]
    return found


def told(service: Service, run: str) -> list[Json]:
    """All records of a run, as `waypost export` puts them together."""
    picture = {"record": "frame", "frame": frame(png(7))}
    parts = [pages(service, run, part) for part in ("queries", "ledger", "episodes")]
    return [{"record": "run", "format": 1, "run": service.viewer.get(f"/runs/{run}")}, picture, *chain(*parts)]


CLASSES = {
    "run": wire.RunRecord,
    "frame": wire.FrameRecord,
    "query": wire.QueryRecord,
    "ledger": wire.LedgerRecord,
    "episode": wire.EpisodeRecord,
}


def taken_in(url: str, records: list[Json]) -> wire.Run:
    """Recreate a run in the store at `url`."""
    values: list[Any] = [CLASSES[one["record"]].model_validate(one) for one in records]
    with closing(Database(url)) as db:
        return db.write_now(
            lambda tx: restoring.restore(tx, values, users.ensure_administrator(tx).id, users.ensure_former_user)
        )


def test_a_run_that_was_taken_in_tells_what_the_original_tells(
    service: Service, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    url = f"sqlite:///{tmp_path / 'copy.db'}"
    monkeypatch.setattr(reading, "PAGE", 2)
    monkeypatch.setattr(restoring, "AT_ONCE", 2)
    run = eventful_run(service)
    records = told(service, run)
    assert [one["record"] for one in records].count("query") == 5
    taken_in(url, records)
    with in_process(url) as copy:
        assert told(copy, run) == records
        for view in ("", "/curves", "/costs"):
            assert copy.viewer.get(f"/runs/{run}{view}") == service.viewer.get(f"/runs/{run}{view}")
        assert copy.client.get(f"/api/v1/frames/{frame(png(7))['hash']}", headers=copy.viewer.headers).content == png(7)


def test_to_take_in_a_ledger_reads_no_other_query_of_the_run(lite: Service, tmp_path: Path) -> None:
    records = told(lite, eventful_run(lite))
    (plan,) = plans(
        "(queries.episode, queries.ordinal) IN", lambda: taken_in(f"sqlite:///{tmp_path / 'b.db'}", records)
    )
    assert "queries USING INDEX sqlite_autoindex_queries_2 (run_id=? AND episode=?" in plan


def test_what_befell_a_query_is_in_its_record(service: Service) -> None:
    records = told(service, eventful_run(service))
    inspected, labeled, _, demonstration, _ = [one for one in records if one["record"] == "query"]
    late, skipped = inspected["earlier"]
    assert (late["state"], late["annotator"]) == ("expired", "ada")
    assert (late["answer"]["revision"], late["answer"]["units"]) == (None, 0)
    assert (skipped["state"], skipped["annotator"], skipped["reason"]) == ("skipped", "bea", "too dark")
    assert inspected["answered"]["answer"]["content"] == {"kind": "inspect_full", "verdict": "pass"}
    (retracted,) = labeled["earlier"]
    assert (retracted["answer"]["revision"], labeled["answered"]["answer"]["revision"]) == (0, 1)
    assert labeled["used"]
    assert (demonstration["state"], demonstration["answered"]) == ("cancelled", None)
    entries = [(one["entry"], one["units"]) for one in records if one["record"] == "ledger"]
    assert entries == [("charge", 0.1), ("charge", 3), ("refund", -3), ("charge", 3), ("charge", 1)]


def test_an_imported_run_is_marked_belongs_to_an_administrator_and_can_spend_nothing(
    lite: Service, tmp_path: Path
) -> None:
    run = lite.learner.create_run(budget=5)
    lite.learner.patch(run, state="finished")
    url = f"sqlite:///{tmp_path / 'copy.db'}"
    taken_in(url, told(lite, run))
    with in_process(url) as copy:
        assert copy.admin.patch(run, 409, state="running")["type"] == "/problems/run-finished"
        assert copy.admin.ask(run, query(), expect=409)["type"] == "/problems/run-finished"
        copy.learner.patch(run, 403, name="mine")
        with closing(Database(url)) as db:
            (event,) = db.read_now(lambda tx: tx.conn.exec_driver_sql("SELECT data FROM events").scalars().all())
        assert json.loads(event) == {"state": "finished", "imported": True}


def test_annotators_unknown_to_the_store_become_deactivated_users(service: Service, tmp_path: Path) -> None:
    run = eventful_run(service)
    url = f"sqlite:///{tmp_path / 'copy.db'}"
    with closing(Database(url)) as db:
        db.write_now(lambda tx: users.create_user(tx, "ada", "annotator"))
    taken_in(url, told(service, run))
    with closing(Database(url)) as db:
        active = {user.name: user.deactivated_at is None for user in db.read_now(users.list_users).users}
    assert active == {"ada": True, "bea": False, "admin": True}


# --- what is refused


def change(*path: Any, to: Any) -> Callable[[list[Json]], None]:
    """A change of one value: the record by its place, then the names of its fields."""

    def changed(records: list[Json]) -> None:
        place: Any = records
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = to

    return changed


def left_out(place: int) -> Callable[[list[Json]], None]:
    return lambda records: records.pop(place) and None


def twice(place: int) -> Callable[[list[Json]], None]:
    return lambda records: records.insert(place, records[place])


QUERY, CHARGE, REFUND, RESULT = 2, 7, 9, 12  # places in what `told` returns


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [
        (change(0, "run", "state", to="running"), "run.state: is running; finish the run and export it again"),
        (change(QUERY, "ask", "segments", 0, "actions", to=["fly"]), "'fly' is not an action of this run"),
        (change(QUERY, "answered", "answer", "content", to={"kind": "label_hi", "subgoals": []}), "is label_hi"),
        (change(QUERY, "answered", "answer", "units", to=0.2), "the ledger disagrees with its answers"),
        (change(QUERY, "answered", to=None), "but the answer says otherwise"),
        (change(QUERY, "earlier", 0, "state", to="live"), "has a live assignment"),
        (change(QUERY + 1, "answered", "answer", "revision", to=0), "does not count the retractions"),
        (change(CHARGE, "units", to=0.2), "the ledger disagrees with its answers"),
        (change(CHARGE, "ordinal", to=9), "there is no such answer"),
        (left_out(CHARGE), "the ledger disagrees with its answers"),
        (left_out(REFUND), "the ledger disagrees with its answers"),
        (twice(CHARGE), "contradict each other or come twice"),
        (twice(QUERY), "contradict each other or come twice"),
        (left_out(RESULT), "run.episodes_done: is 3, but the records give 2; is the file complete?"),
        (left_out(1), "is not stored; upload it before asking"),
        (left_out(0), "the first record must be the run"),
        (twice(0), "have the run twice"),
        (change(0, "run", "spent", to=1.0), "run.spent: is 1.0, but the records give 4.1"),
    ],
)
def test_records_that_cannot_be_true_change_nothing(
    spoil: Callable[[list[Json]], None], complaint: str, sqlite_url: str, told_once: list[Json]
) -> None:
    records = [dict(_copied(one)) for one in told_once]
    spoil(records)
    with pytest.raises(errors.Unprocessable) as refusal:
        taken_in(sqlite_url, records)
    assert complaint in refusal.value.detail
    with closing(Database(sqlite_url)) as db:
        for table in ("runs", "queries", "users", "answers", "ledger", "frames"):
            count = f"SELECT count(*) FROM {table}"
            assert db.read_now(lambda tx, count=count: tx.conn.exec_driver_sql(count).scalar_one()) == 0, table


def _copied(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _copied(one) for name, one in value.items()}
    return [_copied(one) for one in value] if isinstance(value, list) else value


@pytest.fixture(scope="module")
def told_once(tmp_path_factory: pytest.TempPathFactory) -> list[Json]:
    """The records of the eventful run."""
    url = f"sqlite:///{tmp_path_factory.mktemp('told') / 'waypost.db'}"
    with in_process(url) as service:
        records = told(service, eventful_run(service))
    assert [records[n]["record"] for n in (QUERY, CHARGE, REFUND, RESULT)] == ["query", "ledger", "ledger", "episode"]
    assert records[REFUND]["entry"] == "refund"
    return records


def test_a_run_is_taken_in_once(sqlite_url: str, told_once: list[Json]) -> None:
    taken_in(sqlite_url, told_once)
    with pytest.raises(errors.RunExists, match="The store already has run"):
        taken_in(sqlite_url, told_once)


def test_a_run_that_is_not_there_has_no_records(lite: Service) -> None:
    assert lite.viewer.get("/runs/none/records?part=queries", 404)["type"] == "/problems/not-found"
