"""The page at `/api/docs`: the reference of the API for people, without scripts.

Swagger UI and its like are applications of 1.5 MB or more. This page is a document: it needs no script, follows the
system's light or dark theme, and meets the same content security policy and the same rules of accessibility as the web
app. Its address in the API is open to everyone, as is the OpenAPI document that it shows.
"""

from functools import cache
from html import escape
from itertools import pairwise
from pathlib import Path

from fastapi import FastAPI
from fastapi.responses import HTMLResponse, Response
from markdown_it import MarkdownIt
from markdown_it.token import Token

from waypost_server.http import reference

DOCS = "/api/docs"
STYLE = f"{DOCS}/style.css"

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Waypost: REST API</title>
<link rel="icon" href="/favicon.svg" type="image/svg+xml">
<link rel="stylesheet" href="{style}">
</head>
<body>
<a class="skip" href="#rest-api">Skip the list of contents</a>
<nav aria-label="Contents" tabindex="0">
{contents}
<p><a href="{document}">The OpenAPI document</a></p>
</nav>
<main>
{body}
</main>
</body>
</html>
"""


def install(app: FastAPI) -> None:
    """Serve the page and its style sheet."""

    @cache
    def page() -> str:
        return html(app.openapi(), app.openapi_url or "")

    @app.get(DOCS, include_in_schema=False)
    def api_docs() -> HTMLResponse:
        return HTMLResponse(page())

    @app.get(STYLE, include_in_schema=False)
    def api_docs_style() -> Response:
        return Response((Path(__file__).parent / "page.css").read_bytes(), media_type="text/css")


def html(document: reference.Json, address: str) -> str:
    """Return the page for an OpenAPI document that is served at `address`."""
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    tokens = parser.parse(reference.markdown(document))
    headings = _name_headings(tokens)
    return _PAGE.format(
        style=STYLE,
        document=escape(address),
        contents=_contents(headings),
        body=parser.renderer.render(tokens, parser.options, {}),
    )


def _name_headings(tokens: list[Token]) -> list[tuple[str, str]]:
    """Give every heading its address; return (tag, text) of each, such as ("h2", "Messages")."""
    headings = []
    for opening, inline in pairwise(tokens):
        if opening.type == "heading_open":
            text = "".join(child.content for child in inline.children or [])
            opening.attrSet("id", reference.slug(text))
            headings.append((opening.tag, text))
    return headings


def _contents(headings: list[tuple[str, str]]) -> str:
    """Return the list of contents: each section, with its entries below it."""
    parts = []
    for tag, text in headings[1:]:  # the first is the title
        link = f'<a href="#{reference.slug(text)}">{escape(text)}</a>'
        parts.append(f"</ul>\n<p>{link}</p>\n<ul>" if tag == "h2" else f"<li>{link}</li>")
    return "\n".join(parts).removeprefix("</ul>\n") + "\n</ul>"
