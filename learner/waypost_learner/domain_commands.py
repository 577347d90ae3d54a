"""The commands `waypost domain list`, `waypost domain check` and `waypost domain build`.

Each command imports the packages that it needs when it runs.
"""

import json
from pathlib import Path
from typing import Annotated

import typer

from waypost_learner.commands import JsonOption, learner_errors, refuse
from waypost_learner.progress import BuildingProgress

app = typer.Typer(no_args_is_help=True, help="Domains: the installed ones, and checks of your own.")


@app.command("list")
def list_domains() -> None:
    """List the installed domains."""
    with learner_errors():
        from waypost.domains import installed

        for name in installed():
            typer.echo(name)


@app.command("check")
def check_domain(
    name: Annotated[str, typer.Argument(help="The domain's name, or MODULE:ATTRIBUTE if it is not installed.")],
    as_json: JsonOption = False,
) -> None:
    """Check that a domain keeps the contract, and explain what fails. The exit status is 1 if something fails."""
    with learner_errors():
        from waypost.domains.conformance import check_domain as check

        results = check(name)
    if as_json:
        typer.echo(json.dumps([vars(result) for result in results]))
    else:
        for result in results:
            typer.echo(f"{'FAILS' if result.failures else 'ok   '}  {result.check}")
            for failure in result.failures:
                typer.echo(f"       {failure}")
    if results[-1].failures:
        raise typer.Exit(1)


@app.command("build")
def build_domain(
    name: Annotated[str, typer.Argument(help="The domain's name, or MODULE:ATTRIBUTE if it is not installed.")],
    file: Annotated[Path, typer.Argument(help="The file to write.")],
) -> None:
    """Compute the data that a domain's oracle looks up. An interrupted command continues when it is given again."""
    with learner_errors("Interrupted. The same command continues where it stopped."):
        from waypost.domains import Computed, find_domain

        domain = find_domain(name)
        if not isinstance(domain, Computed):
            refuse(f"The domain {domain.name!r} has no data to compute.")
        with BuildingProgress() as progress:
            domain.build(file, progress.show)
    typer.echo(f"The data is in {file}.")
