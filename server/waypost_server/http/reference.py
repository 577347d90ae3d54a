"""The reference of the API as Markdown, written from the OpenAPI document: every call, message and error.

The server shows it at `/api/docs` (`page.py`), and the documentation site has it as a page.
"""

import json
import re
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

from waypost_server.http.description import SHARED

Json = dict[str, Any]

_LARGEST = 2**31 - 1  # a larger maximum says nothing to a reader
_METHODS = ("get", "post", "put", "patch", "delete")
_COMMON = {name for response in SHARED.values() for name in response["content"]["application/problem+json"]["examples"]}


def markdown(document: Json) -> str:
    """Return the reference. Every heading has its own address: its text as `slug` writes it."""
    parts = [_introduction(document), *_calls(document), *_messages(document), *_errors(document)]
    return "\n\n".join(parts) + "\n"


def slug(heading: str) -> str:
    """Return the address of a heading within the page, as MkDocs makes it."""
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", heading).strip().lower())


def _introduction(document: Json) -> str:
    info = document["info"]
    schemes = document["components"]["securitySchemes"]
    return "\n\n".join(
        [
            "# REST API",
            f"{info['title']} {info['version']}. This page lists every call, message and error. It is written from the "
            "server's OpenAPI document, `/api/v1/openapi.json`.",
            "Bodies and replies are JSON, unless a call says otherwise. A caller identifies itself in one of two ways:",
            f"- programs send `Authorization: Bearer wp_...`. {schemes['token']['description']}\n"
            f"- browsers send the cookie `{schemes['session']['name']}`. {schemes['session']['description']}",
        ]
    )


# --- calls


def _operations(document: Json) -> list[tuple[str, str, str, Json]]:
    """Return (tag, method, path, operation) of every call; the calls of a tag follow each other."""
    found = [
        (operation["tags"][0], method.upper(), path, operation)
        for path, item in document["paths"].items()
        for method, operation in item.items()
        if method in _METHODS
    ]
    order = list(dict.fromkeys(tag for tag, *_ in found))
    return sorted(found, key=lambda one: order.index(one[0]))


def _calls(document: Json) -> Iterator[str]:
    for tag, calls in groupby(_operations(document), key=lambda one: one[0]):
        yield f"## Calls: {tag}"
        for _, method, path, operation in calls:
            yield _call(f"{method} {path}", operation)


def _call(name: str, operation: Json) -> str:
    lines = [f"### `{name}`", operation["description"]]
    if "security" not in operation:
        lines.append("This call needs no login.")
    if parameters := operation.get("parameters"):
        rows = [
            (f"`{one['name']}`", one["in"], _type(one["schema"]), _meaning(one["schema"], one["required"], one))
            for one in parameters
        ]
        lines.append(_table(("parameter", "in", "type", "meaning"), rows))
    if "requestBody" in operation:
        lines.append(f"Body: {_content(operation['requestBody'])}.")
    answers = {status: one for status, one in operation["responses"].items() if status < "400"}
    lines += [f"Reply: {status}, {_content(answer)}." for status, answer in answers.items()]
    errors = [f"{status} {_error_links(names)}" for status, names in _own_errors(operation)]
    return "\n\n".join([*lines, f"Errors: {'; '.join(errors)}." if errors else ""]).strip()


def _own_errors(operation: Json) -> list[tuple[str, list[str]]]:
    """Return (status, names) of the errors that not every call can return."""
    found = {status: set(_examples(one)) - _COMMON for status, one in operation["responses"].items() if status >= "400"}
    return sorted((status, sorted(names)) for status, names in found.items() if names)


def _examples(response: Json) -> Json:
    """Return the examples of an error response, by the name of the error."""
    (content,) = response["content"].values()
    examples: Json = content["examples"]
    return examples


def _content(body: Json) -> str:
    """Return the type of a body or a reply, with its media type if it is not JSON."""
    texts = []
    for media_type, content in body.get("content", {}).items():
        text = _type(content.get("schema", {}))
        texts.append(text if media_type == "application/json" else f"`{media_type}`")
    return " or ".join(texts) or "no content"


def _error_links(names: list[str]) -> str:
    return ", ".join(f"[{name}](#{slug(f'Error {name}')})" for name in names)


# --- messages


def _messages(document: Json) -> Iterator[str]:
    yield "## Messages"
    for name, schema in sorted(document["components"]["schemas"].items()):
        if schema:  # an empty schema is any JSON value, which needs no explanation
            yield _message(name, schema)


def _message(name: str, schema: Json) -> str:
    required = schema.get("required", [])
    rows = [
        (f"`{field}`", _type(value), _meaning(value, field in required or "default" not in value))
        for field, value in schema.get("properties", {}).items()
    ]
    text = schema.get("description", "").strip() or "A message."
    return "\n\n".join([f"### {name}", text, _table(("field", "type", "meaning"), rows) if rows else _type(schema)])


def _meaning(schema: Json, required: bool, about: Json | None = None) -> str:
    """Return what a value means, its limits, and its default."""
    text = (about or schema).get("description") or schema.get("description", "")
    notes = [text, *_limits(schema)]
    if not required and "default" in schema:
        notes.append(f"Default: `{_json(schema['default'])}`.")
    elif not required:
        notes.append("Optional.")
    return " ".join(filter(None, notes))


def _limits(schema: Json) -> Iterator[str]:
    for member in schema.get("anyOf", [schema]):
        low, high = member.get("minimum"), member.get("maximum")
        if high is not None and high < _LARGEST:
            yield f"{low:,g} to {high:,g}." if low is not None else f"At most {high:,g}."
        elif low is not None:
            yield f"At least {low:g}."
        if "maxLength" in member:
            yield f"At most {member['maxLength']:,} characters."
        if "maxItems" in member:
            yield f"At most {member['maxItems']:,} items."


def _type(schema: Json) -> str:
    """Return the type of a value in words, with links to messages."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[-1]
        return "any JSON value" if name == "JsonValue" else f"[{name}](#{slug(name)})"
    if members := schema.get("anyOf") or schema.get("oneOf"):
        return " or ".join(dict.fromkeys(_type(member) for member in members))
    if "const" in schema:
        return f"`{_json(schema['const'])}`"
    if "enum" in schema:
        return ", ".join(f"`{_json(value)}`" for value in schema["enum"])
    if schema.get("type") == "array":
        return f"list of {_type(schema.get('items', {}))}"
    if schema.get("type") == "object":
        return f"object of {_type(schema.get('additionalProperties') or {})}"
    return str(schema.get("type", "any JSON value"))


# --- errors


def _errors(document: Json) -> Iterator[str]:
    """Yield each error once; the calls that can return it state it alike."""
    found = {
        name: (status, example["value"]["detail"])
        for *_, operation in _operations(document)
        for status, response in operation["responses"].items()
        if status >= "400"
        for name, example in _examples(response).items()
    }
    yield "## Errors"
    yield (
        f"Every error is a [Problem](#{slug('Problem')}), a document in the format of RFC 9457. Its `type` ends with "
        f"the name of the error, which never changes. Any call can return these: {_error_links(sorted(_COMMON))}."
    )
    for name, (status, detail) in sorted(found.items()):
        yield f"### Error {name}\n\nStatus {status}. {detail}"


# --- Markdown


def _json(value: Any) -> str:
    """Return a value as it is written in JSON; a string that is not empty, without its quotes."""
    return value if isinstance(value, str) and value else json.dumps(value)


def _table(heads: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    def line(cells: tuple[str, ...]) -> str:
        return "| " + " | ".join(" ".join(cell.split()).replace("|", "\\|") for cell in cells) + " |"

    return "\n".join([line(heads), "|" + "---|" * len(heads), *(line(row) for row in rows)])
