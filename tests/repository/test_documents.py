import ast
import re

import pytest
from tests.repository.kit import DOCUMENTS, ROOT, commands, complaint, invocations, name_of, options, shell_blocks

from waypost_server.settings import Settings

LINK = re.compile(r"\]\(([^)\s]+)\)")


def anchors(text: str) -> set[str]:
    """The addresses of a document's headings, as code hosts make them."""
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_every_link_leads_somewhere(document):
    broken = []
    for link in LINK.findall(re.sub(r"```.*?```", "", document.read_text(), flags=re.DOTALL)):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (document.parent / path) if path else document
        if not target.exists() or (anchor and anchor not in anchors(target.read_text())):
            broken.append(link)
    assert broken == []


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_every_make_target_in_a_document_exists(document):
    makefile = (ROOT / "Makefile").read_text()
    targets = set(re.findall(r"^([\w-]+):", makefile, re.MULTILINE))
    named = set(re.findall(r"(?:^|`)make ([a-z][\w-]*)", document.read_text(), re.MULTILINE))
    assert named <= targets


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_every_command_in_a_document_is_one_the_command_line_takes(document):
    wrong = {line: said for line in invocations(shell_blocks(document)) if (said := complaint(line))}
    assert wrong == {}


@pytest.mark.parametrize(
    "line", ["waypost bake", "waypost train", "waypost train h-bc --sed 1", "waypost user add a b"]
)
def test_a_wrong_command_would_be_noticed(line):
    assert complaint(line)


def test_commands_are_found_wherever_a_shell_has_them():
    text = "A=$(waypost token create bot) waypost oracle --defer 5 &\nwaypost serve   # waypost bake\n"
    assert invocations(text) == ["waypost token create bot", "waypost oracle --defer 5", "waypost serve"]


def sections(text: str) -> dict[str, str]:
    """What stands under each heading of the second level."""
    parts = re.split(r"^## (.+)$", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


@pytest.mark.parametrize(("name", "command"), list(commands()), ids=lambda one: one if isinstance(one, str) else "")
def test_the_command_line_is_documented_to_the_last_option(name, command):
    section = sections((ROOT / "docs" / "cli.md").read_text()).get(f"`{name}`")
    assert section is not None, f"docs/cli.md has no heading for `{name}`"
    missing = [one for one in options(command) if f"`{one}" not in section]
    assert missing == []
    gone = set(re.findall(r"^\| `(--[\w-]+)", section, re.MULTILINE)) - options(command)
    assert gone == set()


def test_no_command_is_documented_that_does_not_exist():
    documented = {name.strip("`") for name in sections((ROOT / "docs" / "cli.md").read_text()) if "waypost" in name}
    assert documented == {name for name, _ in commands()}


def test_every_setting_of_the_server_is_documented_and_no_other():
    text = (ROOT / "docs" / "operator.md").read_text()
    documented = set(re.findall(r"^\| `WAYPOST_(\w+)`", text, re.MULTILINE))
    assert documented == {name.upper() for name in Settings.model_fields}


PACKAGES = ("sdk/waypost", "server/waypost_server", "learner/waypost_learner")


def parts(package: str) -> list[str]:
    """The modules and folders directly in a package, as the map writes them."""
    found = sorted((ROOT / package).iterdir())
    folders = [f"{path.name}/" for path in found if path.is_dir() and any(path.glob("*.py"))]
    return [*folders, *(path.name for path in found if path.suffix == ".py" and path.name != "__init__.py")]


@pytest.mark.parametrize("package", PACKAGES)
def test_the_map_names_every_part_of_a_package(package):
    text = (ROOT / "ARCHITECTURE.md").read_text()
    table = text.partition(f"| `{package}` |")[2].partition("\n\n")[0]
    skipped = {"settings.py", "errors.py"}  # what every service has
    assert [part for part in parts(package) if f"`{part}`" not in table and part not in skipped] == []


def test_the_map_fits_two_screens():
    assert len((ROOT / "ARCHITECTURE.md").read_text().splitlines()) <= 120


@pytest.mark.parametrize("package", PACKAGES)
def test_every_module_says_in_its_first_line_what_it_does(package):
    silent = []
    for path in (ROOT / package).rglob("*.py"):
        if not (text := path.read_text().strip()):
            continue
        first = ast.get_docstring(ast.parse(text))
        if not first or not first.splitlines()[0].endswith((".", ".)")):
            silent.append(name_of(path))
    assert silent == []


@pytest.mark.parametrize("root", [*PACKAGES, "web/src", "tests"])
def test_no_folder_has_too_many_files_to_look_through(root):
    most = 17
    crowded = {}
    for folder in [ROOT / root, *(path for path in (ROOT / root).rglob("*") if path.is_dir())]:
        if folder.name in {"__pycache__", "node_modules"} or folder.match("db/migrations/versions"):
            continue  # migrations are a numbered sequence that only grows; one reads the newest
        entries = [path for path in folder.iterdir() if path.name not in {"__pycache__", "__init__.py", "py.typed"}]
        if len(entries) > most:
            crowded[name_of(folder)] = len(entries)
    assert crowded == {}


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_no_document_names_a_file_that_is_gone(document):
    if document.parent.name == "decisions" or document.name == "CHANGELOG.md":
        return  # they say how things were
    named = set(re.findall(r"`((?:sdk|server|learner|web|tests|docs|scripts|bench)/[\w./-]+)`", document.read_text()))
    named -= {"web/node_modules", "web/dist"}  # made by `make`
    assert [name for name in sorted(named) if not (ROOT / name).exists()] == []


def test_every_deviation_the_code_refers_to_is_in_the_paper_map():
    text = (ROOT / "docs" / "paper.md").read_text()
    numbered = {int(number) for number in re.findall(r"^(\d+)\. \*\*", text, re.MULTILINE)}
    assert numbered == set(range(1, len(numbered) + 1))
    sources = "".join(path.read_text() for path in (ROOT / "learner").rglob("*.py"))
    referred = {int(number) for number in re.findall(r"paper\.md, deviation (\d+)", sources)}
    assert referred <= numbered


def test_every_decision_has_its_four_parts():
    for record in (ROOT / "docs" / "decisions").glob("0*.md"):
        text = record.read_text()
        for part in ("Context", "Decision", "Consequences", "Alternatives"):
            assert f"## {part}\n" in text, f"{name_of(record)} lacks {part}"


def test_every_key_of_the_page_is_documented():
    registry = (ROOT / "web" / "src" / "keys" / "registry.ts").read_text()
    labels = re.findall(r"""label:\s*t\(\s*(?:'([^']+)'|"([^"]+)")""", registry)
    assert len(labels) > 15
    text = " ".join((ROOT / "docs" / "annotator.md").read_text().split())
    assert [one for pair in labels if (one := "".join(pair)) not in text] == []
