"""The files for nginx and Caddy: real proxies with them in front of a server."""

import json
import os
import shutil
import socket
import ssl
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest
from tests.server.kit import API, Service, query
from websockets.sync.client import connect

from waypost_server import serving
from waypost_server.settings import Settings

DEPLOY = Path(__file__).resolve().parents[2] / "deploy"
VISITOR = "127.0.0.5"  # the proxy itself calls the server from 127.0.0.1
LIMIT = Settings().max_body_bytes

Start = Callable[[Settings], serving.Served]


def free_port() -> int:
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


def replaced(text: str, **by: str) -> str:
    for old, new in by.items():
        assert old in text
        text = text.replace(old, new)
    return text


def nginx(folder: Path, upstream: str, port: int) -> list[str]:
    """Write the configuration, and return the command that runs nginx with it."""
    site = (DEPLOY / "nginx.conf").read_text()
    changes = {
        "127.0.0.1:8000": upstream,
        "listen 80;": f"listen 127.0.0.1:{free_port()};",
        "listen 443 ssl;": f"listen 127.0.0.1:{port} ssl;",
        "/etc/ssl/certs/waypost.pem": f"{folder}/cert.pem",
        "/etc/ssl/private/waypost.key": f"{folder}/key.pem",
    }
    (folder / "site.conf").write_text(replaced(site, **changes))
    temporary = [f"{name}_temp_path {folder}/{name};" for name in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")]
    http = f"access_log off; {' '.join(temporary)} include {folder}/site.conf;"
    account = "user root;" if os.geteuid() == 0 else ""  # only root may choose one; the folder is this user's alone
    main = f"{account} pid {folder}/pid; daemon off; error_log {folder}/error.log; events {{}} http {{ {http} }}"
    (folder / "main.conf").write_text(main)
    return ["nginx", "-c", str(folder / "main.conf"), "-e", f"{folder}/error.log"]


def caddy(folder: Path, upstream: str, port: int) -> list[str]:
    """Write the configuration, and return the command that runs Caddy with it."""
    site = (DEPLOY / "Caddyfile").read_text()
    own = f"https://localhost:{port} {{\n\ttls {folder}/cert.pem {folder}/key.pem\n"
    changes = {"127.0.0.1:8000": upstream, "waypost.example.org {\n": own}
    (folder / "Caddyfile").write_text("{\n\tadmin off\n\tauto_https off\n}\n" + replaced(site, **changes))
    return ["caddy", "run", "--adapter", "caddyfile", "--config", str(folder / "Caddyfile")]


@pytest.fixture(params=[nginx, caddy], ids=["nginx", "caddy"])
def proxied(
    request: pytest.FixtureRequest, tmp_path: Path, sqlite_url: str, start_server: Start
) -> Iterator[tuple[Service, ssl.SSLContext]]:
    """A service that is called through a proxy, over https, from the address of a visitor."""
    name = request.param.__name__
    if shutil.which(name) is None or shutil.which("openssl") is None:
        pytest.skip(f"no {name} or no openssl on this machine")
    made = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "1"]
    names = ["-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost"]
    files = ["-keyout", str(tmp_path / "key.pem"), "-out", str(tmp_path / "cert.pem")]
    subprocess.run([*made, *names, *files], check=True, capture_output=True)
    served = start_server(Settings(database=sqlite_url, trusted_proxies="127.0.0.1"))  # type: ignore[arg-type]
    port = free_port()
    command = request.param(tmp_path, served.url.removeprefix("http://"), port)
    with (tmp_path / "output").open("w") as output:
        home = {"HOME": str(tmp_path), "PATH": "/usr/sbin:/usr/bin:/bin"}
        process = subprocess.Popen(command, stdout=output, stderr=output, env=home)
    try:
        wait_for(port, process, tmp_path)
        trust = ssl.create_default_context(cafile=tmp_path / "cert.pem")
        transport = httpx2.HTTPTransport(verify=trust, local_address=VISITOR)
        with httpx2.Client(transport=transport, base_url=f"https://localhost:{port}", timeout=30) as client:
            yield Service(client, served.db), trust
    finally:
        process.terminate()
        process.wait(20)


def wait_for(port: int, process: subprocess.Popen[bytes], folder: Path) -> None:
    deadline = time.monotonic() + 20
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), 1).close()
        except OSError:
            logs = [file.read_text() for file in (folder / "output", folder / "error.log") if file.exists()]
            assert process.poll() is None, logs
            assert time.monotonic() < deadline, logs
            time.sleep(0.05)
        else:
            return


def later(work: Callable[[], Any]) -> threading.Thread:
    timer = threading.Timer(0.5, work)
    timer.start()
    return timer


def log_in(service: Service, **headers: str) -> httpx2.Response:
    user = service.annotator.get("/me")["id"]
    code = service.admin.post(f"/users/{user}/login-links", expect=201)["code"]
    origin = {"Origin": str(service.client.base_url).rstrip("/")}
    return service.client.post(f"{API}/session", json={"code": code}, headers=origin | headers)


def test_a_server_behind_it_works_as_without(proxied: tuple[Service, ssl.SSLContext]) -> None:
    service, trust = proxied
    client, run = service.client, service.learner.create_run()

    # A login: the cookie is for https and this host alone, and the address is the visitor's, whatever the visitor says.
    entered = log_in(service, **{"X-Forwarded-For": "192.0.2.1", "X-Forwarded-Proto": "http"})
    assert entered.status_code == 200, entered.text
    assert entered.headers["set-cookie"].startswith("__Host-waypost_session=")
    assert client.get(f"{API}/me").json()["name"] == "abe"
    (login,) = [row for row in service.admin.get("/audit")["rows"] if row["action"] == "login"]
    assert login["address"] == VISITOR

    # A cookie and an address that names this host: the request is this site's own.
    ours = {"Origin": str(client.base_url).rstrip("/")}
    assert client.post(f"{API}/assignments", json={}, headers=ours).status_code == 204
    assert client.post(f"{API}/assignments", json={}, headers={"Origin": "https://evil.example"}).status_code == 403

    # No header comes twice, and those of the server arrive.
    for path in ("/", f"{API}/me", "/healthz"):
        reply = client.get(path)
        names = [name.lower() for name, _ in reply.headers.multi_items()]
        assert sorted(names) == sorted(set(names))
        assert {"strict-transport-security", "content-security-policy", "x-request-id"} <= set(names)

    # A long poll waits, and ends as soon as there is a query.
    asking = later(lambda: service.learner.ask(run, query("hier_demo")))
    began = time.monotonic()
    leased = service.annotator.lease(wait=20)
    assert 0.3 < time.monotonic() - began < 10
    asking.join()

    # An event is sent on at once.
    began, url = time.monotonic(), f"{API}/runs/{run}/events"
    asking = later(lambda: service.learner.ask(run, query(ordinal=1)))
    newest: dict[str, Any] = {}
    with client.stream("GET", url, params={"after": 0}, headers=service.viewer.headers) as stream:
        for line in stream.iter_lines():
            if line.startswith("data: "):
                newest = json.loads(line.removeprefix("data: "))
                if time.monotonic() - began > 0.4:
                    break
    assert time.monotonic() - began < 10
    assert newest
    asking.join()

    # Sockets are opened.
    address = f"wss://localhost:{client.base_url.port}{API}/queries/{leased['query']['id']}/play"
    headers = {"Authorization": f"Bearer {service.annotator.token}"}
    with connect(address, ssl=trust, additional_headers=headers) as opened:
        assert opened.protocol.state.name == "OPEN"


def test_what_is_too_large_is_said_by_the_server(proxied: tuple[Service, ssl.SSLContext]) -> None:
    service, _ = proxied

    def post(size: int) -> httpx2.Response:
        headers = service.learner.headers | {"Content-Type": "application/json"}
        return service.client.post(f"{API}/runs", content=b" " * size, headers=headers)

    assert post(LIMIT).json()["type"] == "/problems/unprocessable"  # read, and found to be no run
    assert (post(LIMIT + 1).status_code, post(LIMIT + 1).json()["type"]) == (413, "/problems/body-too-large")
