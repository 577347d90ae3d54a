"""`waypost check`: a store that was used in every way is sound, and each kind of damage is named."""

import json
from pathlib import Path

import pytest
from sqlalchemy import Connection, create_engine, text
from tests.server.kit import Service, in_process, query
from typer.testing import CliRunner

from waypost_server.cli.main import app
from waypost_server.db.engine import migrate, parse


def use(service: Service) -> None:
    """Ask, answer, retract, come too late, skip, release, cancel, answer gold queries, send back, and answer twice."""
    run = service.learner.create_run(budget=1_000)
    service.learner.ask(run, *(query(ordinal=n) for n in range(6)))
    held = service.annotator.lease()
    service.annotator.answer(held)
    again = service.annotator.retract(held)
    service.annotator.answer(again, {"kind": "inspect_full", "verdict": "fail"})
    service.annotator.answer(service.annotator.lease())
    held = service.annotator.lease()
    service.annotator.answer(held)
    service.annotator.retract(held)
    service.annotator.release(service.annotator.lease(), skip=True)
    service.learner.patch(run, priority=3)
    known = {"kind": "inspect_full", "verdict": "pass"}
    gold = {"known": [{"ask": query(episode=9), "known": known}]}
    service.learner.post(f"/runs/{run}/gold", gold)
    service.learner.patch(run, gold_rate=0.5)
    for _ in range(2):
        service.annotator.answer(service.annotator.lease())
    done = service.learner.create_run(second_answers=1.0)
    (first, _) = service.learner.ask(done, query(), query(ordinal=1))
    given = service.annotator.answer(service.annotator.lease(run=done))
    back = {"answer": given["answer"], "text": "Look again."}
    service.learner.post(f"/queries/{first['id']}/send-back", back, 201)
    service.annotator.answer(service.annotator.lease(run=done))
    service.admin.answer(service.admin.lease(run=done))
    service.learner.patch(done, state="finished")


@pytest.fixture
def used(database_url: str) -> str:
    """The URL of a store that was used."""
    with in_process(database_url) as service:
        use(service)
    return database_url


def check(url: str, status: int = 0) -> list[dict[str, object]]:
    done = CliRunner().invoke(app, ["check", "--json", "--database", url])
    assert done.exit_code == status, done.output
    results: list[dict[str, object]] = json.loads(done.output)
    return results


def test_a_store_that_was_used_in_every_way_is_sound(used: str) -> None:
    assert [result["n_faults"] for result in check(used)] == [0] * (23 if used.startswith("sqlite") else 21)


def test_a_store_from_before_the_sums_of_the_ledger_gets_them_and_keeps_them(used: str) -> None:
    engine = create_engine(parse(used))
    with engine.begin() as conn:
        on_postgresql = conn.dialect.name == "postgresql"
        conn.execute(text("DROP TRIGGER ledger_summed" + (" ON ledger" if on_postgresql else "")))
        if on_postgresql:
            conn.execute(text("DROP FUNCTION add_to_ledger_sums"))
        conn.execute(text("DROP TABLE ledger_sums"))
        conn.execute(text("UPDATE alembic_version SET version_num = '0017'"))
    engine.dispose()
    migrate(used)
    check(used)
    with in_process(used) as service:
        use(service)
    check(used)


def test_it_says_what_holds_and_what_does_not(used: str) -> None:
    done = CliRunner().invoke(app, ["check", "--database", used])
    assert "ok    What a run has spent is what the ledger says." in done.output
    damage(used, "UPDATE runs SET spent = spent + 1 WHERE gold_of IS NULL")
    done = CliRunner().invoke(app, ["check", "--database", used])
    assert done.exit_code == 1
    assert "WRONG What a run has spent is what the ledger says. Not so: run " in done.output


def damage(url: str, statement: str) -> None:
    """Change a store behind the server's back, whatever its constraints and triggers say."""
    engine = create_engine(url.replace("postgresql:", "postgresql+psycopg:"))
    with engine.connect() as conn:
        unguard(conn)
        conn.execute(text(statement))
        conn.commit()
    engine.dispose()


def unguard(conn: Connection) -> None:
    if conn.dialect.name == "sqlite":
        conn.execute(text("PRAGMA ignore_check_constraints = ON"))
        for (trigger,) in conn.execute(text("SELECT name FROM sqlite_master WHERE type = 'trigger'")).all():
            conn.execute(text(f"DROP TRIGGER {trigger}"))
        conn.execute(text("DROP INDEX uq_assignments_live"))
    else:
        for table in ("answers", "ledger", "events", "queries", "assignments", "runs", "comments", "second_answers"):
            conn.execute(text(f"ALTER TABLE {table} DISABLE TRIGGER ALL"))
        checks = conn.execute(
            text("SELECT conrelid::regclass, conname FROM pg_constraint WHERE contype = 'c' AND conrelid != 0")
        ).all()
        for table, name in checks:
            conn.execute(text(f"ALTER TABLE {table} DROP CONSTRAINT {name}"))


ONE = "(SELECT min(id) FROM queries WHERE state = 'answered' AND episode = 0)"
DAMAGES = {
    "UPDATE runs SET spent = spent - 1 WHERE spent > 0": "What a run has spent is the cost of the answers that count.",
    "UPDATE ledger_sums SET units = units + 1 WHERE units > 0": "The sums of a run's ledger are those of its entries.",
    "UPDATE ledger_sums SET seconds = seconds + 1": "The sums of a run's ledger are those of its entries.",
    "DELETE FROM ledger_sums": "The sums of a run's ledger are those of its entries.",
    "UPDATE runs SET budget = 0": "A run has spent and reserved no more than its budget.",
    "UPDATE runs SET reserved = reserved + 1": "What a run has reserved is for its queries without an answer.",
    "UPDATE ledger SET units = units + 1 WHERE entry = 'charge'": "An answer is charged once",
    "DELETE FROM ledger WHERE entry = 'refund'": "An answer is charged once",
    "UPDATE ledger SET episode = 7": "An entry of the ledger has the run",
    f"UPDATE queries SET revision = revision + 1 WHERE id = {ONE}": "The answer that counts for a query was given to",
    "UPDATE queries SET state = 'open' WHERE state = 'leased'": "A query is leased exactly as long",
    "UPDATE assignments SET state = 'released' WHERE state = 'answered'": "An assignment has ended with an answer",
    "UPDATE runs SET state = 'finished' WHERE state = 'running'": "A finished run has no query without an answer.",
    "UPDATE queries SET run_priority = 9 WHERE state = 'open'": "A query without an answer has the priority of its",
    "UPDATE users SET frame_bytes = 1 WHERE name = 'lea'": "The pictures that a user has uploaded have the size",
    "UPDATE runs SET deleted_at = 1 WHERE state = 'finished'": "A deleted run has no content.",
    "UPDATE users SET deactivated_at = 1, erased_at = 1 WHERE name = 'abe'": "A user whose personal data were deleted",
    "UPDATE probes SET query_id = (SELECT min(id) FROM queries)": "A gold query is shown in the shadow of its run.",
    "UPDATE comments SET query_id = (SELECT max(id) FROM queries)": "An answer that was sent back belongs to the query",
    "UPDATE second_answers SET query_id = of_query_id": "A second answer is given in the shadow of its query's run.",
}


@pytest.mark.parametrize(("statement", "fact"), DAMAGES.items(), ids=[str(n) for n in range(len(DAMAGES))])
def test_each_kind_of_damage_is_named(used: str, statement: str, fact: str) -> None:
    damage(used, statement)
    wrong = [str(result["fact"]) for result in check(used, status=1) if result["n_faults"]]
    assert any(one.startswith(fact) for one in wrong), wrong


def test_a_row_that_refers_to_nothing_is_named(sqlite_url: str) -> None:
    with in_process(sqlite_url) as service:
        use(service)
    damage(sqlite_url, "DELETE FROM users WHERE name = 'abe'")
    wrong = [result["fact"] for result in check(sqlite_url, status=1) if result["n_faults"]]
    assert "What a row refers to exists." in wrong


def test_a_store_that_does_not_exist_is_not_created(empty_url: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["check", "--database", empty_url])
    assert (done.exit_code, "There is no store" in done.output) == (2, True), done.output
    assert list(tmp_path.glob("*.db*")) == []


@pytest.mark.parametrize(
    ("statement", "fact"),
    [
        ("ALTER TABLE runs ADD COLUMN mine TEXT", "The tables, columns and indexes are those of this version."),
        ("DROP INDEX uq_runs_gold_of", "The tables, columns and indexes are those of this version."),
        (
            "{drop}",
            "No statement can change an answer, an entry of the ledger, an event, a comment or a row of the audit log.",
        ),
    ],
)
def test_a_store_whose_schema_was_changed_is_named(used: str, statement: str, fact: str) -> None:
    lite = used.startswith("sqlite")
    engine = create_engine(used.replace("postgresql:", "postgresql+psycopg:"))
    drop = "DROP TRIGGER ledger_no_delete" if lite else "ALTER TABLE ledger DISABLE TRIGGER ledger_append_only"
    with engine.begin() as conn:
        conn.execute(text(statement.format(drop=drop)))
    engine.dispose()
    assert [result["fact"] for result in check(used, status=1) if result["n_faults"]] == [fact]
