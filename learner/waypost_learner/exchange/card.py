"""Writes the data card of an export: what the data are, who gave them, what they cost, and what each field means."""

import json
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import version

from waypost import wire
from waypost_learner.exchange.tally import Tally

FILE = "README.md"


def card(tally: Tally, form: str, fields: str, command: str, names: bool) -> str:
    """Return the card in Markdown.

    Args:
        tally: the sums over the exported records.
        form: the name of the format.
        fields: the description of its fields.
        command: the command that made the export.
        names: whether annotators have their names in the data.
    """
    assert tally.run is not None
    run = tally.run
    parts = [
        f"# {run.name}",
        f"Labels of one run of Waypost {version('waypost')}, in the format `{form}`. The command that wrote them:",
        f"```sh\n{command}\n```",
        "## The run",
        _table(("fact", "value"), _facts(run, tally)),
        "The learner was told what these values say. `preset` names a set of learning parameters. `values` replaces "
        "some of them.",
        f"```json\n{json.dumps(run.config, indent=2)}\n```",
        "## Queries and their cost",
        _costs(tally),
        f"Prices in units: {', '.join(f'{name} {price:g}' for name, price in run.prices.model_dump().items())}. "
        "`seconds` is the time from lease to answer, `active seconds` the working time without idle time.",
        "## Annotators",
        "The data contain the annotators' names."
        if names
        else "Annotators have pseudonyms, numbered by their first appearance in this run.",
        _table(("annotator", "answers"), [(name, str(n)) for name, n in sorted(tally.annotators.items())]),
        "## Fields",
        fields,
        "## License",
        "Not stated. The owner of the data decides under which license others may use them, and writes it here.",
    ]
    return "\n\n".join(parts) + "\n"


def _facts(run: wire.Run, tally: Tally) -> list[tuple[str, str]]:
    return [
        ("id", f"`{run.id}`"),
        ("algorithm", run.algorithm),
        ("domain", run.vocabulary.domain),
        ("seed", str(run.seed)),
        ("state", run.state if run.state == "finished" else f"{run.state}: the data are incomplete"),
        ("created", _day(run.created_at)),
        ("finished", "-" if run.finished_at is None else _day(run.finished_at)),
        ("episodes", str(tally.episodes)),
        ("subgoals", ", ".join(run.vocabulary.subgoals) or "none"),
        ("actions", ", ".join(run.vocabulary.actions)),
    ]


def _costs(tally: Tally) -> str:
    rows = [
        (
            kind,
            str(sums.queries),
            str(sums.answers),
            f"{sums.units:g}",
            f"{max(sums.seconds, 0):.1f}",
            f"{max(sums.active_seconds, 0):.1f}",
        )
        for kind, sums in tally.kinds.items()
    ]
    return _table(("kind", "queries", "answers", "units", "seconds", "active seconds"), rows)


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cell.replace('|', '/') for cell in line)} |" for line in lines)


def _day(seconds: float) -> str:
    return f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d}"
