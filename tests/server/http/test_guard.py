"""The outermost layer: sizes, media types, depth, hosts and headers."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.server.kit import API, Service, in_process

from waypost_server.http.guard import host_name

RUN = {
    "name": "x",
    "algorithm": "x",
    "seed": 0,
    "vocabulary": {"domain": "d", "subgoals": [], "actions": ["a"], "renderer": "r"},
}


@pytest.fixture
def small(sqlite_url: str) -> Iterator[Service]:
    with in_process(sqlite_url, max_body_bytes=10_000) as service:
        yield service


def post_run(service: Service, content: object, media_type: str = "application/json") -> tuple[int, str]:
    headers = service.learner.headers | {"Content-Type": media_type}
    reply = service.client.post(f"{API}/runs", content=content, headers=headers)
    assert reply.status_code < 400 or reply.headers["content-type"] == "application/problem+json"
    return reply.status_code, reply.json().get("type", "")


def test_an_oversize_body_is_refused(small: Service) -> None:
    assert post_run(small, b" " * 10_001) == (413, "/problems/body-too-large")
    chunks = iter([b" " * 6_000, b" " * 6_000])
    assert post_run(small, chunks) == (413, "/problems/body-too-large")
    assert post_run(small, json.dumps(RUN).encode().ljust(10_000))[0] == 201


@pytest.mark.parametrize("media_type", ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data", ""])
def test_a_body_that_does_not_say_it_is_json_is_refused(lite: Service, media_type: str) -> None:
    assert post_run(lite, json.dumps(RUN).encode(), media_type) == (415, "/problems/not-json")


def test_json_with_a_charset_is_json(lite: Service) -> None:
    assert post_run(lite, json.dumps(RUN).encode(), "Application/JSON; charset=utf-8")[0] == 201


@pytest.mark.parametrize(
    "config",
    [
        "[" * 100_000 + "]" * 100_000,
        '{"a":' * 300 + "1" + "}" * 300,
        '{"a": NaN}',
        '{"a": Infinity}',
        '{"a": 1e999}',
        '{"a": "\\ud800"}',
        '{"a": ' + "9" * 10_000 + "}",
        '{"a": 1',
        "",
        "{'a': 1}",
        '{"a": "\x00"}',
        '"\xff"',
    ],
)
def test_what_is_not_sound_json_is_refused(lite: Service, config: str) -> None:
    body = json.dumps(RUN)[:-1] + f', "config": {config}}}'
    assert post_run(lite, body.encode("latin-1"))[0] == 422


def test_json_as_deep_as_is_taken_can_be_read_back(lite: Service) -> None:
    config = '{"a":' * 190 + "1" + "}" * 190
    headers = lite.learner.headers | {"Content-Type": "application/json"}
    reply = lite.client.post(f"{API}/runs", content=json.dumps(RUN)[:-1] + f', "config": {config}}}', headers=headers)
    assert reply.status_code == 201
    assert json.dumps(lite.viewer.get(f"/runs/{reply.json()['id']}")["config"]).replace(" ", "") == config


@pytest.mark.parametrize("name", ["", "nul \u0000", "two\nlines", "x" * 101])
def test_a_name_is_one_short_line(service: Service, name: str) -> None:
    problem = service.learner.post("/runs", RUN | {"name": name}, 422)
    assert problem["errors"][0]["loc"] == ["body", "name"]


def test_large_and_odd_values_survive_the_store(service: Service) -> None:
    config = {"big": 10**400, "text": "\u0000\u2028 \U0001f9ed", "": [], "float": 1.7976931348623157e308, "n": -0.0}
    run = service.learner.create_run(config=config)
    assert service.viewer.get(f"/runs/{run}")["config"] == config


@pytest.mark.parametrize(
    ("host", "status"),
    [
        ("testserver", 200),
        ("localhost:8000", 200),
        ("127.0.0.1", 200),
        ("[::1]:80", 200),
        ("evil.example", 421),
        ("localhost.evil.example", 421),
        ("", 421),
        ("[::2]", 421),
        ('"><script>', 421),
    ],
)
def test_only_known_hosts_are_answered(lite: Service, host: str, status: int) -> None:
    headers = lite.viewer.headers | {"Host": host}
    assert lite.client.get(f"{API}/me", headers=headers).status_code == status
    assert lite.client.get("/healthz", headers={"Host": host}).status_code == 200


def test_host_names_are_read_without_their_port() -> None:
    names = ["a.b:80", "A", "[::1]:80", "[::1]", "::1", ""]
    assert [host_name(name) for name in names] == ["a.b", "a", "::1", "::1", "", ""]


def test_every_response_carries_the_security_headers(lite: Service) -> None:
    for path in ("/", "/healthz", f"{API}/me", f"{API}/nothing", "/assets/none.js"):
        headers = lite.client.get(path).headers
        policy = headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "frame-ancestors 'none'" in policy
        assert "unsafe" not in policy
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
    assert lite.client.get(f"{API}/me").headers["cache-control"] == "no-store"


def test_unknown_paths_and_methods_are_problems_too(lite: Service) -> None:
    assert lite.viewer.get("/nothing", 404)["type"] == "/problems/not-found"
    assert lite.viewer.call("PUT", "/runs", {}, 405)["type"] == "/problems/method-not-allowed"


def test_a_failure_of_the_server_says_nothing_of_its_inside(sqlite_url: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("secret")

    monkeypatch.setattr("waypost_server.runs.listing.list_runs", fail)
    with in_process(sqlite_url) as service:
        service.client._transport.raise_server_exceptions = False
        reply = service.client.get(f"{API}/runs", headers=service.viewer.headers)
    assert (reply.status_code, reply.json()["type"]) == (500, "/problems/internal-error")
    assert "secret" not in reply.text
    assert reply.headers["content-type"] == "application/problem+json"
    assert "default-src 'none'" in reply.headers["content-security-policy"]
    assert reply.headers["x-content-type-options"] == "nosniff"
    assert reply.headers["cache-control"] == "no-store"


# --- the page


def test_without_a_built_page_the_server_says_how_to_build_it(lite: Service, tmp_path: Path) -> None:
    with in_process(f"sqlite:///{tmp_path}/p.db", page=tmp_path) as service:
        replies = [service.client.get(path) for path in ("/", "/work")]
    assert [reply.status_code for reply in replies] == [200, 404]
    assert all("`make web` builds it" in reply.text for reply in replies)


@pytest.fixture
def paged(tmp_path: Path) -> Iterator[Service]:
    page = tmp_path / "dist"
    (page / "assets").mkdir(parents=True)
    (page / "index.html").write_text("<!doctype html><title>Waypost</title>")
    (page / "assets" / "index-abc123.js").write_text("export const x = 1;" * 2_000)
    chunks = {
        "index.html": {"file": "assets/index-abc123.js", "css": ["assets/index-d.css"], "imports": ["_common.js"]},
        "_common.js": {"file": "assets/common-e.js"},
        "src/app/RunsViews.svelte": {"file": "assets/RunsViews-f.js", "imports": ["index.html", "_common.js"]},
    }
    (page / "chunks.json").write_text(json.dumps(chunks))
    (tmp_path / "secret.txt").write_text("secret")
    with in_process(f"sqlite:///{tmp_path}/p.db", page=page) as service:
        yield service


def test_the_page_answers_every_address_that_is_not_the_apis(paged: Service) -> None:
    for path in ("/", "/work", "/runs/abc/queries", "/login"):
        reply = paged.client.get(path)
        assert (reply.status_code, reply.headers["content-type"]) == (200, "text/html; charset=utf-8")
        assert reply.headers["cache-control"] == "no-cache"
    assert paged.client.get("/api/v2/x").status_code == 404
    assert paged.client.get("/api").status_code == 404


def test_the_page_of_a_run_says_what_it_will_need_before_a_script_asks_for_it(paged: Service) -> None:
    files = ["/theme.js", "/assets/index-abc123.js", "/assets/index-d.css", "/assets/common-e.js"]
    files += ["/assets/RunsViews-f.js"]
    run = "/api/v1/runs/0a1b2c"
    data = ["/api/v1/me", run, f"{run}/costs", f"{run}/curves?after=-1&most=1000"]

    def ahead(path: str, **headers: str) -> list[str]:
        return re.findall("<(.*?)>", paged.client.get(path, headers=headers).headers.get("link", ""))

    assert ahead("/runs/0a1b2c") == files, "somebody who has not signed in may read no run"
    assert ahead("/runs/0a1b2c", cookie="waypost_session=x") == files + data
    for section in ("", "/queries", "/review", "/ledger"):
        assert ahead(f"/runs/0a1b2c{section}", **paged.viewer.headers) == files + data
    for other in ("/", "/work", "/runs", "/runs/compare", "/runs/0a1b2c/gold", "/runs/%3E%0D%0Aa"):
        assert ahead(other, **paged.viewer.headers) == []


def test_hashed_assets_are_cached_for_good_and_compressed(paged: Service) -> None:
    reply = paged.client.get("/assets/index-abc123.js", headers={"Accept-Encoding": "gzip"})
    assert "immutable" in reply.headers["cache-control"]
    assert "javascript" in reply.headers["content-type"]
    assert reply.headers["content-encoding"] == "gzip"
    plain = paged.client.get("/assets/index-abc123.js", headers={"Accept-Encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert reply.content == plain.content
    assert reply.headers["vary"] == plain.headers["vary"] == "Accept-Encoding"
    assert paged.client.get("/assets/index-gone.js").status_code == 404


@pytest.mark.parametrize(
    "path", ["/../secret.txt", "/%2e%2e/secret.txt", "/assets/..%2f..%2fsecret.txt", "/%00", "//etc/passwd"]
)
def test_nothing_outside_of_the_page_is_served(paged: Service, path: str) -> None:
    reply = paged.client.get(path)
    assert reply.text.strip() != "secret"
    assert "root:" not in reply.text
    assert reply.status_code in {200, 404}
