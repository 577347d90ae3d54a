"""Sign-in at an OpenID provider: what lets somebody in, what keeps them out, and what the audit log says of it."""

import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl, urlsplit

import httpx2
import pytest
from joserfc.jwk import OctKey
from sqlalchemy import select
from tests.server.auth.provider import CLIENT, SECRET, FakeProvider, new_key, provider
from tests.server.kit import API, Json, Service, in_process, query, together
from typer.testing import CliRunner

from waypost_server.app import create_app
from waypost_server.auth import oidc
from waypost_server.cli.main import app as commands
from waypost_server.db.tables import identities
from waypost_server.settings import Settings
from waypost_server.users import service as users
from waypost_server.users import sign_in

SAME = {"Sec-Fetch-Site": "same-origin"}
ROLES = "waypost-admins=admin, labelers=annotator"


@pytest.fixture
def fake() -> Iterator[FakeProvider]:
    with provider() as fake:
        yield fake


@pytest.fixture
def serve(sqlite_url: str, fake: FakeProvider) -> Iterator[Callable[..., Service]]:
    """Start a service with settings of the provider."""
    with_all = []

    def start(url: str = sqlite_url, **settings: Any) -> Service:
        usual = {"oidc_issuer": fake.issuer, "oidc_client_secret": SECRET, "oidc_create": True}
        one = in_process(url, **usual | settings)
        with_all.append(one)
        return one.__enter__()

    yield start
    for one in reversed(with_all):
        one.__exit__(None, None, None)


def begin(service: Service) -> str:
    """Begin a sign-in; return the provider's address."""
    reply = service.client.post(f"{API}/sign-in", headers=SAME)
    assert reply.status_code == 200, reply.text
    return str(reply.json()["url"])


def at_the_provider(url: str) -> Json:
    """Open the provider's address as a browser does; return the parameters with which it sends the browser back."""
    reply = httpx2.get(url)
    assert reply.status_code == 302
    back = urlsplit(reply.headers["location"])
    assert (back.netloc, back.path) == ("testserver", "/login")
    return dict(parse_qsl(back.query))


def end(service: Service, back: Json, **more: str) -> httpx2.Response:
    """Do what the login page does with the parameters."""
    body = {"state": back["state"], "code": back.get("code"), "issuer": back.get("iss")} | more
    return service.client.post(f"{API}/sign-in/reply", json=body, headers=SAME)


def sign(service: Service) -> httpx2.Response:
    """Sign in."""
    return end(service, at_the_provider(begin(service)))


def signed(service: Service) -> Json:
    """Sign in, which must succeed; return the user."""
    reply = sign(service)
    assert reply.status_code == 200, reply.text
    return dict(reply.json())


def refused(reply: httpx2.Response, name: str, status: int = 401) -> Json:
    """Return the problem document of a refusal with this name."""
    assert (reply.status_code, reply.headers["content-type"]) == (status, "application/problem+json"), reply.text
    assert reply.json()["type"] == f"/problems/{name}"
    assert "waypost_session" not in reply.headers.get("set-cookie", "")
    return dict(reply.json())


def log_of(service: Service) -> list[Json]:
    reply = service.client.get(f"{API}/audit/export?format=jsonl", headers=service.admin.headers)
    return [json.loads(line) for line in reply.text.splitlines()]


def names(service: Service) -> dict[str, str]:
    return {user.name: user.role for user in service.db.read_now(users.list_users).users}


def test_somebody_signs_in_and_is_the_same_user_each_time(serve: Callable[..., Service], database_url: str) -> None:
    service = serve(database_url)
    me = signed(service)
    assert (me["name"], me["role"]) == ("zoe", "annotator")
    assert service.client.get(f"{API}/me").json()["id"] == me["id"]
    assert service.client.delete(f"{API}/session", headers=SAME).status_code == 204
    assert service.client.get(f"{API}/me").status_code == 401
    assert signed(service)["id"] == me["id"]
    rows = log_of(service)[-5:]
    assert [(row["action"], row["actor"]) for row in rows] == [
        ("user.created", "identity provider"),
        ("user.identified", "identity provider"),
        ("login", "zoe"),
        ("logout", "zoe"),
        ("login", "zoe"),
    ]
    assert {row["object"] for row in rows} == {f"user/{me['id']}"}
    assert all(row["address"] == "testclient" for row in rows)


def test_the_browser_goes_to_the_provider_with_a_challenge_a_state_and_a_nonce(
    serve: Callable[..., Service], fake: FakeProvider
) -> None:
    service = serve()
    first, second = (dict(parse_qsl(urlsplit(begin(service)).query)) for _ in range(2))
    assert first["response_type"] == "code"
    assert first["code_challenge_method"] == "S256"
    assert first["redirect_uri"] == "http://testserver/login"
    assert set(first["scope"].split()) == {"openid", "profile"}
    for name in ("state", "nonce", "code_challenge"):
        assert len(first[name]) >= 20
        assert first[name] != second[name]


def test_behind_https_both_cookies_are_of_this_host_alone(serve: Callable[..., Service]) -> None:
    service = serve(secure_cookies=True)
    service.client.base_url = httpx2.URL("https://testserver")
    begun = service.client.post(f"{API}/sign-in", headers=SAME)
    assert begun.headers["set-cookie"].startswith("__Host-waypost_sign_in=")
    for word in ("HttpOnly", "Secure", "SameSite=strict", "Path=/", "Max-Age=600"):
        assert word in begun.headers["set-cookie"]
    back = at_the_provider(begun.json()["url"])
    cookies = end(service, back).headers.get_list("set-cookie")
    assert any(one.startswith("__Host-waypost_session=wp_") for one in cookies)
    assert any(one.startswith('__Host-waypost_sign_in=""') for one in cookies)


FORGERIES: dict[str, Callable[[FakeProvider], object]] = {
    "another nonce": lambda fake: fake.claims.update(nonce="n" * 20),
    "no nonce": lambda fake: fake.claims.update(nonce=None),
    "another audience": lambda fake: fake.claims.update(aud="others"),
    "another audience that we are authorized for": lambda fake: fake.claims.update(aud=["others"], azp=CLIENT),
    "no audience": lambda fake: fake.claims.update(aud=None),
    "an audience with others, for another": lambda fake: fake.claims.update(aud=[CLIENT, "others"], azp="others"),
    "another issuer": lambda fake: fake.claims.update(iss="https://evil.example"),
    "no issuer": lambda fake: fake.claims.update(iss=None),
    "expired": lambda fake: fake.claims.update(exp=int(time.time()) - 61),
    "without an end": lambda fake: fake.claims.update(exp=None),
    "not yet valid": lambda fake: fake.claims.update(nbf=int(time.time()) + 120),
    "no subject": lambda fake: fake.claims.update(sub=None),
    "an empty subject": lambda fake: fake.claims.update(sub=""),
    "a subject that is no text": lambda fake: fake.claims.update(sub=7),
    "another key": lambda fake: setattr(fake, "signs_with", new_key()),
    "the secret as a key": lambda fake: (
        setattr(fake, "signs_with", OctKey.import_key(SECRET * 4)),
        setattr(fake, "algorithm", "HS256"),
        fake.metadata.update(id_token_signing_alg_values_supported=["RS256", "HS256"]),
    ),
    "no signature": lambda fake: (
        setattr(fake, "algorithm", "none"),
        fake.metadata.update(id_token_signing_alg_values_supported=["RS256", "none"]),
    ),
    "another verifier": lambda fake: setattr(fake, "verifier", "v" * 48),
    "no token": lambda fake: setattr(fake, "id_token", lambda nonce: None),
    "nonsense as a token": lambda fake: setattr(fake, "id_token", lambda nonce: "nonsense"),
    "a refused person": lambda fake: setattr(fake, "refuses", "access_denied"),
}


@pytest.mark.parametrize("forgery", FORGERIES)
def test_no_forgery_signs_anybody_in(serve: Callable[..., Service], fake: FakeProvider, forgery: str) -> None:
    service = serve()
    FORGERIES[forgery](fake)
    before = names(service)
    said = refused(sign(service), "sign-in-failed")
    assert "tell an administrator" in said["detail"]
    assert names(service) == before
    row = log_of(service)[-1]
    assert (row["action"], row["actor"], row["object"]) == ("login.refused", "nobody", None)
    assert row["details"]["by"] == "provider"
    assert row["details"]["issuer"] == fake.issuer
    assert row["details"]["reason"] == "sign-in-failed"
    assert row["details"]["fault"]


def test_clocks_may_differ_by_less_than_a_minute(serve: Callable[..., Service], fake: FakeProvider) -> None:
    fake.claims["exp"] = int(time.time()) - 30
    signed(serve())


def test_a_reply_belongs_to_the_browser_that_began(serve: Callable[..., Service]) -> None:
    service = serve()
    stolen = at_the_provider(begin(service))
    refused(end(service, stolen, state="x" * 30), "sign-in-stale")
    service.client.cookies.clear()
    refused(end(service, stolen), "sign-in-stale")
    begin(service)
    refused(end(service, stolen), "sign-in-stale")
    service.client.cookies.clear()
    for forged in ("", "..verifier", ".nonce.", ".."):  # without a nonce, none would be checked
        service.client.cookies.set("waypost_sign_in", f"{stolen['state']}{forged}")
        refused(end(service, stolen), "sign-in-stale")
        service.client.cookies.clear()
    row = log_of(service)[-1]
    assert (row["action"], row["details"]["reason"]) == ("login.refused", "sign-in-stale")


def test_a_reply_of_another_provider_is_refused(serve: Callable[..., Service]) -> None:
    service = serve()
    back = at_the_provider(begin(service))
    refused(end(service, back | {"iss": "https://evil.example"}), "sign-in-failed")


def test_a_code_works_once(serve: Callable[..., Service]) -> None:
    service = serve()
    back = at_the_provider(begin(service))
    kept = service.client.cookies["waypost_sign_in"]
    assert end(service, back).status_code == 200
    assert "waypost_sign_in" not in service.client.cookies
    refused(end(service, back), "sign-in-stale")
    service.client.cookies.set("waypost_sign_in", kept)
    assert "invalid_grant" in refused(end(service, back), "sign-in-failed")["detail"]


def test_another_site_can_neither_begin_nor_end_a_sign_in(serve: Callable[..., Service]) -> None:
    service = serve()
    back = at_the_provider(begin(service))
    cross = {"Sec-Fetch-Site": "cross-site"}
    refused(service.client.post(f"{API}/sign-in", headers=cross), "cross-site", 403)
    body = {"state": back["state"], "code": back["code"]}
    refused(service.client.post(f"{API}/sign-in/reply", json=body, headers=cross), "cross-site", 403)


def test_a_provider_that_is_down_is_a_failure_that_passes(
    sqlite_url: str, serve: Callable[..., Service], fake: FakeProvider, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(oidc, "FRESH_SECONDS", 0.0)
    service = serve()
    back = at_the_provider(begin(service))
    fake.metadata["token_endpoint"] = "http://127.0.0.1:9/token"
    refused(end(service, back), "provider-failed", 502)
    del fake.metadata["token_endpoint"]
    assert end(service, back).status_code == 200, "the same reply can be sent again"
    fake.metadata["issuer"] = "https://evil.example"
    assert "later" in refused(service.client.post(f"{API}/sign-in", headers=SAME), "provider-failed", 502)["detail"]
    nowhere = serve(oidc_issuer="http://127.0.0.1:9/realm")
    refused(nowhere.client.post(f"{API}/sign-in", headers=SAME), "provider-failed", 502)
    assert nowhere.client.get(f"{API}/sign-in").json() == {"provider": "single sign-on"}


def test_a_new_key_of_the_provider_is_accepted_at_once(serve: Callable[..., Service], fake: FakeProvider) -> None:
    service = serve()
    signed(service)
    fake.key = new_key()
    signed(service)


def test_a_withdrawn_key_is_refused_as_soon_as_the_keys_are_read_again(
    serve: Callable[..., Service], fake: FakeProvider, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(oidc, "FRESH_SECONDS", 0.0)
    service = serve()
    signed(service)
    fake.signs_with, fake.kid, fake.key = fake.key, fake.key.kid, new_key()
    refused(sign(service), "sign-in-failed")


@pytest.mark.parametrize(
    ("way", "secret"), [("client_secret_post", SECRET), ("client_secret_basic", SECRET), ("none", None)]
)
def test_the_server_says_who_it_is_as_the_provider_wants_it(
    serve: Callable[..., Service], fake: FakeProvider, way: str, secret: str | None, tmp_path: Path
) -> None:
    fake.auth = way
    file = tmp_path / "secret"
    file.write_text(f"{secret}\n")
    given = {} if secret is None else {"oidc_client_secret_file": file}
    signed(serve(oidc_client_secret=None, **given))


def test_roles_follow_the_claims_at_each_sign_in(serve: Callable[..., Service], fake: FakeProvider) -> None:
    service = serve(oidc_roles=ROLES, oidc_role_claim="realm_access.roles")
    fake.claims["realm_access"] = {"roles": ["offline_access", "labelers"]}
    me = signed(service)
    assert me["role"] == "annotator"
    fake.claims["realm_access"] = {"roles": ["labelers", "waypost-admins"]}
    assert signed(service)["role"] == "admin", "the first of the setting that is claimed"
    (row,) = [row for row in log_of(service) if row["action"] == "user.role_changed"]
    assert (row["actor"], row["user"], row["object"]) == ("identity provider", None, f"user/{me['id']}")
    assert row["details"].items() >= {"from": "annotator", "to": "admin"}.items()
    fake.claims["realm_access"] = {"roles": ["waypost-admins2"]}
    assert "'realm_access.roles'" in refused(sign(service), "no-role")["detail"]
    assert log_of(service)[-1]["details"].items() >= {"reason": "no-role", "subject": "u-1"}.items()
    assert service.db.read_now(lambda tx: users.view(tx, me["id"])).role == "admin", "a refusal changes nothing"


def test_a_role_that_may_not_answer_releases_leases(serve: Callable[..., Service], fake: FakeProvider) -> None:
    service = serve(oidc_roles="labelers=annotator, *=viewer", oidc_role_claim="groups")
    fake.claims["groups"] = "labelers"
    signed(service)
    run = service.learner.create_run()
    service.learner.ask(run, query())
    lease = service.client.post(f"{API}/assignments", json={}, headers=SAME)
    assert lease.status_code == 201
    fake.claims["groups"] = ["others"]
    assert signed(service)["role"] == "viewer"
    assert service.annotator.lease()["query"]["id"] == lease.json()["query"]["id"]


def test_the_last_administrator_stays_one(serve: Callable[..., Service], fake: FakeProvider) -> None:
    service = serve(oidc_roles=ROLES, oidc_role_claim="groups")
    fake.claims["groups"] = ["waypost-admins"]
    zoe = signed(service)["id"]
    service.admin.call("PATCH", f"/users/{service.admin.get('/me')['id']}", {"role": "viewer"})
    fake.claims["groups"] = ["labelers"]
    assert signed(service)["role"] == "admin"
    assert service.db.read_now(lambda tx: users.view(tx, zoe)).role == "admin"
    reply = service.client.get(f"{API}/audit/export?format=jsonl")
    assert json.loads(reply.text.splitlines()[-1])["details"]["kept"] == "admin"


def test_roles_stay_as_they_are_in_waypost_without_a_mapping(serve: Callable[..., Service], fake: FakeProvider) -> None:
    service = serve()
    fake.claims["roles"] = ["admin"]
    me = signed(service)
    assert me["role"] == "annotator"
    service.admin.call("PATCH", f"/users/{me['id']}", {"role": "learner"})
    assert signed(service)["role"] == "learner"


def test_a_name_or_an_address_makes_nobody_somebody_else(serve: Callable[..., Service], fake: FakeProvider) -> None:
    service = serve()
    fake.claims |= {"preferred_username": "ann", "email": "ann", "email_verified": True}
    assert signed(service)["name"] == "ann 2"
    fake.claims["sub"] = "u-2"
    assert signed(service)["name"] == "ann 3"
    assert names(service)["ann"] == "admin"


@pytest.mark.parametrize(
    ("claims", "name"),
    [
        ({"preferred_username": " z\x00oe\n "}, "zoe"),
        ({"preferred_username": "\x1b"}, "somebody"),
        ({"preferred_username": None, "name": "Zoe Z."}, "Zoe Z."),
        ({"preferred_username": 5, "name": "", "email": "zoe@example.org"}, "zoe@example.org"),
        ({"preferred_username": None}, "u-1"),
        ({"preferred_username": "z" * 300}, "z" * 90),
    ],
)
def test_a_new_user_has_a_name_that_users_may_have(
    serve: Callable[..., Service], fake: FakeProvider, claims: Json, name: str
) -> None:
    fake.claims |= claims
    assert signed(serve())["name"] == name


def test_the_same_subject_of_another_provider_is_somebody_else() -> None:
    one = sign_in.identity_of("https://a.example", "1")
    assert one == sign_in.identity_of("https://a.example", "1")
    assert one != sign_in.identity_of("https://b.example", "1")
    assert one != sign_in.identity_of("https://a.example", "2")


def test_a_deactivated_or_erased_user_stays_out(serve: Callable[..., Service]) -> None:
    service = serve()
    me = signed(service)
    service.admin.call("PATCH", f"/users/{me['id']}", {"active": False})
    refused(sign(service), "deactivated")
    assert log_of(service)[-1]["details"].items() >= {"reason": "deactivated", "subject": "u-1"}.items()
    service.admin.call("DELETE", f"/users/{me['id']}")
    before = names(service)
    refused(sign(service), "deactivated")
    assert names(service) == before


def test_the_store_holds_no_subject_in_clear_text(serve: Callable[..., Service], fake: FakeProvider) -> None:
    service = serve()
    me = signed(service)
    rows = service.db.read_now(lambda tx: tx.conn.execute(select(identities)).all())
    assert [(row.hash, row.user_id) for row in rows] == [(sign_in.identity_of(fake.issuer, "u-1"), me["id"])]


def test_somebody_unknown_stays_out_where_users_are_not_created(
    serve: Callable[..., Service], fake: FakeProvider
) -> None:
    service = serve(oidc_create=Settings().oidc_create)
    before = names(service)
    refused(sign(service), "no-account")
    assert names(service) == before
    row = log_of(service)[-1]
    assert row["details"]["subject"] == "u-1", "with it, an administrator can let the person in"
    abe = service.annotator.get("/me")["id"]
    service.db.write_now(lambda tx: sign_in.identify(tx, abe, fake.issuer, row["details"]["subject"]))
    assert signed(service)["name"] == "abe"


def test_two_browsers_of_a_new_person_at_once_make_one_user(service: Service) -> None:
    person, rules = oidc.Person("https://a.example", "1", "zoe", None), sign_in.Rules(True, 60.0)
    made = together(lambda _: service.db.write_now(lambda tx: sign_in.sign_in(tx, person, rules)), 8)
    assert len({one.user for one in made}) == 1
    assert len({one.id for one in made}) == 8
    assert [name for name in names(service) if name.startswith("zoe")] == ["zoe"]
    created = [row for row in log_of(service) if row["action"] == "user.created" and row["details"]["name"] == "zoe"]
    assert len(created) == 1


def test_without_a_provider_there_is_nothing_to_sign_in_at(lite: Service) -> None:
    assert lite.client.get(f"{API}/sign-in").json() == {"provider": None}
    refused(lite.client.post(f"{API}/sign-in", headers=SAME), "not-found", 404)
    body = {"state": "x", "code": "y"}
    refused(lite.client.post(f"{API}/sign-in/reply", json=body, headers=SAME), "not-found", 404)


@pytest.mark.parametrize("issuer", ["http://sso.example.org/realm", "sso.example.org", "http://localhost.example.org"])
def test_a_provider_over_plain_http_is_refused(issuer: str) -> None:
    with pytest.raises(ValueError, match="oidc_issuer"):
        Settings(oidc_issuer=issuer)


@pytest.mark.parametrize("roles", ["labelers", "labelers=boss", "=annotator,"])
def test_a_mapping_to_no_role_is_refused(roles: str) -> None:
    with pytest.raises(ValueError, match="oidc_roles"):
        Settings(oidc_roles=roles)  # type: ignore[arg-type]


def test_a_secret_that_cannot_be_read_stops_the_start(tmp_path: Path) -> None:
    with pytest.raises(oidc.BadProvider, match="WAYPOST_OIDC_CLIENT_SECRET_FILE"):
        create_app(Settings(oidc_issuer="https://sso.example.org", oidc_client_secret_file=tmp_path / "none"))


def test_a_missing_library_stops_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "authlib.integrations.starlette_client", None)
    with pytest.raises(oidc.BadProvider, match=r"pip install 'waypost\[oidc\]'"):
        create_app(Settings(oidc_issuer="https://sso.example.org"))


def test_the_command_line_connects_an_existing_user(
    sqlite_url: str, serve: Callable[..., Service], fake: FakeProvider, monkeypatch: pytest.MonkeyPatch
) -> None:
    service = serve(oidc_create=False)
    monkeypatch.delenv("WAYPOST_OIDC_ISSUER", raising=False)
    identify = ["user", "identify", "abe", "u-1", "--database", sqlite_url]
    nowhere = CliRunner().invoke(commands, identify)
    assert (nowhere.exit_code, "--issuer" in nowhere.output) == (2, True)
    monkeypatch.setenv("WAYPOST_OIDC_ISSUER", fake.issuer)
    assert CliRunner().invoke(commands, identify).exit_code == 0
    assert signed(service)["name"] == "abe"
    assert any(row["action"] == "user.identified" and row["actor"] == "command line" for row in log_of(service))
    again = CliRunner().invoke(commands, ["user", "identify", "vic", "u-1", "--database", sqlite_url])
    assert (again.exit_code, "is a user already" in again.output) == (2, True)
