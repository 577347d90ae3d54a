"""`import waypost`: what it offers, and what it must not need."""

import subprocess
import sys

import waypost


def test_the_public_names_are_these() -> None:
    assert waypost.__all__ == ["Client", "Refused", "Unreachable", "domain", "prices", "wire"]
    assert all(hasattr(waypost, name) for name in waypost.__all__)


def test_a_client_program_needs_no_web_framework_no_database_and_no_numerics() -> None:
    heavy = {"fastapi", "starlette", "sqlalchemy", "torch", "numpy", "gymnasium"}
    code = f"import sys, waypost; print(sorted({heavy!r} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_the_contract_for_domains_needs_neither_the_service_nor_pytorch() -> None:
    heavy = {"fastapi", "sqlalchemy", "torch", "waypost_server", "waypost_learner"}
    code = f"import sys, waypost.domains; print(sorted({heavy!r} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
