"""Decides which addresses webhooks may call: hosts that the operator names, and only public addresses behind them.

A name can resolve to any address, also to one inside the operator's network. So the policy checks the addresses too,
at every connection; see `webhooks.network`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from ipaddress import IPv4Address, IPv4Network, IPv6Address, IPv6Network, ip_address

import httpx2

from waypost_server.settings import Settings

Address = IPv4Address | IPv6Address
PORTS = {"https": 443, "http": 80}


class NotAllowed(Exception):
    """The policy forbids an address. The message says why and who can change it."""


@dataclass(frozen=True)
class Policy:
    """The hosts and the private address ranges that the operator has allowed."""

    hosts: tuple[str, ...]
    networks: tuple[IPv4Network | IPv6Network, ...] = ()

    @classmethod
    def of(cls, settings: Settings) -> "Policy":
        """Return the policy of a server's settings."""
        return cls(tuple(host.lower() for host in settings.webhook_hosts), settings.webhook_networks)

    def check_url(self, text: str) -> httpx2.URL:
        """Return a parsed URL.

        Raises:
            NotAllowed: it is no plain https URL, or its host is not allowed.
        """
        try:
            url = httpx2.URL(text)
        except (httpx2.InvalidURL, ValueError) as error:
            raise NotAllowed(f"this is not a URL ({error})") from None
        host = url.raw_host.decode().lower()
        if url.scheme not in PORTS or not host:
            raise NotAllowed("give an address like https://hooks.example.org/waypost")
        if url.scheme == "http" and not _is_loopback(host):
            raise NotAllowed("use https; http is accepted only for this machine (127.0.0.1, ::1 or localhost)")
        if url.userinfo or url.fragment:
            raise NotAllowed("leave out the user name, the password and the fragment")
        if not self._allows_host(f"[{host}]" if ":" in host else host, url.port, PORTS[url.scheme]):
            raise NotAllowed(f"the operator has not allowed {url.netloc.decode()}; WAYPOST_WEBHOOK_HOSTS lists hosts")
        return url

    def _allows_host(self, host: str, port: int | None, usual: int) -> bool:
        names = {f"{host}:{port or usual}"} | ({host} if port in {None, usual} else set())
        return any(fnmatchcase(name, _literal(pattern)) for pattern in self.hosts for name in names)

    def check_addresses(self, host: str, found: Sequence[Address]) -> None:
        """Refuse a host if any of its addresses is forbidden.

        Raises:
            NotAllowed: names the address.
        """
        for address in found:
            if not all(self._allows_address(form) for form in _forms(address)):
                raise NotAllowed(
                    f"{host} has the address {address}, which is not public; "
                    "the operator can allow its range in WAYPOST_WEBHOOK_NETWORKS"
                )

    def _allows_address(self, address: Address) -> bool:
        if any(address in network for network in self.networks):
            return True
        unusual = address.is_multicast or address.is_reserved or getattr(address, "is_site_local", False)
        return address.is_global and not unusual


def _literal(pattern: str) -> str:
    """Return a pattern in which only `*` is special, so that the brackets of an IPv6 address stand for themselves."""
    return pattern.replace("[", "[[]")


def _forms(address: Address) -> list[Address]:
    """Return an address as it acts: the IPv4 address of a mapped one, and both parts of a 6to4 address."""
    if isinstance(address, IPv4Address):
        return [address]
    if address.ipv4_mapped is not None:
        return [address.ipv4_mapped]
    return [address] if address.sixtofour is None else [address, address.sixtofour]


def _is_loopback(host: str) -> bool:
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
