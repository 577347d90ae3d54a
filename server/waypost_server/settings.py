"""Every setting of the server; each is also an environment variable with the prefix `WAYPOST_`."""

from pathlib import Path
from typing import Annotated

from pydantic import Field, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict


class Settings(BaseSettings):
    """What an operator may choose."""

    model_config = SettingsConfigDict(env_prefix="WAYPOST_", extra="forbid", frozen=True)

    database: str = Field(
        default="sqlite:///waypost.db", description="SQLAlchemy URL: sqlite:///FILE or postgresql://..."
    )
    lease_seconds: float = Field(default=60.0, gt=0, description="How long an assignment lives without a renewal.")
    lease_cap_seconds: float = Field(default=3_600.0, gt=0, description="The longest renewals can keep one assignment.")
    presence_seconds: float = Field(
        default=15.0, gt=0, description="How long after asking an annotator counts as at work."
    )
    idle_seconds: float = Field(
        default=30.0, gt=0, description="The most that a gap between two signs of activity counts as active."
    )
    follow_up_seconds: float = Field(
        default=20.0, ge=0, description="How long a follow-up is kept for who is at work on its episode."
    )
    reap_seconds: float = Field(default=1.0, gt=0, description="How often expired leases are swept up.")
    poll_seconds: float = Field(
        default=0.5, gt=0, description="How often a long poll looks by itself (other processes)."
    )
    max_open_queries: int = Field(default=10_000, gt=0, description="Unanswered queries one run may have.")
    max_body_bytes: int = Field(default=4 * 2**20, gt=0, description="Largest request body.")
    max_frame_bytes: int = Field(default=2**20, gt=0, description="Largest picture of a state.")
    body_seconds: float = Field(default=30.0, gt=0, description="Longest time a request body may take to arrive.")
    link_seconds: float = Field(default=900.0, gt=0, description="How long a login link is good.")
    session_seconds: float = Field(default=30 * 86_400.0, gt=0, description="How long a browser stays logged in.")
    login_failures: int = Field(default=10, gt=0, description="Wrong login codes per client and minute before a pause.")
    hosts: Annotated[tuple[str, ...], NoDecode] = Field(
        default=(), description='Host names served besides loopback, comma-separated; "*" for any.'
    )
    secure_cookies: bool = Field(
        default=False, description="True behind an https proxy: the cookie travels on https only."
    )
    practice: Path | None = Field(
        default=None, description="Practice queries that `waypost practice` made; absent: those of the maze."
    )
    page: Path | None = Field(default=None, description="Folder of the built page; found by itself if absent.")

    @field_validator("hosts", mode="before")
    @classmethod
    def _split(cls, value: object) -> object:
        return tuple(name.strip() for name in value.split(",") if name.strip()) if isinstance(value, str) else value
