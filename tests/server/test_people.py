"""People and programs: one-time logins, sessions, tokens, and what each role may do."""

from typing import Any

import httpx2
import pytest

from server import people
from tests.server.kit import API, Service, in_process, query

SAME = {"Sec-Fetch-Site": "same-origin"}


def code_for(service: Service, name: str = "abe") -> str:
    user = service.db.read_now(lambda tx: people.named(tx, name))
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
    code = lite.db.write_now(lambda tx: people.create_login(tx, 1, 60)).code
    session = lite.db.write_now(lambda tx: people.redeem(tx, code, -1))
    assert session is not None
    lite.client.cookies.set("waypost_session", session.secret)
    assert lite.client.get(f"{API}/me").status_code == 401


def test_guessing_codes_is_slowed_down(sqlite_url: str) -> None:
    with in_process(sqlite_url, login_failures=3) as service:
        assert [log_in(service, f"guess{n}").status_code for n in range(5)] == [401, 401, 401, 429, 429]
        blocked = log_in(service, code_for(service))
        assert blocked.status_code == 429
        assert 1 <= int(blocked.headers["retry-after"]) <= 60


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


@pytest.mark.parametrize("headers", [SAME, {"Origin": "http://testserver"}])
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
