"""People and programs: one-time logins, sessions, tokens, and what each role may do."""

import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import httpx2
import pytest
from sqlalchemy import text
from tests.server.kit import API, Caller, Service, in_process, query, together

from waypost_server.auth import sessions
from waypost_server.users import service as users

SAME = {"Sec-Fetch-Site": "same-origin"}


def code_for(service: Service, name: str = "abe") -> str:
    user = service.db.read_now(lambda tx: users.find_by_name(tx, name))
    return str(service.admin.post(f"/users/{user.id}/login-links", expect=201)["code"])


def log_in(service: Service, code: str, headers: dict[str, str] = SAME) -> httpx2.Response:
    return service.client.post(f"{API}/session", json={"code": code}, headers=headers)


def test_a_login_code_works_once(service: Service) -> None:
    code = code_for(service)
    first, second = log_in(service, code), log_in(service, code)
    assert (first.status_code, second.status_code) == (200, 401)
    assert (first.json()["name"], first.json()["role"]) == ("abe", "annotator")
    cookie = first.headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert "path=/" in cookie
    assert code.lower() not in cookie
    assert service.client.get(f"{API}/me").json()["name"] == "abe"


def test_a_session_ends_with_logout(service: Service) -> None:
    log_in(service, code_for(service))
    session = dict(service.client.cookies)
    assert service.client.delete(f"{API}/session", headers=SAME).status_code == 204
    service.client.cookies.update(session)
    assert service.client.get(f"{API}/me").status_code == 401


def test_a_login_code_grows_old(database_url: str) -> None:
    with in_process(database_url, link_seconds=0.001) as service:
        assert log_in(service, code_for(service)).status_code == 401


def test_a_session_grows_old(lite: Service) -> None:
    code = lite.db.write_now(lambda tx: sessions.create_login_link(tx, 1, 60)).code
    session = lite.db.write_now(lambda tx: sessions.redeem(tx, code, -1))
    assert session is not None
    lite.client.cookies.set("waypost_session", session.secret)
    assert lite.client.get(f"{API}/me").status_code == 401


def test_a_secret_of_one_kind_is_no_secret_of_another(service: Service) -> None:
    code = code_for(service)
    as_token = service.client.get(f"{API}/me", headers={"Authorization": f"Bearer {code}"})
    assert as_token.status_code == 401
    assert as_token.headers["www-authenticate"] == "Bearer"
    assert log_in(service, service.annotator.token).status_code == 401
    service.client.cookies.set("waypost_session", service.annotator.token)
    assert service.client.get(f"{API}/me").status_code == 401


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"Sec-Fetch-Site": "cross-site"},
        {"Sec-Fetch-Site": "same-site"},
        {"Origin": "https://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://testserver.evil.example"},
        {"Origin": "http://testserver:8080"},
    ],
)
def test_a_cookie_used_from_another_page_is_refused(lite: Service, headers: dict[str, str]) -> None:
    log_in(lite, code_for(lite, "ann"))
    for method, path in (("POST", "/assignments"), ("DELETE", "/session"), ("PATCH", "/runs/000000000000")):
        body = None if method == "DELETE" else {}
        reply = lite.client.request(method, API + path, json=body, headers=headers)
        assert reply.status_code == 403, reply.text
        assert reply.json()["type"] == "/problems/cross-site"
    assert lite.client.get(f"{API}/me", headers=headers).status_code == 200


@pytest.mark.parametrize("headers", [SAME, {"Sec-Fetch-Site": "none"}, {"Origin": "http://testserver"}])
def test_a_cookie_used_from_the_page_itself_works(lite: Service, headers: dict[str, str]) -> None:
    log_in(lite, code_for(lite))
    assert lite.client.post(f"{API}/assignments", json={}, headers=headers).status_code == 204


def test_a_login_from_another_page_is_refused(lite: Service) -> None:
    assert log_in(lite, code_for(lite), {"Origin": "https://evil.example"}).status_code == 403


def test_a_revoked_token_is_refused_at_once(service: Service) -> None:
    user = service.admin.post("/users", {"name": "zoe", "role": "viewer"}, 201)
    token = service.admin.post("/tokens", {"user": user["id"], "label": "x"}, 201)
    assert token["token"].startswith("wp_")
    headers = {"Authorization": f"Bearer {token['token']}"}
    assert service.client.get(f"{API}/me", headers=headers).status_code == 200
    service.admin.call("DELETE", f"/tokens/{token['id']}", expect=204)
    assert service.client.get(f"{API}/me", headers=headers).status_code == 401
    service.admin.call("DELETE", "/tokens/999", expect=404)


def test_no_secret_is_in_the_store(service: Service) -> None:
    code = code_for(service)
    stored = service.db.read_now(lambda tx: str(tx.conn.exec_driver_sql("SELECT * FROM credentials").all()))
    for secret in (code, service.admin.token, service.viewer.token):
        assert secret not in stored
        assert secret.removeprefix("wp_") not in stored


def test_users_are_created_and_listed_and_names_are_unique(service: Service) -> None:
    service.admin.post("/users", {"name": "zoe", "role": "viewer"}, 201)
    assert service.admin.post("/users", {"name": "zoe", "role": "admin"}, 409)["type"] == "/problems/name-taken"
    assert "zoe" in [user["name"] for user in service.admin.get("/users")["users"]]
    service.admin.post("/users", {"name": "root", "role": "emperor"}, 422)
    service.admin.post("/tokens", {"user": 999}, 404)
    service.admin.post("/users/999/login-links", expect=404)


def test_me_says_who_holds_queries(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(3)))
    held = [service.annotator.lease(), service.annotator.lease()]
    service.admin.lease()
    me = service.annotator.get("/me")
    assert (me["held"], me["held_by_others"]) == (2, 1)
    assert 0 < me["held_seconds"] <= held[0]["lease_seconds"]
    for one in held:
        service.annotator.release(one)
    me = service.annotator.get("/me")
    assert (me["held"], me["held_seconds"], me["held_by_others"]) == (0, None, 1)


def test_me_says_what_was_answered(service: Service) -> None:
    me = service.annotator.get("/me")
    assert (me["answers"], me["median_seconds"], me["units"]) == (0, None, 0)
    service.learner.ask(service.learner.create_run(), query("label_lo"), query(ordinal=1))
    held = service.annotator.lease()
    service.annotator.answer(held)
    other = service.annotator.lease()
    service.annotator.answer(other)
    service.annotator.retract(other)
    me = service.annotator.get("/me")
    assert (me["answers"], me["answers_today"], me["units"]) == (1, 1, 3)
    assert me["median_seconds"] > 0


def test_broken_credentials_are_refused_not_crashed_on(lite: Service) -> None:
    broken: list[dict[str, Any]] = [
        {"Authorization": "Bearer"},
        {"Authorization": "Bearer "},
        {"Authorization": "Basic YTpi"},
        {"Authorization": b"Bearer \xff\xfe"},
        {"Cookie": "waypost_session="},
        {"Cookie": b"waypost_session=\xff"},
        {"Authorization": "Bearer " + "x" * 5_000},
    ]
    for headers in broken:
        assert lite.client.get(f"{API}/me", headers=headers).status_code == 401


def id_of(service: Service, name: str) -> int:
    return service.db.read_now(lambda tx: users.find_by_name(tx, name)).id


@pytest.mark.parametrize(
    ("spoil", "problem"),
    [("nothing", "unauthenticated"), ("use", "login-used"), ("deactivate", "deactivated"), ("wait", "login-expired")],
)
def test_a_login_link_that_does_not_work_says_why(lite: Service, spoil: str, problem: str) -> None:
    code = code_for(lite)
    if spoil == "nothing":
        code = code[:-1]
    elif spoil == "use":
        log_in(lite, code)
    elif spoil == "deactivate":
        lite.admin.call("PATCH", f"/users/{id_of(lite, 'abe')}", {"active": False})
    else:
        code = lite.db.write_now(lambda tx: sessions.create_login_link(tx, 1, -1)).code
    refused = log_in(lite, code)
    assert (refused.status_code, refused.json()["type"]) == (401, f"/problems/{problem}")
    assert code not in refused.text


def test_an_administrator_chooses_how_long_a_link_is_good(lite: Service) -> None:
    path = f"/users/{id_of(lite, 'abe')}/login-links"
    usual, long = (lite.admin.post(path, body, 201)["expires_at"] for body in (None, {"seconds": 86_400}))
    assert 86_400 - 900 - 60 < long - usual < 86_400 - 900 + 60
    lite.admin.post(path, {"seconds": 8 * 86_400}, 422)


def test_a_session_lives_on_while_it_is_used(sqlite_url: str) -> None:
    with in_process(sqlite_url, session_seconds=1_000) as service:
        log_in(service, code_for(service))
        assert "set-cookie" not in service.client.get(f"{API}/me").headers, "it is new"
        service.db.write_now(
            lambda tx: tx.conn.exec_driver_sql(
                "UPDATE credentials SET expires_at = expires_at - 500 WHERE kind = 'session'"
            )
        )
        left = service.client.get(f"{API}/me/sessions").json()["sessions"][0]
        renewed = service.client.get(f"{API}/me")
        assert "Max-Age=1000" in renewed.headers["set-cookie"]
        now = service.client.get(f"{API}/me/sessions").json()["sessions"][0]
        assert now["expires_at"] - left["expires_at"] == pytest.approx(500, abs=60)
        assert now["current"]


def test_a_session_ends_however_often_it_is_used(sqlite_url: str) -> None:
    with in_process(sqlite_url, session_seconds=1_000, session_max_seconds=1_200) as service:
        log_in(service, code_for(service))
        for passed, left in ((500, 700), (500, 200)):
            service.db.write_now(
                lambda tx, passed=passed: tx.conn.exec_driver_sql(
                    f"UPDATE credentials SET expires_at = expires_at - {passed}, created_at = created_at - {passed} "
                    "WHERE kind = 'session'"
                )
            )
            assert service.client.get(f"{API}/me").status_code == 200
            (session,) = service.client.get(f"{API}/me/sessions").json()["sessions"]
            assert session["expires_at"] - time.time() == pytest.approx(left, abs=60)


@pytest.mark.parametrize("secure", [False, True])
def test_over_https_only_this_host_can_set_the_cookie(sqlite_url: str, secure: bool) -> None:
    name, other = "__Host-waypost_session", "waypost_session"
    if not secure:
        name, other = other, name
    with in_process(sqlite_url, secure_cookies=secure) as service:
        cookie = log_in(service, code_for(service)).headers["set-cookie"]
        assert cookie.startswith(f"{name}=")
        assert {"HttpOnly", "Path=/", "SameSite=strict"} <= set(cookie.split("; "))
        assert ("Secure" in cookie.split("; ")) == secure
        assert "Domain" not in cookie
        secret = cookie.split("=", 1)[1].split(";")[0]
        service.client.cookies.clear()
        for sent, status in ((name, 200), (other, 401)):
            assert service.client.get(f"{API}/me", headers={"Cookie": f"{sent}={secret}"}).status_code == status
        out = service.client.delete(f"{API}/session", headers=SAME | {"Cookie": f"{name}={secret}"})
        assert out.headers["set-cookie"].startswith(f'{name}="";')
        assert ("Secure" in out.headers["set-cookie"]) == secure


def test_a_token_can_expire(service: Service) -> None:
    made = service.admin.post("/tokens", {"label": "for a week", "days": 7}, 201)
    (token,) = [one for one in service.admin.get("/me/tokens")["tokens"] if one["label"] == "for a week"]
    assert token["expires_at"] - token["created_at"] == pytest.approx(7 * 86_400)
    headers = {"Authorization": f"Bearer {made['token']}"}
    assert service.client.get(f"{API}/me", headers=headers).status_code == 200
    service.db.write_now(
        lambda tx: tx.conn.execute(
            text("UPDATE credentials SET expires_at = :now WHERE label = 'for a week'"), {"now": tx.now}
        )
    )
    time.sleep(1.1)  # a server caches credentials for a second
    assert service.client.get(f"{API}/me", headers=headers).status_code == 401
    made = service.admin.post("/tokens", {"label": "a week again", "days": 7}, 201)
    week = {"Authorization": f"Bearer {made['token']}"}
    for label, days, lasts in (("child", None, 7), ("long", 30, 7), ("short", 1, 1)):
        service.client.post(f"{API}/tokens", json={"label": label, "days": days}, headers=week)
        (token,) = [one for one in service.admin.get("/me/tokens")["tokens"] if one["label"] == label]
        assert token["expires_at"] - token["created_at"] == pytest.approx(lasts * 86_400, abs=60)
    for days in (0, -1, 4_000):
        service.admin.post("/tokens", {"days": days}, 422)


def test_logging_out_everywhere_ends_every_browser_and_no_token(service: Service) -> None:
    log_in(service, code_for(service))
    first = dict(service.client.cookies)
    service.client.cookies.clear()
    log_in(service, code_for(service))
    assert len(service.client.get(f"{API}/me/sessions").json()["sessions"]) == 2
    assert service.client.delete(f"{API}/me/sessions", headers=SAME).status_code == 204
    for session in (first, dict(service.client.cookies)):
        service.client.cookies.clear()
        service.client.cookies.update(session)
        assert service.client.get(f"{API}/me").status_code == 401
    service.client.cookies.clear()
    assert service.annotator.get("/me")["name"] == "abe"


def test_who_is_deactivated_is_out_at_once_and_their_answers_stay(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1), query(ordinal=2))
    service.annotator.answer(service.annotator.lease())
    held = service.annotator.lease()
    abe = id_of(service, "abe")
    code = code_for(service)
    log_in(service, code_for(service))
    changed = service.admin.call("PATCH", f"/users/{abe}", {"active": False})
    assert changed["deactivated_at"] is not None
    assert service.client.get(f"{API}/me").status_code == 401
    service.annotator.get("/me", 401)
    service.annotator.answer(held, expect=401)
    assert log_in(service, code).status_code == 401
    assert service.admin.lease()["query"]["id"] == held["query"]["id"], "it is free again"
    assert service.admin.get(f"/users/{abe}/numbers")["total"]["answers"] == 1
    for path, body in ((f"/users/{abe}/login-links", None), ("/tokens", {"user": abe})):
        assert service.admin.post(path, body, 409)["type"] == "/problems/not-active"
    back = service.admin.call("PATCH", f"/users/{abe}", {"active": True})
    assert back["deactivated_at"] is None
    service.annotator.get("/me", 401)  # what was ended stays so
    service.client.cookies.clear()
    assert log_in(service, code_for(service)).status_code == 200


@pytest.mark.parametrize(("role", "given_back"), [("viewer", True), ("learner", True), ("admin", False)])
def test_who_may_no_longer_answer_gives_their_leases_back(service: Service, role: str, given_back: bool) -> None:
    service.learner.ask(service.learner.create_run(), query())
    held = service.annotator.lease()
    assert service.admin.call("PATCH", f"/users/{id_of(service, 'abe')}", {"role": role})["role"] == role
    service.admin.lease(201 if given_back else 204)
    service.annotator.answer(held, expect=403 if given_back else 200)


def test_somebody_who_waits_for_work_while_deactivated_gets_none(lite: Service) -> None:
    with ThreadPoolExecutor() as pool:
        waiting = pool.submit(lite.annotator.lease, 401, wait=30)
        time.sleep(0.3)
        lite.admin.call("PATCH", f"/users/{id_of(lite, 'abe')}", {"active": False})
        lite.learner.ask(lite.learner.create_run(), query())
        waiting.result()


@pytest.mark.parametrize("change", [{"active": False}, {"role": "viewer"}, {"role": "annotator", "active": False}])
def test_the_last_administrator_stays(service: Service, change: dict[str, Any]) -> None:
    ann = id_of(service, "ann")
    refused = service.admin.call("PATCH", f"/users/{ann}", change, 409)
    assert refused["type"] == "/problems/last-administrator"
    second = service.user("eve", "admin")
    service.admin.call("PATCH", f"/users/{ann}", change)
    second.call("PATCH", f"/users/{id_of(service, 'eve')}", change, 409)


def test_two_administrators_cannot_send_each_other_away(database_url: str) -> None:
    with in_process(database_url) as service:
        pair = [service.admin, service.user("eve", "admin")]
        ids = [id_of(service, caller.name) for caller in pair]

        def send_away(number: int) -> int:
            reply = service.client.patch(
                f"{API}/users/{ids[1 - number]}", json={"active": False}, headers=pair[number].headers
            )
            return reply.status_code

        statuses = together(send_away, 2)
        assert statuses.count(200) == 1, statuses
        assert [user["role"] for user in pair[statuses.index(200)].get("/users")["users"] if not user["deactivated_at"]]


# Whose token a caller may make and revoke.
@pytest.mark.parametrize(
    ("caller", "owner", "made", "revoked"),
    [
        ("annotator", "annotator", 201, 204),
        ("viewer", "viewer", 201, 204),
        ("learner", "annotator", 403, 404),
        ("viewer", "admin", 403, 404),
        ("admin", "viewer", 201, 204),
    ],
)
def test_a_token_is_made_and_revoked_by_its_owner_or_an_administrator(
    lite: Service, caller: str, owner: str, made: int, revoked: int
) -> None:
    who, whose = getattr(lite, caller), getattr(lite, owner)
    user = id_of(lite, whose.name)
    who.post("/tokens", {"user": user, "label": "x"}, made)
    token = lite.admin.post("/tokens", {"user": user, "label": "theirs"}, 201)
    who.call("DELETE", f"/tokens/{token['id']}", expect=revoked)
    reply = lite.client.get(f"{API}/me", headers={"Authorization": f"Bearer {token['token']}"})
    assert reply.status_code == (401 if revoked == 204 else 200)


def test_tokens_are_listed_without_their_secrets(service: Service) -> None:
    made = service.annotator.post("/tokens", {"label": "laptop"}, 201)
    listed = service.annotator.get("/me/tokens")["tokens"]
    assert [(token["label"], token["last_used_at"] is None) for token in listed] == [("test", False), ("laptop", True)]
    mine = Caller(service.client, "abe", made["token"])
    mine.get("/me")
    assert service.admin.get(f"/users/{id_of(service, 'abe')}/tokens")["tokens"][1]["last_used_at"] is not None
    assert made["token"].removeprefix("wp_") not in str(listed)
    service.annotator.call("DELETE", f"/tokens/{made['id']}", expect=204)
    assert len(service.annotator.get("/me/tokens")["tokens"]) == 1
