"""Sends one request to a receiver: only to addresses that the policy allows, without redirects, proxies or waiting.

The policy is applied to the address of the connection itself. So a name that resolves to another address on the next
look-up (DNS rebinding) gains nothing.
"""

import asyncio
import socket
import ssl
from collections.abc import Iterable
from ipaddress import ip_address
from typing import Any

import httpcore2
import httpx2

from waypost_server.webhooks.policy import Address, Policy

MOST_BYTES = 65_536  # of a response; the rest is not read


class CheckedNetwork(httpcore2.AsyncNetworkBackend):
    """Resolves each host once per connection, checks all of its addresses, and connects to one of them."""

    def __init__(self, policy: Policy) -> None:
        self._policy = policy
        self._network = httpcore2.AnyIOBackend()

    async def connect_tcp(
        self,
        host: str,
        port: int,
        timeout: float | None = None,
        local_address: str | None = None,
        socket_options: Iterable[Any] | None = None,
    ) -> httpcore2.AsyncNetworkStream:
        """Connect to a host.

        Raises:
            NotAllowed: the policy forbids one of its addresses.
            ConnectError, ConnectTimeout: no address answers.
        """
        found = await addresses(host, port)
        self._policy.check_addresses(host, found)
        failure: Exception = httpcore2.ConnectError(f"{host} has no address")
        for address in found:
            try:
                return await self._network.connect_tcp(str(address), port, timeout, local_address, socket_options)
            except (httpcore2.ConnectError, httpcore2.ConnectTimeout) as error:
                failure = error
        raise failure


async def addresses(host: str, port: int) -> list[Address]:
    """Return the addresses of a host, as the system resolves it.

    Raises:
        ConnectError: the name does not resolve.
    """
    try:
        found = await asyncio.get_running_loop().getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except OSError as error:
        raise httpcore2.ConnectError(f"{host} does not resolve ({error.strerror})") from None
    return list(dict.fromkeys(ip_address(str(address[0]).partition("%")[0]) for *_, address in found))


class Post:
    """Posts JSON to receivers. Use it as an async context manager; it closes its connections at the end.

    Args:
        policy: the addresses that it may call.
        seconds: the longest time of one call.
    """

    def __init__(self, policy: Policy, seconds: float) -> None:
        self._policy, self._seconds = policy, seconds
        self._pool = httpcore2.AsyncConnectionPool(
            ssl_context=tls(), max_connections=None, keepalive_expiry=5.0, network_backend=CheckedNetwork(policy)
        )

    async def __aenter__(self) -> "Post":
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._pool.aclose()

    async def send(self, address: str, headers: dict[str, str], body: bytes) -> int:
        """Send one POST request and return the status of the response. Redirects are not followed.

        Raises:
            NotAllowed: the policy forbids the URL or an address of its host.
            TimeoutError: the call took too long.
            httpcore2.NetworkError, httpcore2.ProtocolError: the receiver could not be reached, or spoke no HTTP.
        """
        url = self._policy.check_url(address)
        target = httpcore2.URL(scheme=url.raw_scheme, host=url.raw_host, port=url.port, target=url.raw_path)
        given = {"Host": url.netloc.decode(), "Content-Length": str(len(body)), **headers}
        async with asyncio.timeout(self._seconds):
            async with self._pool.stream(
                "POST", target, headers=[(name.encode(), value.encode()) for name, value in given.items()], content=body
            ) as response:
                size = 0
                async for part in response.aiter_stream():
                    size += len(part)
                    if size > MOST_BYTES:
                        break
                return int(response.status)


def tls() -> ssl.SSLContext:
    """Return the settings of https: certificates are checked against the authorities that the system trusts."""
    return httpx2.create_ssl_context()
