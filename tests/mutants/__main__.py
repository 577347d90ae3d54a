"""Changes the server's core in small ways, and counts the changes that no test notices: `make mutants`."""

import json
import os
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

import typer
from tests.mutants.groups import GROUPS, Group

from waypost_server.db.engine import Database

ROOT = Path(__file__).parents[2]
SURVIVED, NO_TEST, NOT_RUN = 0, 33, None  # mutmut's verdicts; every other one means that a test noticed the mutant
COLUMNS = ("mutants", "killed", "survived", "without a test", "not run", "score")


def mutants(
    only: Annotated[str | None, typer.Option(help="The only group of modules to change.")] = None,
    children: Annotated[int, typer.Option(min=1, help="How many processes run tests.")] = 2,
    again: Annotated[bool, typer.Option(help="Try those again that no test noticed.")] = False,
    tenth: Annotated[bool, typer.Option(help="Try only every tenth: those with a number that ends with 3.")] = False,
    folder: Annotated[Path, typer.Option(help="Where the changed copies are.")] = ROOT / ".mutants",
) -> None:
    """Run the tests on each mutant, go on where an earlier call stopped, and print a table and the survivors."""
    chosen = {name: group for name, group in GROUPS.items() if only in {None, name}}
    if not chosen:
        raise typer.BadParameter(f"There is no group {only!r}. There are: {', '.join(GROUPS)}.")
    for name, group in chosen.items():
        prepare(folder / name, group)
        if again:
            forget_survivors(folder / name)
        mutate(folder / name, children, sample(folder / name) if tenth else [])
        try_at_import(folder / name, group)
    verdicts = [one for name in chosen for one in verdicts_in(folder / name)]
    typer.echo(table(verdicts))
    for mutant in sorted(mutant for _, mutant, verdict in verdicts if verdict in {SURVIVED, NO_TEST}):
        typer.echo(mutant)


def prepare(folder: Path, group: Group) -> None:
    """Copy the package, which must be at the top because mutmut names mutants by their path; tests and documents."""
    leave_out = shutil.ignore_patterns("__pycache__", "static")
    for source in (ROOT / "server" / "waypost_server", ROOT / "tests", ROOT / "docs"):
        shutil.copytree(source, folder / source.name, ignore=leave_out, dirs_exist_ok=True)
    (folder / "pyproject.toml").write_text(group.settings())
    store = folder / "empty.db"
    store.unlink(missing_ok=True)
    Database(f"sqlite:///{store}").close()


def sample(folder: Path) -> list[str]:
    """Return the names of every tenth mutant that was not tried yet, or a pattern of them if no names are known."""
    names = [mutant for _, mutant, verdict in verdicts_in(folder) if verdict is NOT_RUN and mutant.endswith("3")]
    return names or ["*3"]


def mutate(folder: Path, children: int, chosen: list[str]) -> None:
    """Run mutmut in a prepared folder, on all mutants that were not tried yet or on the chosen ones."""
    command = [sys.executable, "-m", "mutmut", "run", "--max-children", str(children), *chosen]
    subprocess.run(command, cwd=folder, env=environment(folder), check=True)


def environment(folder: Path) -> dict[str, str]:
    """Return the environment in which the tests find the changed server, and the packages that it needs."""
    paths = [str(ROOT / "sdk"), str(ROOT / "learner"), os.environ.get("PYTHONPATH", "")]
    packages = os.pathsep.join(path for path in paths if path)
    return os.environ | {"PYTHONPATH": packages, "WAYPOST_TEST_STORE": str(folder / "empty.db")}


def try_at_import(folder: Path, group: Group) -> None:
    """Try again, each in a new process, the mutants of functions that run when their module is imported.

    Mutmut chooses a mutant after the import, when such a function has run without a change.
    """
    paths = f"{folder / 'mutants'}{os.pathsep}{environment(folder)['PYTHONPATH']}"
    for file in sorted((folder / "mutants").rglob("*.meta")):
        data = json.loads(file.read_text())
        for mutant, verdict in data["exit_code_by_key"].items():
            tests = group.tests_at_import.get(mutant.partition("__mutmut_")[0])
            if verdict in {SURVIVED, NO_TEST} and tests is not None:
                changed = environment(folder) | {"PYTHONPATH": paths, "MUTANT_UNDER_TEST": mutant}
                command = [sys.executable, "-m", "pytest", "-x", "-q", *group.pytest_options(), *tests]
                done = subprocess.run(command, cwd=folder / "mutants", env=changed, stdout=subprocess.DEVNULL)
                data["exit_code_by_key"][mutant] = done.returncode
        file.write_text(json.dumps(data))


def verdicts_in(folder: Path) -> Iterable[tuple[str, str, int | None]]:
    """Return each mutant with its module and its verdict."""
    top = folder / "mutants" / "waypost_server"
    for file in sorted(top.rglob("*.meta")):
        for mutant, verdict in json.loads(file.read_text())["exit_code_by_key"].items():
            yield str(file.relative_to(top).with_suffix("")), mutant, verdict


def forget_survivors(folder: Path) -> None:
    """Forget the verdicts on mutants that no test noticed."""
    for file in (folder / "mutants").rglob("*.meta"):
        data = json.loads(file.read_text())
        known = data["exit_code_by_key"]
        data["exit_code_by_key"] = {
            one: NOT_RUN if code in {SURVIVED, NO_TEST} else code for one, code in known.items()
        }
        file.write_text(json.dumps(data))


def table(verdicts: Iterable[tuple[str, str, int | None]]) -> str:
    """Return the counts by module as a table in Markdown."""
    counts: dict[str, Counter[str]] = {}
    for module, _, verdict in verdicts:
        what = {SURVIVED: "survived", NO_TEST: "without a test", NOT_RUN: "not run"}.get(verdict, "killed")
        for row in (module, "all"):
            counts.setdefault(row, Counter()).update(("mutants", what))
    rows = [["module", *COLUMNS], ["---"] * (len(COLUMNS) + 1)]
    for module in sorted(counts, key=lambda name: (name == "all", name)):
        found = counts[module]
        score = f"{100 * found['killed'] / found['mutants']:.1f} %"
        rows.append([module, *(f"{found[column]:,}" for column in COLUMNS[:-1]), score])
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


if __name__ == "__main__":
    typer.run(mutants)
