"""The outermost middleware: ids of requests, host names, limits on bodies, security headers, failures, metrics.

Starlette's own handler of failures runs outside of all middleware, where the security headers would be missing.
"""

import asyncio
import json
import time
from collections.abc import Iterable

from starlette.datastructures import Headers, MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from waypost_server import errors
from waypost_server.http import logs, problems
from waypost_server.http.traffic import Traffic

LOOPBACK = ("localhost", "127.0.0.1", "::1")
HEALTH_PATHS = ("/healthz", "/readyz")

HEADERS = {
    "Content-Security-Policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
        "connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
    ),
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}


def host_name(header: str) -> str:
    """Return the name in a Host header, without its port."""
    name, closed, _ = header.removeprefix("[").partition("]")
    return (name if header.startswith("[") and closed else header.partition(":")[0]).lower()


def _add_headers(message: Message, path: str, request: str) -> None:
    headers = MutableHeaders(scope=message)
    headers[logs.HEADER] = request
    for name, value in HEADERS.items():
        headers.setdefault(name, value)
    if path.startswith("/api/"):
        headers.setdefault("Cache-Control", "no-store")


class Guard:
    """ASGI middleware that refuses requests that must not reach the app."""

    def __init__(
        self, app: ASGIApp, hosts: Iterable[str], max_body_bytes: int, body_seconds: float, traffic: Traffic
    ) -> None:
        self._app = app
        self._traffic = traffic
        self._hosts = frozenset(name.lower() for name in (*LOOPBACK, *hosts))
        self._max_body_bytes = max_body_bytes
        self._body_seconds = body_seconds

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse the request, or read its body and pass it on; add headers to the response, also if the app fails."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        request = logs.begin(scope)
        if scope["type"] == "websocket":
            await self._socket(scope, receive, send)
            return

        started, began = False, time.perf_counter()

        async def send_with_headers(message: Message) -> None:
            nonlocal started
            if message["type"] == "http.response.start":
                started = True
                _add_headers(message, scope["path"], request)
                operation, seconds = getattr(scope.get("route"), "operation_id", None), time.perf_counter() - began
                self._traffic.count(operation, message["status"], seconds)
                logs.answered(scope, message["status"], seconds)
            await send(message)

        try:
            await self._request(scope, receive, send_with_headers)
        except Exception as error:
            response = problems.failed(scope["method"], scope["path"], error)
            if not started:
                await response(scope, receive, send_with_headers)
            raise

    async def _request(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            self._check_host(scope)
            body = await self._body(scope, receive)
        except errors.Refusal as refusal:
            await problems.render(refusal, scope["path"])(scope, receive, send)
            return
        if body is not None:
            await self._app(scope, replayed(body, receive), send)

    async def _socket(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse a socket to another host, or pass it on. Uvicorn limits the size of its messages."""
        try:
            self._check_host(scope)
        except errors.Misdirected as refusal:
            await send({"type": "websocket.close", "code": 4_000 + refusal.status, "reason": refusal.detail})
        else:
            await self._app(scope, receive, send)

    def _check_host(self, scope: Scope) -> None:
        host = host_name(Headers(scope=scope).get("host", ""))
        if host not in self._hosts and "*" not in self._hosts and scope["path"] not in HEALTH_PATHS:
            raise errors.Misdirected(
                f"{json.dumps(host)} is not a name of this server; its operator can add it to WAYPOST_HOSTS."
            )

    async def _body(self, scope: Scope, receive: Receive) -> bytes | None:
        """Return the whole body within the limits of size and time, or None if the client disconnected."""
        headers = Headers(scope=scope)
        length = headers.get("content-length", "0")
        if "transfer-encoding" not in headers and length == "0":
            return b""
        if length.isdigit() and int(length) > self._max_body_bytes:
            raise self._too_large()
        media_type = headers.get("content-type", "").partition(";")[0].strip().lower()
        if media_type != "application/json":
            raise errors.NotJson("Bodies must be JSON: send `Content-Type: application/json`.")
        try:
            async with asyncio.timeout(self._body_seconds):
                return await self._read(receive)
        except TimeoutError:
            raise errors.BodyTooSlow(f"The body took longer than {self._body_seconds:g} seconds.") from None

    async def _read(self, receive: Receive) -> bytes | None:
        parts: list[bytes] = []
        size, more = 0, True
        while more:
            message = await receive()
            if message["type"] == "http.disconnect":
                return None
            parts.append(message.get("body", b""))
            size += len(parts[-1])
            if size > self._max_body_bytes:
                raise self._too_large()
            more = message.get("more_body", False)
        return b"".join(parts)

    def _too_large(self) -> errors.BodyTooLarge:
        return errors.BodyTooLarge(f"A body may have at most {self._max_body_bytes} bytes; send less at a time.")


def replayed(body: bytes, receive: Receive) -> Receive:
    """Return a `receive` that first returns this body, then the messages that follow it."""
    given = False

    async def again() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return again
