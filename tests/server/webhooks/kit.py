"""What the tests of webhooks are written with: a real receiver on this machine, and waiting for what must happen."""

import json
import ssl
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from standardwebhooks import Webhook
from tests.server.kit import Json, Service

ALLOWED = {"webhook_hosts": ("127.0.0.1:*",), "webhook_networks": ("127.0.0.0/8",), "webhook_retry_seconds": 0.05}
"""Settings that let webhooks call this machine, and try again soon."""


@dataclass
class Receiver:
    """Receives requests. `reply` chooses the response; while `held` is clear, requests hang."""

    port: int = 0
    requests: list[tuple[dict[str, str], bytes]] = field(default_factory=list)
    reply: Callable[[Json], int] = lambda _message: 204
    held: threading.Event = field(default_factory=threading.Event)
    location: str = ""  # of a redirect
    flood: bool = False  # whether the response never ends

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/hook?x=1"

    @property
    def messages(self) -> list[Json]:
        return [json.loads(body) for _, body in self.requests]

    @property
    def ids(self) -> list[str]:
        return [headers["webhook-id"] for headers, _ in self.requests]

    def verified(self, secret: str) -> list[Json]:
        """The messages, each verified with the library for receivers."""
        return [Webhook(secret).verify(body, headers) for headers, body in self.requests]


@contextmanager
def receiving(certificate: Path | None = None) -> Iterator[Receiver]:
    """Run a receiver on a free port, with https if there is a certificate."""
    receiver = Receiver()
    receiver.held.set()

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["content-length"]))
            receiver.requests.append(({name.lower(): value for name, value in self.headers.items()}, body))
            status = receiver.reply(json.loads(body))
            receiver.held.wait()
            try:
                self.respond(status)
            except OSError:
                self.close_connection = True  # the server hung up

        def respond(self, status: int) -> None:
            self.send_response(status)
            if receiver.location:
                self.send_header("Location", receiver.location)
            if receiver.flood:
                self.end_headers()
                while True:
                    self.wfile.write(b"x" * 65_536)
            if status != 204:
                self.send_header("Content-Length", "0")
            self.end_headers()

        def log_message(self, *_: Any) -> None:
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        server.daemon_threads = True
        receiver.port = server.server_address[1]
        if certificate is not None:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(certificate)
            server.socket = context.wrap_socket(server.socket, server_side=True)
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield receiver
        finally:
            receiver.held.set()
            server.shutdown()
            thread.join()


def eventually(holds: Callable[[], Any], seconds: float = 60.0) -> Any:
    """Wait until something is true, and return it; fail if it never is."""
    until = time.monotonic() + seconds
    while not (found := holds()):
        assert time.monotonic() < until, "it never happened"
        time.sleep(0.02)
    return found


def subscribe(service: Service, receiver: Receiver, **more: Any) -> tuple[int, str]:
    """Create a webhook for a receiver; return its id and secret."""
    made = service.admin.post("/webhooks", {"url": receiver.url, **more}, 201)
    return made["webhook"]["id"], made["secret"]


def deliveries(service: Service, webhook: int, **wish: Any) -> list[Json]:
    """The webhook's messages, oldest first."""
    page = service.admin.get(f"/webhooks/{webhook}/deliveries", params=wish)
    return list(reversed(page["deliveries"]))


def delivered(service: Service, webhook: int, n: int) -> list[Json]:
    """Wait until n messages are delivered, and return them."""
    return list(
        eventually(lambda: len(found := deliveries(service, webhook, state="delivered", limit=500)) >= n and found)
    )
