"""The modules whose mutants are tried, and the tests that are run on them."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field

# What an error says to people is not tested word by word, so these lines are not changed.
WORDS = (
    r'errors\.\w+\(f?"[^"]*"\)$',  # an error with nothing but its words
    r'^\s*f?"[^"]* [^"]*"[,)]*$',  # one line of a longer text
)

# `unraisableexception` looks through all objects at the end of each of thousands of processes.
_PLUGINS = ("-p", "tests.mutants.fresh", "-p", "no:cacheprovider", "-p", "no:unraisableexception")


@dataclass(frozen=True)
class Group:
    """Modules below `waypost_server`, and files and folders below `tests/server`.

    A survivor costs the time of every test that runs it, so slow tests and those on PostgreSQL are left out.
    """

    modules: tuple[str, ...]
    tests: tuple[str, ...]
    left_out: tuple[str, ...] = ("postgresql", "does_not_fit")  # tests with this in their name
    tests_at_import: Mapping[str, tuple[str, ...]] = field(default_factory=dict)  # by function that runs at import

    def pytest_options(self) -> list[str]:
        """Return how the tests are chosen and run."""
        return ["-k", " and ".join(f"not {name}" for name in self.left_out), *_PLUGINS]

    def settings(self) -> str:
        """Return the settings of mutmut and pytest."""
        mutmut = {
            "source_paths": ["waypost_server"],
            "only_mutate": [f"waypost_server/{module}" for module in self.modules],
            "do_not_mutate_patterns": WORDS,
            "also_copy": ["docs"],
            "pytest_add_cli_args_test_selection": [f"tests/server/{test}" for test in self.tests],
            "pytest_add_cli_args": self.pytest_options(),
            "timeout_multiplier": 3.0,
            "timeout_constant": 10.0,
            # Not from a process that ran the tests: a mutant of what it has built already would change nothing.
            "process_isolation": "forkserver",
            "use_git_change_detection": False,
            "track_dependencies": False,
        }
        pytest = {
            "testpaths": ["tests"],
            "pythonpath": ["."],
            "addopts": ["--import-mode=importlib"],
            "filterwarnings": ["error"],
            "timeout": 300,
        }
        return _section("tool.mutmut", mutmut) + _section("tool.pytest.ini_options", pytest)


def _section(name: str, values: dict[str, object]) -> str:
    """Write a section of TOML; such values look the same in JSON."""
    lines = [f"{key} = {json.dumps(value)}" for key, value in values.items()]
    return "\n".join([f"[{name}]", *lines, ""])


GROUPS = {
    "leases": Group(
        ("leases/*.py",),
        (
            "answers/test_answers.py",
            "answers/test_batch.py",
            "answers/test_following.py",
            "gold/test_second.py",
            "leases",
            "watch/test_stuck.py",
        ),
        tests_at_import={"waypost_server.leases.active_time.x__start": ("tests/server/leases/test_active_time.py",)},
    ),
    "answers": Group(
        ("answers/batch.py", "answers/following.py", "answers/retraction.py", "answers/service.py", "runs/ledger.py"),
        (
            "answers/test_answers.py",
            "answers/test_batch.py",
            "answers/test_following.py",
            "answers/test_steps.py",
            "gold/test_second.py",
            "runs/test_runs.py",
            "leases/test_active_time.py::test_an_idle_gap_counts_up_to_the_cap_and_the_raw_seconds_go_on",
            "leases/test_active_time.py::test_a_retracted_answer_gives_its_active_seconds_back",
            "watch/test_metrics.py::test_what_was_done_is_counted_once_it_is_committed",
            "watch/test_records.py::test_a_run_that_was_taken_in_tells_what_the_original_tells",
            "watch/test_tables.py::test_the_ledger_lists_charges_and_refunds_and_agrees_with_the_account",
            "webhooks/test_delivery.py::test_answers_and_states_of_runs_arrive_in_order_and_signed",
            "webhooks/test_delivery.py::test_gold_queries_and_late_answers_are_not_announced",
        ),
    ),
    "auth": Group(
        tuple(
            f"auth/{name}.py"
            for name in ("access", "attempts", "credentials", "lookup", "permissions", "sessions", "tokens")
        ),
        (
            "auth/test_access.py",
            "auth/test_attempts.py",
            "auth/test_audit.py",
            "auth/test_credentials.py",
            "auth/test_scopes.py",
            "users/test_users.py",
        ),
        ("postgresql", "every_operation", "operations_of_its_scope"),
    ),
}
