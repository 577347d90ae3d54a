"""What the documents say about forecasts agrees with the committed forecasts."""

import csv
import gzip
import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"


def test_the_totals_and_the_rows_of_the_runs_are_those_of_the_back_test() -> None:
    with gzip.open(DOCS / "results" / "forecast" / "backtest.csv.gz", "rt", newline="") as file:
        about = {"target": "0.9", "part": "0.25", "information": "all other runs"}
        quarter = [row for row in csv.DictReader(file) if about.items() <= row.items()]
    said = [row for row in quarter if row["too_early"] == "0"]
    held = [row for row in said if amount(row["low"]) <= amount(row["truth"]) <= amount(row["high"])]
    report = (DOCS / "forecast-results.md").read_text()
    totals = f"{len(held)} of {len(said)} runs"
    assert f"The 80 % range held {totals}" in report
    assert f"the 80 % range held {totals}" in (DOCS / "experimenter.md").read_text()
    rows = re.findall(r"^\| .*, seed \d+ \|.*\| (.*) \|$", report, re.MULTILINE)
    assert len(rows) == len(quarter)
    assert rows.count("yes") == len(held)
    assert rows.count("**no**") == len(said) - len(held)


def amount(cell: str) -> float:
    """Return units; an empty cell is infinite."""
    return float(cell) if cell else float("inf")
