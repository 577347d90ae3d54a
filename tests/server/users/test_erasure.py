"""Deleting a person's data: nothing names them any more but the audit log, and every sum stays."""

import json

import pytest
from sqlalchemy import text
from tests.server.db.test_checking import check
from tests.server.kit import Json, Service, query
from tests.server.runs.test_deletion import command

NAME = "Zoe Hypatia-Lovelace"


def at_work(service: Service) -> tuple[int, str]:
    """A person who answered, skipped with a reason, commented and logged in; returns their id and the run."""
    zoe = service.user(NAME, "admin")
    user = int(zoe.get("/me")["id"])
    run = service.learner.create_run()
    (first, _) = service.learner.ask(run, query(), query(ordinal=1))
    zoe.answer(zoe.lease())
    zoe.release(zoe.lease(tab="tab-of-zoe"), skip=True, reason=f"{NAME} is tired")
    zoe.post(f"/queries/{first['id']}/comments", {"text": f"{NAME} was here"}, 201)
    zoe.post("/tokens", {"label": f"the laptop of {NAME}"}, 201)
    service.admin.post(f"/users/{user}/login-links", expect=201)
    return user, run


def deactivate(service: Service, user: int) -> None:
    service.admin.call("PATCH", f"/users/{user}", {"active": False})


def numbers(service: Service, run: str) -> Json:
    """Every sum that must stay."""
    annotators = service.admin.get("/numbers")["annotators"]
    return {"costs": service.admin.costs(run), "all": [one | {"name": ""} for one in annotators]}


def naming(service: Service) -> set[str]:
    """The tables in which the name of the person still is."""
    tables = ("users", "credentials", "comments", "assignments", "presence", "departures", "runs", "audit", "events")
    found = set()
    for table in tables:
        rows = service.db.read_now(lambda tx, table=table: tx.conn.execute(text(f"SELECT * FROM {table}")).all())
        if any(NAME in str(row) or "tab-of-zoe" in str(row) for row in rows):
            found.add(table)
    return found


def test_nothing_but_the_audit_log_names_an_erased_user_and_every_sum_stays(
    service: Service, database_url: str
) -> None:
    user, run = at_work(service)
    deactivate(service, user)
    before = numbers(service, run)
    told = service.admin.call("DELETE", f"/users/{user}", params={"dry_run": True})
    assert NAME in str(service.admin.get("/users"))
    erased = service.admin.call("DELETE", f"/users/{user}")
    assert erased == told | {"dry_run": False}
    assert (erased["credentials"], erased["comments"], erased["reasons"]) == (3, 1, 1)
    assert (erased["traces"], erased["kept_answers"], erased["kept_units"]) == (2, 1, 1)
    assert numbers(service, run) == before
    assert naming(service) == {"audit"}
    assert all(one["n_faults"] == 0 for one in check(database_url))
    (row,) = [one for one in service.admin.get("/audit")["rows"] if one["action"] == "user.erased"]
    assert (row["actor"], row["object"], row["details"]) == ("ann", f"user/{user}", {"answers": 1})
    shown = service.admin.get(f"/users/{user}")
    assert (shown["name"][:7], shown["erased_at"] is not None) == ("erased-", True)


def test_an_active_user_and_one_who_was_erased_are_refused(service: Service) -> None:
    user, _ = at_work(service)
    for dry_run in (True, False):
        said = service.admin.call("DELETE", f"/users/{user}", params={"dry_run": dry_run}, expect=409)
        assert said["type"] == "/problems/still-active"
        service.admin.call("DELETE", "/users/999", params={"dry_run": dry_run}, expect=404)
    deactivate(service, user)
    service.admin.call("DELETE", f"/users/{user}")
    for method, body in (("DELETE", None), ("PATCH", {"active": True}), ("PATCH", {"role": "viewer"})):
        assert service.admin.call(method, f"/users/{user}", body, 409)["type"] == "/problems/user-erased"
    service.admin.post(f"/users/{user}/login-links", expect=409)
    service.admin.post("/tokens", {"user": user}, 409)


def test_the_last_administrator_stays(service: Service) -> None:
    user = service.admin.get("/me")["id"]
    service.admin.call("DELETE", f"/users/{user}", expect=409)


def test_a_command_erases_a_user_by_name(service: Service, database_url: str) -> None:
    user, _ = at_work(service)
    assert "deactivate the user before" in command(database_url, "user", "erase", NAME, status=2)
    command(database_url, "user", "deactivate", NAME)
    assert command(database_url, "user", "erase", NAME, "--dry-run") == (
        f"Would delete the name, 3 credentials, 1 comments and 1 reasons of user {user}. Without a name stay 1 answers "
        "(1 units)."
    )
    assert json.loads(command(database_url, "user", "erase", NAME, "--json"))["comments"] == 1
    assert "There is no user named" in command(database_url, "user", "erase", NAME, status=2)
    assert "(erased)" in command(database_url, "user", "list")
    new = service.user(NAME, "annotator")
    assert new.get("/me")["id"] != user


def test_the_comments_of_a_user_who_was_not_erased_cannot_be_removed(service: Service) -> None:
    at_work(service)
    with pytest.raises(Exception, match="append-only"):
        service.db.write_now(lambda tx: tx.conn.execute(text("DELETE FROM comments")))
