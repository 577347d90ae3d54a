"""Build everything that a configuration names, and refuse contradictory configurations."""

from dataclasses import dataclass, replace

from waypost.domains import InstanceSets, Placed, find_domain, replay_of
from waypost_learner.algorithms import Algorithm, find_algorithm
from waypost_learner.algorithms.learner import Learner
from waypost_learner.experts.head_start import head_start
from waypost_learner.presets import find_preset
from waypost_learner.presets.told import STRUCTURE, level_of
from waypost_learner.rollout.simulator import ADVICE
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.missing_parts import missing_parts
from waypost_learner.runs.useless_values import refuse_useless_values


@dataclass(frozen=True)
class Setup:
    """The configuration of a run, and the objects that it names."""

    config: TrainConfig
    algorithm: Algorithm
    learner: Learner
    instances: InstanceSets
    missing: dict[str, str]  # what is used instead of each part that the domain does not provide

    @property
    def told(self) -> str:
        """The lowest level of what a learner is told that allows what the run uses of the domain's declarations."""
        if self.algorithm.by_place:
            return STRUCTURE
        used = replace(self.learner.preset, use=self.learner.use)
        return level_of(used, self.learner.levels.reinforced)


def set_up(config: TrainConfig, threads: int | None) -> Setup:
    """Build everything that a configuration names, for a new run.

    Args:
        config: the run's configuration.
        threads: CPU threads to train with; one per core if None.

    Raises:
        ValueError: a name does not exist, a file does not contain instances, or an option or value contradicts another
            or has no effect; the message says what to write instead.
    """
    algorithm = find_algorithm(config.algorithm)
    if config.redraw and (not algorithm.interactive or algorithm.levels.q_lo):
        raise ValueError(f"{config.algorithm} never draws an instance again: leave out --redraw")
    if config.warm_start is not None and not algorithm.interactive:
        raise ValueError(f"{config.algorithm} has no warm start: leave out --warm-start")
    if config.head_start is not None and not algorithm.levels.reinforced:
        raise ValueError(f"{config.algorithm} learns only from an expert: leave out --head-start")
    if algorithm.by_place and config.told not in (None, STRUCTURE):
        raise ValueError(
            f"{config.algorithm} asks once per place, and --told {config.told} tells no places: leave out --told"
        )
    learner = build_learner(config, threads)
    strangers = learner.preset.training.dqn_of.keys() - set(learner.domain.subgoals)
    if strangers:
        raise ValueError(f"dqn_of names {min(strangers)!r}, but the subgoals are: {', '.join(learner.domain.subgoals)}")
    if algorithm.takes_over and replay_of(learner.domain) == "recorded":
        raise ValueError(
            f"{config.algorithm} lets experts play on from earlier states, and the domain {learner.domain.name!r} "
            f'cannot return to a state (replay = "recorded"): {ADVICE}'
        )
    if algorithm.gated:
        _refuse_a_blind_gate(learner)
    refuse_useless_values(config, algorithm, learner)
    missing = missing_parts(learner)
    if algorithm.by_place and not isinstance(learner.domain, Placed):
        missing["places to label once"] = "Each segment is labeled."
    return Setup(config, algorithm, learner, learner.domain.instances(config.instances), missing)


def _refuse_a_blind_gate(learner: Learner) -> None:
    shared = learner.shared
    views = shared is not None and (not shared.is_told or len(shared.symmetries) > 0)
    if learner.preset.gate.kind == "thrifty" and not views:
        raise ValueError(
            'gate.kind="thrifty" compares symmetric views, which needs policies that share a network, and symmetries: '
            'use --preset general in a domain that has them, or gate.kind="lazy" or gate.kind="aim"'
        )


def build_learner(config: TrainConfig, threads: int | None) -> Learner:
    """Return a new learner for a configuration. Unlike `set_up`, accept values without effect, as old runs may have.

    Raises:
        ValueError: a name does not exist, or the preset's values contradict each other.
    """
    levels = find_algorithm(config.algorithm).levels
    domain = find_domain(config.domain)
    preset = find_preset(config.preset, config.values, domain.name, config.told)
    if config.warm_start is not None:
        preset = preset.with_values(**{"warm_start_hybrid" if levels.q_lo else "warm_start": config.warm_start})
    start = None if config.head_start is None else head_start(domain, config.head_start)
    return Learner(domain, preset, config.seed, levels, threads, start)
