"""Signs people in at an OpenID provider: the authorization code flow with PKCE, done by authlib.

Nothing is stored here while somebody is away at the provider. The browser keeps the attempt, in a cookie that only this
server reads, so any process of the server can end it.
"""

import hmac
import logging
import time
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any, cast

import httpx2
from starlette.requests import HTTPConnection

from waypost.wire import Role
from waypost_server import errors
from waypost_server.settings import Settings

FRESH_SECONDS = 300.0  # how long the provider's description and its keys are used before they are read again
TIMEOUT_SECONDS = 10.0  # of each request to the provider
LEEWAY_SECONDS = 60.0  # by how much the clocks of the provider and of this server may differ
MOST_SUBJECT = 255  # characters, as OpenID Connect limits them
# Signatures with a private key of the provider. `none`, and HMAC with the secret of this server, are never accepted.
ALGORITHMS = ("RS256", "RS384", "RS512", "PS256", "PS384", "PS512", "ES256", "ES384", "ES512", "EdDSA", "Ed25519")

log = logging.getLogger("waypost")

Claims = Mapping[str, Any]


class BadProvider(Exception):
    """The settings do not describe a provider that can be used. The message says why and what to do."""


@dataclass(frozen=True)
class Attempt:
    """One sign-in that has begun: what the browser keeps until the provider sends it back."""

    state: str
    nonce: str
    verifier: str

    @property
    def cookie(self) -> str:
        """The value of the cookie."""
        return f"{self.state}.{self.nonce}.{self.verifier}"

    @classmethod
    def of_cookie(cls, value: str | None, state: str) -> "Attempt":
        """Return the attempt in a cookie, if it is the one with this state.

        Raises:
            SignInStale: it is another one, or there is none.
        """
        parts = (value or "").split(".")
        if len(parts) != 3 or not all(parts) or not hmac.compare_digest(parts[0].encode(), state.encode()):
            raise errors.SignInStale(
                "This sign-in was not begun in this browser, or it took longer than ten minutes. Begin it again."
            )
        return cls(*parts)


@dataclass(frozen=True)
class Person:
    """Somebody who signed in at the provider.

    Args:
        issuer: the provider.
        subject: the person's id there, which no other person ever has.
        name: what a user who is created for them is called.
        role: the role that their claims give; None if roles are given in Waypost.
    """

    issuer: str
    subject: str
    name: str
    role: Role | None


class Provider:
    """The OpenID provider of the settings."""

    def __init__(self, settings: Settings, issuer: str) -> None:
        self.issuer = issuer
        self.name = settings.oidc_name
        self._settings = settings
        self._secret = _secret(settings)
        self._client: Any = None
        self._until = 0.0  # when the client becomes stale, on the monotonic clock
        try:
            self._new_client = import_module("authlib.integrations.starlette_client").StarletteOAuth2App
            self._faults = (
                import_module("authlib.common.errors").AuthlibBaseError,
                import_module("joserfc.errors").JoseError,
                ValueError,  # a token that is no token, a key that is no key
                KeyError,
                TypeError,
            )
        except ImportError:
            raise BadProvider("WAYPOST_OIDC_ISSUER needs authlib: pip install 'waypost[oidc]'.") from None

    async def begin(self, redirect: str) -> tuple[str, Attempt]:
        """Return the address at which a browser signs in, and the attempt that it keeps.

        Raises:
            ProviderFailed: the provider cannot be reached, or does not reply as one.
        """
        client = await self._fresh()
        made = await client.create_authorization_url(redirect)
        return made["url"], Attempt(made["state"], made["nonce"], made["code_verifier"])

    async def end(self, attempt: Attempt, redirect: str, code: str) -> Claims:
        """Exchange the code that the provider gave for the claims of an ID token, and check all of them.

        Raises:
            SignInFailed: the provider refused the code, or its token is not valid.
            ProviderFailed: the provider cannot be reached, or does not reply as one.
        """
        client = await self._fresh()
        expected = {
            "iss": {"essential": True, "value": self.issuer},
            "aud": {"essential": True, "value": self._settings.oidc_client_id},
        }
        try:
            token = await client.fetch_access_token(redirect, code=code, code_verifier=attempt.verifier)
            claims = await client.parse_id_token(token, attempt.nonce, expected, leeway=LEEWAY_SECONDS)
        except httpx2.HTTPError as error:
            raise _failed(self.issuer, error) from None
        except self._faults as error:
            raise errors.SignInFailed(_words(error)) from None
        if claims is None:
            raise errors.SignInFailed("the provider sent no ID token")
        return cast(Claims, claims)

    def person(self, claims: Claims) -> Person:
        """Return the person of valid claims.

        Raises:
            SignInFailed: they have no usable subject.
            NoRole: none of their roles is one of this server's.
        """
        subject = claims["sub"]
        if not isinstance(subject, str) or not 0 < len(subject) <= MOST_SUBJECT:
            raise errors.SignInFailed("the provider sent no usable subject")
        named = (claims.get(one) for one in ("preferred_username", "name", "email"))
        name = next((one for one in named if isinstance(one, str) and one.strip()), subject)
        return Person(self.issuer, subject, name, self._role(claims))

    def _role(self, claims: Claims) -> Role | None:
        roles = self._settings.oidc_roles
        if not roles:
            return None
        found = claimed(claims, self._settings.oidc_role_claim)
        for value, role in roles:
            if value == "*" or value in found:
                return role
        raise errors.NoRole(
            f"You signed in, but nothing in your claim {self._settings.oidc_role_claim!r} gives you a role on this "
            "server. Ask an administrator."
        )

    async def _fresh(self) -> Any:
        """Return authlib's client, with a description of the provider that is at most `FRESH_SECONDS` old."""
        if time.monotonic() < self._until:
            return self._client
        options = {"scope": self._settings.oidc_scope, "code_challenge_method": "S256", "timeout": TIMEOUT_SECONDS}
        client = self._new_client(
            framework=None,
            client_id=self._settings.oidc_client_id,
            client_secret=self._secret,
            server_metadata_url=f"{self.issuer.rstrip('/')}/.well-known/openid-configuration",
            client_kwargs=options,
        )
        try:
            metadata = await client.load_server_metadata()
            _check(metadata, self.issuer)
        except (httpx2.HTTPError, *self._faults) as error:
            raise _failed(self.issuer, error) from None
        ways = metadata.get("token_endpoint_auth_methods_supported", ["client_secret_basic"])
        if self._secret is not None and "client_secret_basic" not in ways and "client_secret_post" in ways:
            options["token_endpoint_auth_method"] = "client_secret_post"  # noqa: S105 - the name of a method, no secret
        self._client, self._until = client, time.monotonic() + FRESH_SECONDS
        return client


def open_provider(settings: Settings) -> Provider | None:
    """Return the provider of the settings; None if they name none.

    Raises:
        BadProvider: with one sentence for the operator.
    """
    return None if settings.oidc_issuer is None else Provider(settings, settings.oidc_issuer)


def provider_of(connection: HTTPConnection) -> Provider | None:
    """Return the provider of the app that serves a request."""
    return cast(Provider | None, connection.app.state.provider)


def claimed(claims: Claims, name: str) -> list[str]:
    """Return the texts in a claim, which is one text or a list; `a.b` is also the claim b in the claim a."""
    value: Any = claims.get(name)
    if value is None:
        value = claims
        for part in name.split("."):
            value = value.get(part) if isinstance(value, Mapping) else None
    listed = value if isinstance(value, list) else [value]
    return [one for one in listed if isinstance(one, str)]


def _secret(settings: Settings) -> str | None:
    if settings.oidc_client_secret is not None:
        return settings.oidc_client_secret.get_secret_value()
    if settings.oidc_client_secret_file is None:
        return None
    try:
        return settings.oidc_client_secret_file.read_text(encoding="utf-8").strip()
    except (OSError, ValueError) as error:
        raise BadProvider(f"WAYPOST_OIDC_CLIENT_SECRET_FILE cannot be read: {error}") from None


def _check(metadata: dict[str, Any], issuer: str) -> None:
    """Refuse the description of another provider, and leave only safe signatures in it."""
    if metadata["issuer"] != issuer:
        raise ValueError(f"it calls itself {metadata['issuer']!r}, so WAYPOST_OIDC_ISSUER must be exactly that")
    for endpoint in ("authorization_endpoint", "token_endpoint", "jwks_uri"):
        if not isinstance(metadata[endpoint], str):
            raise TypeError(f"its {endpoint} is no address")
    offered = metadata.get("id_token_signing_alg_values_supported", ["RS256"])
    metadata["id_token_signing_alg_values_supported"] = [one for one in offered if one in ALGORITHMS]


def _failed(issuer: str, error: Exception) -> errors.ProviderFailed:
    log.warning("The OpenID provider %s failed: %s: %s", issuer, type(error).__name__, _words(error))
    return errors.ProviderFailed("The provider of sign-ins cannot be used at the moment. Try again later.")


def _words(error: Exception) -> str:
    """Return an error in one line without what it may have read."""
    return str(error).partition("\n")[0][:200]
