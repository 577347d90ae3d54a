"""The settings of the server. Each is also an environment variable with the prefix `WAYPOST_`."""

from ipaddress import IPv4Network, IPv6Network
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AnyHttpUrl, Field, SecretStr, TypeAdapter, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

from waypost.wire import Role

LOOPBACK = ("localhost", "127.0.0.1", "[::1]")


class Settings(BaseSettings):
    """The settings that an operator can change."""

    model_config = SettingsConfigDict(env_prefix="WAYPOST_", extra="forbid", frozen=True)

    database: str = Field(
        default="sqlite:///waypost.db", description="SQLAlchemy URL: sqlite:///FILE or postgresql://..."
    )
    lease_seconds: float = Field(default=60.0, gt=0, description="How long a lease lasts without a renewal.")
    lease_cap_seconds: float = Field(default=3_600.0, gt=0, description="How long renewals can keep one lease valid.")
    presence_seconds: float = Field(
        default=15.0, gt=0, description="How long an annotator counts as at work after asking for a query."
    )
    idle_seconds: float = Field(
        default=30.0, gt=0, description="The maximum time counted as active between two signs of activity."
    )
    follow_up_seconds: float = Field(
        default=20.0,
        ge=0,
        description="How long a follow-up query is reserved for the annotator whose answer it follows.",
    )
    reap_seconds: float = Field(default=1.0, gt=0, description="The interval between two removals of expired leases.")
    poll_seconds: float = Field(
        default=0.5,
        gt=0,
        description="The interval at which a long poll reads the store when nothing wakes it.",
    )
    max_open_queries: int = Field(default=10_000, gt=0, description="The maximum number of unanswered queries per run.")
    max_user_open_queries: int = Field(
        default=100_000, gt=0, description="The maximum number of unanswered queries in all runs of one user."
    )
    max_user_frame_bytes: int = Field(
        default=10 * 2**30, gt=0, description="The maximum size of all pictures that one user uploads."
    )
    max_body_bytes: int = Field(default=4 * 2**20, gt=0, description="The maximum size of a request body.")
    max_frame_bytes: int = Field(default=2**20, gt=0, description="The maximum size of a picture of a state.")
    body_seconds: float = Field(default=30.0, gt=0, description="The maximum time to receive a request body.")
    drain_seconds: float = Field(
        default=0.0, ge=0, description="How long the server still serves after SIGTERM, when it is no longer ready."
    )
    link_seconds: float = Field(default=900.0, gt=0, description="How long a login link is valid.")
    session_seconds: float = Field(
        default=30 * 86_400.0, gt=0, description="How long a browser stays logged in after its last use."
    )
    session_max_seconds: float = Field(
        default=90 * 86_400.0, gt=0, description="How long a browser stays logged in at most, however often it is used."
    )
    login_failures: int = Field(
        default=10, gt=0, description="The maximum number of wrong login codes per client and minute."
    )
    hosts: Annotated[tuple[str, ...], NoDecode] = Field(
        default=(), description='Host names served in addition to loopback, comma-separated; "*" for any.'
    )
    secure_cookies: bool = Field(
        default=False, description="True behind an https proxy: browsers send the cookie over https only."
    )
    trusted_proxies: Annotated[tuple[IPv4Network | IPv6Network, ...], NoDecode] = Field(
        default=(),
        description="Addresses of proxies whose X-Forwarded-For and X-Forwarded-Proto are believed, comma-separated.",
    )
    log_format: Literal["text", "json"] = Field(
        default="text", description="The format of the log: lines of text, or one JSON object per line."
    )
    log_requests: bool = Field(default=False, description="Whether each request has a line in the log.")
    webhook_hosts: Annotated[tuple[str, ...], NoDecode] = Field(
        default=(), description="Hosts that webhooks may call: NAME[:PORT], comma-separated; *.NAME for subdomains."
    )
    webhook_networks: Annotated[tuple[IPv4Network | IPv6Network, ...], NoDecode] = Field(
        default=(), description="Ranges of private addresses that webhooks may call, comma-separated: 10.1.0.0/16."
    )
    webhook_seconds: float = Field(default=10.0, gt=0, description="The maximum time of one webhook call.")
    webhook_retry_seconds: float = Field(
        default=5.0, gt=0, description="The pause of a webhook after its first failure; it doubles with each failure."
    )
    webhook_give_up_seconds: float = Field(
        default=3 * 86_400.0, gt=0, description="How long a message is tried before it is given up."
    )
    webhook_off_seconds: float = Field(
        default=5 * 86_400.0, gt=0, description="How long a webhook may fail before it is turned off."
    )
    oidc_issuer: str | None = Field(
        default=None, description="The address of the OpenID provider at which people may sign in, as it names itself."
    )
    oidc_client_id: str = Field(default="waypost", description="The id with which the provider knows this server.")
    oidc_client_secret: SecretStr | None = Field(
        default=None, description="The secret that the provider gave this server; none for a public client."
    )
    oidc_client_secret_file: Path | None = Field(default=None, description="A file with this secret, instead of it.")
    oidc_name: str = Field(
        default="single sign-on", min_length=1, max_length=100, description="What the login page calls the provider."
    )
    oidc_scope: str = Field(
        default="openid profile", pattern=r"\bopenid\b", description="The scopes that the provider is asked for."
    )
    oidc_role_claim: str = Field(
        default="roles", description="The claim of the ID token with a person's roles; a.b for claim b in claim a."
    )
    oidc_roles: Annotated[tuple[tuple[Annotated[str, Field(min_length=1)], Role], ...], NoDecode] = Field(
        default=(),
        description="VALUE=ROLE, comma-separated: the first VALUE in the claim gives the ROLE, and * fits everybody.",
    )
    oidc_create: bool = Field(default=False, description="Whether somebody unknown who signs in becomes a user.")
    practice: Annotated[tuple[Path, ...], NoDecode] = Field(
        default=(),
        description="Files that `waypost practice` wrote, comma-separated, one for each domain; "
        "without any, people practice on mazes.",
    )
    page: Path | None = Field(
        default=None, description="The folder of the built web app; the default is found automatically."
    )

    @field_validator("hosts", "trusted_proxies", "webhook_hosts", "webhook_networks", "practice", mode="before")
    @classmethod
    def _split(cls, value: object) -> object:
        return tuple(name.strip() for name in value.split(",") if name.strip()) if isinstance(value, str) else value

    @field_validator("oidc_issuer")
    @classmethod
    def _is_secure(cls, issuer: str | None) -> str | None:
        if issuer is not None:
            url = TypeAdapter(AnyHttpUrl).validate_python(issuer)
            if url.scheme != "https" and url.host not in LOOPBACK:
                raise ValueError("must begin with https://, except on this machine")
        return issuer

    @field_validator("oidc_roles", mode="before")
    @classmethod
    def _pairs(cls, value: object) -> object:
        if not isinstance(value, str):
            return value
        pairs = [one.rpartition("=") for one in value.split(",") if one.strip()]
        return tuple((claimed.strip(), role.strip()) for claimed, _, role in pairs)
