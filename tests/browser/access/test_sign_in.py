"""Signing in at an OpenID provider, from another site, in a real browser."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Complaints
from tests.server.auth.provider import SECRET, FakeProvider, provider

from waypost_server import serving
from waypost_server.serving import Served
from waypost_server.settings import Settings


@pytest.fixture
def fake() -> Iterator[FakeProvider]:
    with provider("localhost") as fake:  # another site than 127.0.0.1, at which the server is
        yield fake


@pytest.fixture
def signing(built_page: Path, tmp_path: Path, fake: FakeProvider) -> Iterator[Served]:
    """A server where people sign in at the provider."""
    settings = Settings(
        database=f"sqlite:///{tmp_path / 'signing.db'}",
        page=built_page,
        oidc_issuer=fake.issuer,
        oidc_client_secret=SECRET,
        oidc_name="Example SSO",
        oidc_create=True,
        oidc_roles="watchers=viewer",
    )
    with serving.background(settings) as served:
        yield served


def test_a_person_signs_in_logs_out_and_signs_in_again(
    signing: Served, open_page: Open, fake: FakeProvider, complaints: Complaints
) -> None:
    complaints.expect("401")  # a page without a session asks who it is
    fake.claims["roles"] = ["watchers"]
    page = open_page("/me", role=None, at=signing)
    page.get_by_role("link", name="the sign-in page").click()
    page.get_by_role("button", name="Sign in with Example SSO").click()
    page.wait_for_url("**/runs")
    assert [cookie["name"] for cookie in page.context.cookies(signing.url)] == ["waypost_session"]
    page.goto("/me")
    expect(page.get_by_role("heading", name="zoe")).to_be_visible()
    page.get_by_role("button", name="Log out", exact=True).click()
    page.get_by_role("button", name="Sign in with Example SSO").click()
    page.wait_for_url("**/runs")


def test_a_person_without_a_role_reads_why_and_the_code_is_gone_from_the_address(
    signing: Served, open_page: Open, fake: FakeProvider, complaints: Complaints
) -> None:
    complaints.expect("401")
    fake.claims["roles"] = ["others"]
    page = open_page("/login", role=None, at=signing)
    page.get_by_role("button", name="Sign in with Example SSO").click()
    expect(page.get_by_role("heading", name="You have no role on this server")).to_be_visible()
    assert page.url == f"{signing.url}/login"
    fake.claims["roles"] = ["watchers"]
    page.get_by_role("button", name="Sign in with Example SSO").click()
    page.wait_for_url("**/runs")


def test_a_provider_that_is_down_can_be_tried_again(
    signing: Served, open_page: Open, fake: FakeProvider, complaints: Complaints
) -> None:
    complaints.expect("502")
    issuer, fake.issuer = fake.issuer, "http://localhost/elsewhere"
    fake.claims["roles"] = ["watchers"]
    page = open_page("/login", role=None, at=signing)
    page.get_by_role("button", name="Sign in with Example SSO").click()
    expect(page.get_by_role("heading", name="Signing in is not possible now")).to_be_visible()
    fake.issuer = issuer
    page.get_by_role("button", name="Try again").click()
    page.wait_for_url("**/runs")
