"""What is kept of tokens, links and sessions: when they were used, how long they last, and who did what with them."""

import asyncio
from typing import Any

import pytest
from sqlalchemy import select, update
from tests.server.kit import Caller, Json, Service

from waypost_server import errors
from waypost_server.auth import credentials, sessions, tokens
from waypost_server.auth.lookup import CACHE_SIZE, CredentialCache
from waypost_server.db import tables
from waypost_server.db.audit import Actor, moment


def row_of(service: Service, credential: int) -> Any:
    """A credential as it is stored."""
    chosen = select(tables.credentials).where(tables.credentials.c.id == credential)
    return service.db.read_now(lambda tx: tx.conn.execute(chosen).one())


def change(service: Service, credential: int, **values: Any) -> None:
    """Change a credential in the store."""
    changed = update(tables.credentials).where(tables.credentials.c.id == credential).values(values)
    service.db.write_now(lambda tx: tx.conn.execute(changed))


def last(service: Service, action: str) -> Json:
    """The newest row of the audit log with an action."""
    return next(row for row in service.admin.get("/audit")["rows"] if row["action"] == action)


def id_of(caller: Caller) -> int:
    return int(caller.get("/me")["id"])


def test_the_audit_log_says_which_token_was_made_for_whom_and_revoked(lite: Service) -> None:
    user, by = id_of(lite.annotator), Actor("ann", id_of(lite.admin), "192.0.2.1")
    made = lite.db.write_now(lambda tx: tokens.create_token(tx, user, "laptop", 2, ["read", "learn"], by=by))
    stored = row_of(lite, made.id)
    assert stored.expires_at - stored.created_at == pytest.approx(2 * 86_400)
    assert (stored.label, stored.kind, stored.user_id, stored.scopes) == ("laptop", "api", user, "learn read")
    row = last(lite, "token.created")
    known = {"user": user, "name": "abe", "label": "laptop"}
    assert row["details"] == known | {"expires": moment(stored.expires_at), "scopes": "learn read"}
    assert (row["actor"], row["address"], row["object"]) == ("ann", "192.0.2.1", f"token/{made.id}")
    lite.db.write_now(lambda tx: tokens.revoke_token(tx, made.id, by=by))
    row = last(lite, "token.revoked")
    assert row["details"] == known
    assert (row["actor"], row["address"], row["object"]) == ("ann", "192.0.2.1", f"token/{made.id}")
    n_rows = len(lite.admin.get("/audit")["rows"])
    lite.db.write_now(lambda tx: tokens.revoke_token(tx, made.id, by=by))
    assert len(lite.admin.get("/audit")["rows"]) == n_rows, "it was revoked before"


def test_the_audit_log_says_which_link_opened_which_session_and_how_it_ended(lite: Service) -> None:
    user, by = id_of(lite.annotator), Actor("ann", id_of(lite.admin), "192.0.2.1")
    own = Actor("abe", user, "192.0.2.2")
    link = lite.db.write_now(lambda tx: sessions.create_login_link(tx, user, 60, by))
    made = last(lite, "link.created")
    assert made["details"]["name"] == "abe"
    assert made["details"]["expires"] == moment(link.expires_at)
    assert (made["actor"], made["address"], made["object"]) == ("ann", "192.0.2.1", f"user/{user}")
    session = lite.db.write_now(lambda tx: sessions.redeem(tx, link.code, 600, "192.0.2.2"))
    assert session is not None
    assert (session.user, session.name) == (user, "abe")
    row = last(lite, "login")
    assert row["details"] == {"link": made["details"]["link"], "session": session.id}
    assert (row["actor"], row["address"], row["object"]) == ("abe", "192.0.2.2", f"user/{user}")
    lite.db.write_now(lambda tx: sessions.end_session(tx, session.id, own))
    row = last(lite, "logout")
    assert row["details"] == {"session": session.id}
    assert (row["actor"], row["address"], row["object"]) == ("abe", "192.0.2.2", f"user/{user}")
    n_rows = len(lite.admin.get("/audit")["rows"])
    lite.db.write_now(lambda tx: sessions.end_session(tx, session.id, own))
    lite.db.write_now(lambda tx: sessions.end_all_sessions(tx, user, own))
    assert len(lite.admin.get("/audit")["rows"]) == n_rows, "no session was left to end"
    opened(lite, user)
    opened(lite, user)
    lite.db.write_now(lambda tx: sessions.end_all_sessions(tx, user, own))
    row = last(lite, "logout")
    assert (row["details"], row["object"], row["actor"]) == ({"sessions": 2}, f"user/{user}", "abe")


def opened(service: Service, user: int, seconds: float = 1_000) -> credentials.Secret:
    """A new session of a user."""
    link = service.db.write_now(lambda tx: sessions.create_login_link(tx, user, 60))
    session = service.db.write_now(lambda tx: sessions.redeem(tx, link.code, seconds))
    assert session is not None
    return session


def test_a_session_is_extended_once_a_tenth_of_it_is_over_and_never_past_its_end(lite: Service) -> None:
    session = opened(lite, id_of(lite.annotator))
    began = row_of(lite, session.id).created_at

    def renewed(left: float, most: float = 10_000) -> tuple[bool, float]:
        now = lite.db.read_now(lambda tx: tx.now)
        change(lite, session.id, expires_at=now + left)
        was = lite.db.write_now(lambda tx: sessions.renew_session(tx, session.id, 1_000, most))
        return was, row_of(lite, session.id).expires_at - now

    assert renewed(920) == (False, pytest.approx(920, abs=5))
    assert renewed(880) == (True, pytest.approx(1_000, abs=5))
    assert renewed(500, most=700) == (True, pytest.approx(700, abs=5))
    assert row_of(lite, session.id).expires_at == pytest.approx(began + 700)
    assert renewed(800, most=700) == (False, pytest.approx(800, abs=5)), "it would be shortened"
    change(lite, session.id, revoked_at=began)
    assert renewed(500) == (False, pytest.approx(500, abs=5)), "it was ended"


def test_a_link_opens_one_session_and_none_after_its_end(lite: Service) -> None:
    user = id_of(lite.annotator)

    def session_of(code: str) -> credentials.Secret | None:
        return lite.db.write_now(lambda tx: sessions.redeem(tx, code, 600))

    links = lite.db.write_now(lambda tx: [sessions.create_login_link(tx, user, seconds) for seconds in (60, 0)])
    assert [session_of(link.code) is None for link in links] == [False, True]
    assert session_of(links[0].code) is None, "two browsers may have looked at it at once"


def test_extending_a_session_extends_no_other(lite: Service) -> None:
    user = id_of(lite.annotator)
    own, other = opened(lite, user, 500), opened(lite, user, 500)
    assert lite.db.write_now(lambda tx: sessions.renew_session(tx, own.id, 1_000, 10_000))
    assert row_of(lite, other.id).expires_at == other.expires_at


def test_a_session_is_not_revoked_as_a_token(lite: Service) -> None:
    session = opened(lite, id_of(lite.annotator))
    with pytest.raises(errors.NotFound):
        lite.db.write_now(lambda tx: tokens.revoke_token(tx, session.id))
    assert row_of(lite, session.id).revoked_at is None


def test_a_session_is_no_login_link(lite: Service) -> None:
    session = opened(lite, id_of(lite.annotator))
    assert lite.db.write_now(lambda tx: sessions.redeem(tx, session.secret, 60)) is None


def test_a_users_valid_sessions_are_listed_oldest_first(lite: Service) -> None:
    user, other = id_of(lite.annotator), id_of(lite.viewer)
    held = [opened(lite, user) for _ in range(4)]
    opened(lite, other)
    change(lite, held[1].id, revoked_at=1.0)
    change(lite, held[2].id, expires_at=1.0)
    change(lite, held[3].id, last_used_at=5.5)
    listed = lite.db.read_now(lambda tx: sessions.list_sessions(tx, user, held[3].id)).sessions
    assert [(one.id, one.current, one.last_used_at) for one in listed] == [
        (held[0].id, False, None),
        (held[3].id, True, 5.5),
    ]
    stored = row_of(lite, held[0].id)
    assert (listed[0].created_at, listed[0].expires_at) == (stored.created_at, stored.expires_at)


def test_tokens_are_listed_with_their_scopes(lite: Service) -> None:
    made = lite.annotator.post("/tokens", {"label": "narrow", "scopes": ["learn", "answer"], "days": 1}, 201)
    whole, narrow = lite.annotator.get("/me/tokens")["tokens"]
    stored = row_of(lite, made["id"])
    assert (whole["scopes"], whole["expires_at"]) == (None, None)
    assert narrow["scopes"] == ["answer", "learn"]
    assert (narrow["created_at"], narrow["expires_at"]) == (stored.created_at, stored.expires_at)
    with pytest.raises(errors.NotFound):
        lite.db.read_now(lambda tx: tokens.list_tokens(tx, 999))


def test_the_use_of_a_token_is_noted_once_a_minute(lite: Service) -> None:
    user = id_of(lite.annotator)
    made = lite.db.write_now(lambda tx: tokens.create_token(tx, user, "new"))
    hashed = credentials.hash_of(made.token)

    def is_stale() -> bool:
        found = lite.db.read_now(lambda tx: credentials.find(tx, hashed, "api"))
        assert found is not None
        return found.last_use_is_stale

    assert is_stale(), "it was never used"
    lite.db.write_now(lambda tx: credentials.record_use(tx, made.id))
    assert not is_stale()
    change(lite, made.id, last_used_at=row_of(lite, made.id).last_used_at - 61)
    assert is_stale()


@pytest.mark.parametrize(("state", "reason"), [("revoked", "revoked"), ("expired", "expired"), ("sent", "deactivated")])
def test_a_secret_that_is_refused_is_known_with_the_reason(lite: Service, state: str, reason: str) -> None:
    user = id_of(lite.annotator)
    made = lite.db.write_now(lambda tx: tokens.create_token(tx, user, "new"))
    change(lite, made.id, **({"revoked_at": 5.0} if state == "revoked" else {"expires_at": 5.0}))
    if state == "sent":
        lite.admin.change(lite.annotator, active=False)
    hashed = credentials.hash_of(made.token)
    assert lite.db.read_now(lambda tx: credentials.find(tx, hashed, "api")) is None
    rejected = lite.db.read_now(lambda tx: credentials.why_rejected(tx, hashed, "api"))
    assert rejected is not None
    assert (rejected.credential, rejected.user, rejected.name, rejected.reason) == (made.id, user, "abe", reason)
    assert lite.db.read_now(lambda tx: credentials.why_rejected(tx, hashed, "session")) is None
    if state == "sent":
        with pytest.raises(errors.NotActive):
            lite.db.write_now(lambda tx: credentials.issue(tx, user, "api"))


def test_only_a_session_of_an_administrator_says_that_one_has_logged_in(lite: Service) -> None:
    known = [lite.db.read_now(sessions.administrator_has_logged_in)]
    for caller in (lite.annotator, lite.admin):
        opened(lite, id_of(caller))
        known.append(lite.db.read_now(sessions.administrator_has_logged_in))
    assert known == [False, False, True]


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


def test_an_owner_is_remembered_for_a_second(lite: Service, clock: Clock) -> None:
    cache = CredentialCache(lite.db, clock)
    made = lite.db.write_now(lambda tx: tokens.create_token(tx, 1, "new"))

    def is_known(kind: credentials.CredentialKind = "api") -> bool:
        return asyncio.run(cache.find(made.token, kind)) is not None

    assert is_known()
    assert not is_known("session")
    assert row_of(lite, made.id).last_used_at is not None
    change(lite, made.id, revoked_at=1.0)
    clock.now += 0.9
    assert is_known(), "a revocation by another process takes a second"
    clock.now += 0.1
    assert not is_known()
    change(lite, made.id, revoked_at=None)
    assert is_known()
    change(lite, made.id, revoked_at=1.0)
    cache.clear()
    assert not is_known()


def test_many_owners_fill_no_memory(lite: Service, clock: Clock, monkeypatch: pytest.MonkeyPatch) -> None:
    assert CACHE_SIZE == 10_000
    monkeypatch.setattr("waypost_server.auth.lookup.CACHE_SIZE", 2)
    cache = CredentialCache(lite.db, clock)
    made = [lite.db.write_now(lambda tx: tokens.create_token(tx, 1, "new")) for _ in range(3)]

    def known() -> list[bool]:
        return [asyncio.run(cache.find(one.token, "api")) is not None for one in made]

    assert known() == [True] * 3
    for one in made:
        change(lite, one.id, revoked_at=1.0)
    assert known() == [False, False, True], "the third one made room for itself"
