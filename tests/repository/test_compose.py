import re
import subprocess
import sys
from typing import Any

import pytest
import yaml
from tests.repository.kit import ROOT, complaint, invocations

FILE = ROOT / "docker-compose.yml"
IMAGES = (ROOT / "Dockerfile").read_text()


@pytest.fixture(scope="module")
def compose() -> Any:
    """The file, its merges done."""
    return yaml.safe_load(FILE.read_text())


def command_of(service: Any) -> str:
    command = service.get("command", "")
    return "\n".join(command) if isinstance(command, list) else command


def test_it_is_what_the_compose_specification_calls_valid():
    check = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.compose-spec", str(FILE)]
    done = subprocess.run(check, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_services_volumes_and_networks_it_refers_to_exist(compose):
    services = compose["services"]
    for service in services.values():
        assert set(service.get("depends_on", {})) <= set(services)
        assert set(service["networks"]) <= set(compose["networks"])
        named = {mount.partition(":")[0] for mount in service.get("volumes", [])}
        assert named <= set(compose["volumes"])


def test_what_must_finish_first_does_not_run_for_ever_and_what_must_be_healthy_has_a_check(compose):
    services = compose["services"]
    for service in services.values():
        for name, needed in service.get("depends_on", {}).items():
            other = services[name]
            if needed["condition"] == "service_completed_successfully":
                assert "restart" not in other
            else:
                target = other.get("build", {}).get("target")
                assert "healthcheck" in other or f"AS {target}\n" in IMAGES
                assert "healthcheck" in other or "HEALTHCHECK" in IMAGES.partition(f" AS {target}\n")[2]


def test_every_image_it_builds_is_a_stage_of_the_dockerfile(compose):
    stages = set(re.findall(r"^FROM \S+ AS (\S+)$", IMAGES, re.MULTILINE))
    wanted = {service["build"]["target"] for service in compose["services"].values() if "build" in service}
    assert wanted == {"server", "learner"}
    assert wanted <= stages


def test_every_stage_of_the_dockerfile_that_is_copied_from_exists():
    stages = set(re.findall(r"^FROM \S+ AS (\S+)$", IMAGES, re.MULTILINE))
    assert set(re.findall(r"--from=(\S+)", IMAGES)) <= stages
    sources = re.findall(r"^COPY (?!--from)(.+) \S+$", IMAGES, re.MULTILINE)
    assert [name for line in sources for name in line.split() if not (ROOT / name).exists()] == []


def test_no_file_that_an_image_copies_is_kept_from_the_build():
    rules = (ROOT / ".dockerignore").read_text().split()
    assert rules[0] == "*"  # nothing is sent to the build but what is named
    named = {rule.removeprefix("!") for rule in rules if rule.startswith("!")}
    sources = re.findall(r"^COPY (?!--from)(.+) \S+$", IMAGES, re.MULTILINE)
    copied = {name.split("/")[0] for line in sources for name in line.split()}
    assert copied <= named


def test_every_command_in_it_is_one_the_command_line_takes(compose):
    lines = [line for service in compose["services"].values() for line in invocations(command_of(service))]
    lines += [" ".join(re.findall(r'"([^"]+)"', cmd)) for cmd in re.findall(r'^CMD (\["waypost".*\])$', IMAGES, re.M)]
    assert len(lines) >= 5
    assert {line: said for line in lines if (said := complaint(line))} == {}


def test_no_password_is_written_down_and_the_programs_get_their_tokens_from_the_one_that_makes_them(compose):
    services = compose["services"]
    assert services["database"]["environment"]["POSTGRES_PASSWORD"].startswith("${WAYPOST_DATABASE_PASSWORD:?")
    assert services["server"]["environment"]["PGPASSWORD"].startswith("${WAYPOST_DATABASE_PASSWORD:?")
    made = set(re.findall(r"^token ([\w-]+) \w+$", command_of(services["setup"]), re.MULTILINE))
    for name in ("learner", "oracle"):
        (read,) = re.findall(r"cat /tokens/([\w-]+)\)", command_of(services[name]))
        assert read in made
        assert "tokens:/tokens:ro" in services[name]["volumes"]


def test_the_server_answers_to_the_name_the_programs_call_it_by(compose):
    services = compose["services"]
    assert services["server"]["environment"]["WAYPOST_HOSTS"].split(",")[0] == "server"
    for name in ("learner", "oracle"):
        assert "--server http://server:8000" in command_of(services[name])
        assert set(services[name]["networks"]) & set(services["server"]["networks"])
