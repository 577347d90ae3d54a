"""Where webhooks may go: to hosts that the operator named, on public addresses or ranges that the operator named."""

import asyncio
import socket
import subprocess
from collections.abc import Iterator
from ipaddress import IPv4Address, IPv6Address, ip_address, ip_network
from pathlib import Path
from typing import Any

import httpcore2
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.server.kit import Service, in_process
from tests.server.webhooks.kit import ALLOWED, Receiver, delivered, deliveries, eventually, receiving, subscribe

from waypost_server.webhooks.network import Post
from waypost_server.webhooks.policy import NotAllowed, Policy

LOOPBACK = (ip_network("127.0.0.0/8"), ip_network("::1/128"))


@pytest.fixture
def receiver() -> Iterator[Receiver]:
    with receiving() as receiver:
        yield receiver


@pytest.fixture
def lite(sqlite_url: str) -> Iterator[Service]:
    with in_process(sqlite_url, **ALLOWED) as service:
        yield service


def sent(policy: Policy, url: str) -> int:
    """Send one request and return the status."""

    async def send() -> int:
        async with Post(policy, 5) as post:
            return await post.send(url, {"Content-Type": "application/json"}, b"{}")

    return asyncio.run(send())


def resolve_to(monkeypatch: pytest.MonkeyPatch, *answers: list[str]) -> list[str]:
    """Let each look-up of a name return the next of these answers, then the last; return the names looked up."""
    original, asked = socket.getaddrinfo, list[str]()

    def getaddrinfo(host: Any, port: Any, *more: Any, **options: Any) -> Any:
        if str(host).startswith(("127.", "::1")):
            return original(host, port, *more, **options)
        asked.append(host)
        found = answers[min(len(asked), len(answers)) - 1]
        families = {4: socket.AF_INET, 6: socket.AF_INET6}
        return [(families[ip_address(one).version], socket.SOCK_STREAM, 6, "", (one, port)) for one in found]

    monkeypatch.setattr(socket, "getaddrinfo", getaddrinfo)
    return asked


# --- hosts


@pytest.mark.parametrize(
    "url",
    [
        "https://hooks.example.org/a",
        "https://hooks.example.org:443/a?b=c",
        "https://HOOKS.example.org/",
        "https://a.b.example.net/",
        "https://example.com:8443/",
        "http://127.0.0.1:9000/",
        "http://[::1]:9000/",
    ],
)
def test_a_host_that_the_operator_named_is_allowed(url: str) -> None:
    named = ("hooks.example.org", "*.example.net", "example.com:8443", "127.0.0.1:9000", "[::1]:*")
    Policy(named).check_url(url)


@pytest.mark.parametrize(
    ("url", "why"),
    [
        ("https://example.org/", "has not allowed"),
        ("https://hooks.example.org.evil.test/", "has not allowed"),
        ("https://hooks.example.org:8443/", "has not allowed"),
        ("https://evilexample.net/", "has not allowed"),
        ("https://hooks.example.org@evil.test/", "leave out the user name"),
        ("https://evil.test/#hooks.example.org", "leave out"),
        ("https://evil.test\\@hooks.example.org/", "not a URL|has not allowed|leave out"),
        ("http://hooks.example.org/", "use https"),
        ("http://2130706433/", "use https"),
        ("http://0x7f.1/", "use https"),
        ("http://169.254.169.254/latest/meta-data", "use https"),
        ("ftp://hooks.example.org/", "give an address like"),
        ("file:///etc/passwd", "give an address like"),
        ("https://", "give an address like"),
        ("https://0177.0.0.1/", "not a URL"),
        ("https://[::1", "not a URL"),
        ("https://xn--/", "has not allowed|not a URL"),
    ],
)
def test_any_other_address_is_refused_in_words(url: str, why: str) -> None:
    with pytest.raises(NotAllowed, match=why):
        Policy(("hooks.example.org", "*.example.net")).check_url(url)


def test_the_server_refuses_an_address_that_is_not_allowed(lite: Service, receiver: Receiver) -> None:
    problem = lite.admin.post("/webhooks", {"url": "https://example.org/"}, 422)
    assert problem["errors"][0]["loc"] == ["body", "url"]
    assert "WAYPOST_WEBHOOK_HOSTS" in problem["detail"]
    webhook, _ = subscribe(lite, receiver)
    lite.admin.call("PATCH", f"/webhooks/{webhook}", {"url": "https://example.org/"}, 422)
    assert lite.admin.get(f"/webhooks/{webhook}")["url"] == receiver.url


def test_a_host_that_the_operator_no_longer_allows_gets_nothing(sqlite_url: str, receiver: Receiver) -> None:
    with in_process(sqlite_url, **ALLOWED) as service:
        webhook, _ = subscribe(service, receiver)
    with in_process(sqlite_url, **ALLOWED | {"webhook_hosts": ("hooks.example.org",)}) as service:
        service.learner.create_run()
        (tried,) = eventually(lambda: [one for one in deliveries(service, webhook) if one["attempts"]])
    assert "has not allowed" in tried["reason"]
    assert receiver.requests == []


# --- addresses


PRIVATE = [
    *("127.0.0.1", "10.0.0.5", "172.16.3.4", "192.168.1.1", "169.254.169.254", "100.64.0.1", "0.0.0.0", "224.0.0.1"),
    *("255.255.255.255", "::1", "::", "fe80::1", "fc00::1", "fd00:ec2::254", "ff02::1", "fec0::1"),
    *("::ffff:127.0.0.1", "::ffff:169.254.169.254", "2002:7f00:1::", "64:ff9b::7f00:1"),
]


@pytest.mark.parametrize("address", PRIVATE)
def test_a_name_that_leads_to_a_private_address_is_not_called(monkeypatch: pytest.MonkeyPatch, address: str) -> None:
    monkeypatch.setattr(httpcore2.AnyIOBackend, "connect_tcp", never)
    resolve_to(monkeypatch, [address])
    with pytest.raises(NotAllowed, match="WAYPOST_WEBHOOK_NETWORKS"):
        sent(Policy(("hooks.example.org",)), "https://hooks.example.org/")


async def never(*_: Any, **__: Any) -> Any:
    raise AssertionError("it connected")


@pytest.mark.parametrize("number", ["2130706433", "0x7f000001", "017700000001", "127.1"])
def test_another_spelling_of_a_private_address_is_not_called(monkeypatch: pytest.MonkeyPatch, number: str) -> None:
    monkeypatch.setattr(httpcore2.AnyIOBackend, "connect_tcp", never)
    with pytest.raises((NotAllowed, httpcore2.ConnectError), match=r"not public|does not resolve"):
        sent(Policy(("*",)), f"https://{number}/")


def test_a_name_with_one_private_address_among_public_ones_is_not_called(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(httpcore2.AnyIOBackend, "connect_tcp", never)
    resolve_to(monkeypatch, ["93.184.215.14", "10.0.0.5"])
    with pytest.raises(NotAllowed, match=r"10\.0\.0\.5"):
        sent(Policy(("hooks.example.org",)), "https://hooks.example.org/")


def test_the_connection_goes_to_the_address_that_was_checked(monkeypatch: pytest.MonkeyPatch) -> None:
    """A name that is public at the first look-up and private at every later one."""
    connected: list[str] = []

    async def connect(_: Any, host: str, *__: Any) -> Any:
        connected.append(host)
        raise httpcore2.ConnectError("far away")

    monkeypatch.setattr(httpcore2.AnyIOBackend, "connect_tcp", connect)
    asked = resolve_to(monkeypatch, ["93.184.215.14"], ["127.0.0.1"])
    with pytest.raises(httpcore2.ConnectError):
        sent(Policy(("hooks.example.org",)), "https://hooks.example.org/")
    assert (asked, connected) == (["hooks.example.org"], ["93.184.215.14"])


@given(st.ip_addresses(v=4))
def test_an_ipv4_address_is_judged_the_same_in_the_form_of_ipv6(address: IPv4Address) -> None:
    def allowed(one: IPv4Address | IPv6Address) -> bool:
        try:
            Policy(()).check_addresses("a", [one])
        except NotAllowed:
            return False
        return True

    assert allowed(IPv6Address(f"::ffff:{address}")) == allowed(address)
    assert not (address.is_private and allowed(address))


def test_a_range_that_the_operator_named_is_allowed_and_no_other() -> None:
    policy = Policy((), (ip_network("10.1.0.0/16"),))
    policy.check_addresses("a", [ip_address("10.1.2.3"), ip_address("::ffff:10.1.2.3")])
    with pytest.raises(NotAllowed):
        policy.check_addresses("a", [ip_address("10.2.0.1")])


# --- the way there


def test_a_redirect_is_a_failure_and_leads_nowhere(lite: Service, receiver: Receiver) -> None:
    with receiving() as inside:
        receiver.reply, receiver.location = lambda _: 307, inside.url
        webhook, _ = subscribe(lite, receiver)
        lite.learner.create_run()
        (tried,) = eventually(lambda: [one for one in deliveries(lite, webhook) if one["attempts"]])
        assert (tried["status"], tried["reason"]) == (307, "The receiver answered 307; redirects are not followed.")
        assert inside.requests == []


def test_a_proxy_of_the_environment_is_not_used(
    sqlite_url: str, receiver: Receiver, monkeypatch: pytest.MonkeyPatch
) -> None:
    with receiving() as proxy:
        for name in ("HTTP_PROXY", "http_proxy", "ALL_PROXY", "all_proxy"):
            monkeypatch.setenv(name, f"http://127.0.0.1:{proxy.port}")
        with in_process(sqlite_url, **ALLOWED) as service:
            webhook, _ = subscribe(service, receiver)
            service.learner.create_run()
            delivered(service, webhook, 1)
        assert proxy.requests == []
    assert len(receiver.requests) == 1


def certificate(folder: Path, name: str) -> Path:
    """A certificate and its key for one host name."""
    file = folder / f"{name}.pem"
    about = ["-subj", f"/CN={name}", "-addext", f"subjectAltName=DNS:{name}", "-days", "2"]
    make = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-keyout", str(file), "-out", f"{file}.crt"]
    subprocess.run([*make, *about], check=True, capture_output=True)
    file.write_bytes(file.read_bytes() + Path(f"{file}.crt").read_bytes())
    return file


@pytest.mark.parametrize(("name", "trusted"), [("hooks.example.org", True), ("other.example.org", False)])
def test_the_certificate_is_checked_against_the_name_of_the_host(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, trusted: bool
) -> None:
    file = certificate(tmp_path, name)
    monkeypatch.setenv("SSL_CERT_FILE", f"{file}.crt")
    resolve_to(monkeypatch, ["127.0.0.1"])
    with receiving(file) as receiver:
        policy = Policy(("hooks.example.org:*",), LOOPBACK)
        url = f"https://hooks.example.org:{receiver.port}/"
        if trusted:
            assert sent(policy, url) == 204
            assert receiver.requests[0][0]["host"] == f"hooks.example.org:{receiver.port}"
        else:
            with pytest.raises(httpcore2.ConnectError, match="CERTIFICATE_VERIFY_FAILED"):
                sent(policy, url)
            assert receiver.requests == []
