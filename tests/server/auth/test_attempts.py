"""Guessing login codes is slowed down for the one who guesses, and for nobody else."""

from typing import Any

import httpx2
import pytest
from fastapi.testclient import TestClient
from tests.server.kit import API, Service

from waypost_server import errors
from waypost_server.app import create_app
from waypost_server.auth.attempts import MOST_CLIENTS, WINDOW_SECONDS, LoginAttempts
from waypost_server.settings import Settings

PROXY = ("10.0.0.2", 5_000)
VISITOR, OTHER = "203.0.113.7", "198.51.100.9"


def serving(url: str, **settings: Any) -> TestClient:
    """The app, called from the address of a proxy."""
    chosen = Settings(database=url, hosts=("testserver",), login_failures=3, **settings)
    return TestClient(create_app(chosen), client=PROXY)


def log_in(client: httpx2.Client, code: str, **headers: str) -> httpx2.Response:
    return client.post(f"{API}/session", json={"code": code}, headers=headers)


def forwarded(*addresses: str) -> dict[str, str]:
    return {"X-Forwarded-For": ", ".join(addresses)}


def code_of(service: Service, name: str) -> str:
    (user,) = [one for one in service.admin.get("/users")["users"] if one["name"] == name]
    return str(service.admin.post(f"/users/{user['id']}/login-links", expect=201)["code"])


def addresses(service: Service) -> set[tuple[str, str]]:
    rows = service.admin.get("/audit")["rows"]
    return {(row["action"], row["address"]) for row in rows if row["action"].startswith("login")}


def test_a_valid_link_works_while_somebody_at_the_same_address_guesses(sqlite_url: str) -> None:
    with serving(sqlite_url) as client:
        service = Service(client, client.app.state.context.db)  # type: ignore[attr-defined]
        guesses = [log_in(client, f"guess{n}") for n in range(20)]
        assert [one.status_code for one in guesses] == [401] * 3 + [429] * 17
        assert 1 <= int(guesses[-1].headers["retry-after"]) <= 60
        code = code_of(service, "abe")
        assert log_in(client, code).status_code == 200
        assert log_in(client, code).status_code == 429  # used: it is wrong now, as the other guesses


def test_behind_a_trusted_proxy_each_visitor_has_a_limit_and_an_address_of_their_own(sqlite_url: str) -> None:
    with serving(sqlite_url, trusted_proxies="10.0.0.0/24, ::1") as client:
        service = Service(client, client.app.state.context.db)  # type: ignore[attr-defined]
        for n in range(20):  # what a visitor sends is before what the proxy appends
            blocked = log_in(client, f"guess{n}", **forwarded(f"192.0.2.{n}", VISITOR))
        assert blocked.status_code == 429
        assert log_in(client, "typo", **forwarded(OTHER)).status_code == 401
        assert log_in(client, code_of(service, "abe"), **forwarded(OTHER)).status_code == 200
        assert addresses(service) == {("login.refused", VISITOR), ("login.refused", OTHER), ("login", OTHER)}


def test_without_a_trusted_proxy_nobody_can_choose_their_address(sqlite_url: str) -> None:
    with serving(sqlite_url, trusted_proxies="10.0.1.0/24") as client:
        service = Service(client, client.app.state.context.db)  # type: ignore[attr-defined]
        replies = [log_in(client, f"guess{n}", **forwarded(f"192.0.2.{n}")).status_code for n in range(5)]
        assert replies == [401, 401, 401, 429, 429]
        assert addresses(service) == {("login.refused", PROXY[0])}


@pytest.mark.parametrize(("given", "secure"), [({"X-Forwarded-Proto": "https"}, True), ({}, False)])
def test_cookies_are_for_https_alone_where_the_proxy_says_that_the_browser_uses_it(
    sqlite_url: str, given: dict[str, str], secure: bool
) -> None:
    with serving(sqlite_url, trusted_proxies="10.0.0.2") as client:
        service = Service(client, client.app.state.context.db)  # type: ignore[attr-defined]
        cookie = log_in(client, code_of(service, "abe"), **given).headers["set-cookie"]
        assert cookie.startswith("__Host-waypost_session=") == secure
        assert ("Secure" in cookie) == secure


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


def refused(attempts: LoginAttempts, address: str | None) -> bool:
    try:
        attempts.failed(address)
    except errors.TooManyAttempts:
        return True
    return False


def test_a_visitor_with_a_network_of_ipv6_addresses_is_one_visitor() -> None:
    attempts = LoginAttempts(2, Clock())
    assert [refused(attempts, f"2001:db8:0:1::{n:x}") for n in range(3)] == [False, False, True]
    assert not refused(attempts, "2001:db8:0:2::1")
    assert [refused(attempts, one) for one in ("::ffff:192.0.2.1", "192.0.2.1", "192.0.2.1")] == [False, False, True]


def test_who_waits_a_minute_may_try_again() -> None:
    clock = Clock()
    attempts = LoginAttempts(1, clock)
    assert [refused(attempts, VISITOR), refused(attempts, VISITOR)] == [False, True]
    clock.now = WINDOW_SECONDS
    assert not refused(attempts, VISITOR)


def test_who_must_wait_is_told_for_how_long() -> None:
    clock = Clock()
    attempts = LoginAttempts(2, clock)
    attempts.failed(VISITOR)
    clock.now = 10
    attempts.failed(VISITOR)
    for clock.now, left in ((25, WINDOW_SECONDS - 25), (WINDOW_SECONDS - 0.5, 1)):
        with pytest.raises(errors.TooManyAttempts) as caught:
            attempts.failed(VISITOR)
        assert caught.value.retry_after == left


def test_many_addresses_fill_no_memory_and_free_only_the_oldest() -> None:
    attempts = LoginAttempts(1, Clock())
    for n in range(MOST_CLIENTS + 1):
        assert not refused(attempts, f"10.{n // 65_536}.{n // 256 % 256}.{n % 256}")
    assert refused(attempts, "10.0.0.2")
    assert refused(attempts, "10.0.0.1"), "a known client takes nobody's place"
    assert not refused(attempts, "10.0.0.0")
