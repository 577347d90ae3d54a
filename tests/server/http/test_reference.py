"""The reference at /api/docs: complete, and without a link that leads nowhere."""

from html.parser import HTMLParser

import pytest
from tests.server.kit import Service

from waypost_server.app import create_app
from waypost_server.http.reference import Json
from waypost_server.settings import Settings


class Read(HTMLParser):
    """The addresses, links and text of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.tags: set[str] = set()
        self.text = ""
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        for name, value in attrs:
            if name == "id":
                self.ids.append(value or "")
            elif tag == "a" and name == "href":
                self.links.append(value or "")
            elif name in {"src", "href"}:
                self.loaded.append(value or "")

    def handle_data(self, data: str) -> None:
        self.text += data


@pytest.fixture
def page(lite: Service) -> Read:
    reply = lite.client.get("/api/docs")
    assert reply.status_code == 200
    assert reply.headers["content-type"] == "text/html; charset=utf-8"
    return Read(reply.text)


@pytest.fixture(scope="module")
def document() -> Json:
    return create_app(Settings(database="sqlite:///never-opened.db")).openapi()


def test_it_names_every_call_message_and_error(page: Read, document: Json) -> None:
    for path, item in document["paths"].items():
        for method, operation in item.items():
            assert f"{method.upper()} {path}" in page.text
            for response in operation["responses"].values():
                for content in response.get("content", {}).values():
                    for name in content.get("examples", {}) if "problem" in str(content) else []:
                        assert f"error-{name}" in page.ids
    messages = [name for name, schema in document["components"]["schemas"].items() if schema]
    assert len(messages) > 90
    assert {name.lower() for name in messages} <= set(page.ids)


def test_it_names_every_field_of_a_message_with_its_type_and_meaning(page: Read) -> None:
    text = " ".join(page.text.partition("A request for the next query, sent by an annotator.")[2].split())
    assert "wait number The longest time to wait for a query, in seconds. 0 to 60. Default: 0." in text
    assert "kinds list of hier_demo, inspect_full, label_hi, inspect_lo, label_lo, label_full or null" in text


def test_every_link_within_it_leads_to_one_place(page: Read) -> None:
    assert len(page.ids) == len(set(page.ids))
    within = {link.removeprefix("#") for link in page.links if link.startswith("#")}
    assert len(within) > 150
    assert within <= set(page.ids)


def test_all_that_it_loads_is_there_and_it_has_no_script(lite: Service, page: Read) -> None:
    assert "script" not in page.tags
    own = [link for link in {*page.links, *page.loaded} if not link.startswith("#")]
    assert set(own) == {"/api/docs/style.css", "/api/v1/openapi.json", "/favicon.svg"}
    assert lite.client.get("/api/docs/style.css").headers["content-type"] == "text/css; charset=utf-8"
    assert lite.client.get("/api/v1/openapi.json").status_code == 200


def test_an_address_of_the_api_that_does_not_exist_names_the_reference(lite: Service) -> None:
    reply = lite.client.get("/api/v1/no-such-call")
    assert reply.status_code == 404
    assert "/api/docs" in reply.json()["detail"]
