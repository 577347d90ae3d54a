"""Every code block of every document works: it is run, or parsed, or says why not and what checks it instead."""

import json
import shutil
import tomllib
from contextlib import ExitStack
from pathlib import Path

import pytest
import yaml
from tests.acceptance.processes import ServerProcess
from tests.repository.kit import ROOT, name_of
from tests.site.blocks import LANGUAGES, PAGES, Block, beside_server, blocks, shortened
from tests.site.session import DATABASE, session

from waypost import wire

BLOCKS = [block for page in PAGES for block in blocks(page)]
PARSERS = {"json": json.loads, "toml": tomllib.loads, "yaml": yaml.safe_load}
MOST_NOT_RUN = 19


def runs(block: Block) -> bool:
    return block.language in {"sh", "python"} and not block.not_run


def test_every_block_has_a_language_and_only_comments_that_mean_something():
    assert len(BLOCKS) > 25
    assert {block.place: block.language for block in BLOCKS if block.language not in LANGUAGES} == {}
    assert {block.place: block.unknown_comments for block in BLOCKS if block.unknown_comments} == {}


def test_few_blocks_are_not_run_and_each_names_the_test_that_checks_it():
    listed = {block.place: block.not_run for block in BLOCKS if block.not_run}
    assert len(listed) <= MOST_NOT_RUN, listed
    assert {place: str(file) for place, (_, file) in listed.items() if not file.is_file()} == {}


@pytest.mark.parametrize("block", [one for one in BLOCKS if one.language in PARSERS], ids=lambda block: block.place)
def test_data_can_be_parsed(block):
    PARSERS[block.language](block.text)


@pytest.mark.timeout(1_200)  # a busy machine is not a broken page
@pytest.mark.parametrize("page", [page for page in PAGES if any(map(runs, blocks(page)))], ids=name_of)
def test_the_blocks_of_a_page_run_one_after_the_other(page, tmp_path, request):
    with ExitStack() as stack:
        opened = stack.enter_context(session(tmp_path))
        for name in ("docs", "examples"):
            if any(f"{name}/" in block.tested for block in blocks(page) if runs(block)):
                shutil.copytree(ROOT / name, opened.folder / name, ignore=shutil.ignore_patterns("images"))
        if DATABASE in page.read_text():
            opened.postgresql = request.getfixturevalue("cluster").create_empty()
        if beside_server(page):
            stack.callback(server_with_a_query(opened.folder, opened.port).stop)
        for block in blocks(page):
            if runs(block):
                opened.run(block)
        written = opened.folder / page.relative_to(ROOT)
        assert not written.exists() or written.read_text() == page.read_text()  # a page that a command writes


def server_with_a_query(folder: Path, port: int) -> ServerProcess:
    """A server on the page's store, and one Inspect_FULL that nobody has answered."""
    server = ServerProcess(folder, port)
    server.start()
    learner = server.client("page-learner", "learner")
    vocabulary = wire.Vocabulary(domain="maze", subgoals=["north"], actions=["up"], renderer="maze")
    run = learner.create_run(wire.RunCreate(name="a run", algorithm="hg-dagger", seed=0, vocabulary=vocabulary))
    segment = wire.Segment(subgoal="north", states=[[2, 1], [1, 1]], actions=["up"])
    question = {"episode": 0, "ordinal": 0, "question": "Did it do the whole task?"}
    learner.ask(
        run.id, [wire.AskInspectFull(kind="inspect_full", instance={"goal": [1, 1]}, segments=[segment], **question)]
    )
    return server


# --- the rules themselves


def page_of(tmp_path: Path, text: str) -> list[Block]:
    page = tmp_path / "page.md"
    page.write_text(text)
    return blocks(page)


def test_a_block_that_fails_would_be_noticed(tmp_path):
    failing = [
        Block("a:1", "sh", "true | false | true"),
        Block("a:2", "python", "1 / 0"),
        Block("a:3", "sh", "nothing-by-this-name"),
    ]
    for number, block in enumerate(failing):
        with session(tmp_path_of(tmp_path, number)) as opened, pytest.raises(AssertionError, match=block.place):
            opened.run(block)


def tmp_path_of(folder: Path, number: int) -> Path:
    own = folder / str(number)
    own.mkdir()
    return own


def test_a_program_that_should_run_on_but_ends_would_be_noticed(tmp_path):
    page = [Block("a:1", "sh", "true", ("runs until it is stopped",)), Block("a:2", "sh", "sleep 1")]
    with pytest.raises(AssertionError, match="ended"), session(tmp_path) as opened:
        list(map(opened.run, page))


def test_later_blocks_see_what_earlier_ones_exported_and_printed(tmp_path):
    with session(tmp_path) as opened:
        opened.run(Block("a:1", "sh", 'export COLOR=red; echo "Run 0123456789ab: done"; echo wp_secret'))
        opened.run(Block("a:2", "sh", 'test "$COLOR RUN wp_..." = "red 0123456789ab wp_secret"'))
        opened.run(Block("a:3", "python", "import os\nseen = os.environ['COLOR']"))
        opened.run(Block("a:4", "python", "assert seen == 'red'"))


def test_comments_before_a_block_are_read_and_others_are_not(tmp_path, monkeypatch):
    monkeypatch.setattr("tests.site.blocks.name_of", lambda page: page.name)
    block = "```sh\necho 1\n```\n"
    text = f"<!-- elsewhere -->\n\ntext\n\n<!-- tested with `2` instead of `1` -->\n{block}\n{block}"
    first, second = page_of(tmp_path, text)
    assert (first.tested.strip(), second.tested.strip()) == ("echo 2", "echo 1")
    assert (first.place, second.place) == ("page.md:6", "page.md:10")


def test_a_short_training_keeps_the_values_of_the_page():
    short = shortened('waypost train h-bc --values "relabeling=false" --episodes 300 --store a.db')
    assert short.startswith('waypost train h-bc --episodes 2 --threads 1 --values "relabeling=false train_hi.least=64')
    assert short.count("--episodes") == short.count("--values") == 1
    assert short.endswith("--store a.db")
