"""Find the parts that a preset uses and that a domain does not provide, and say what is used instead."""

from waypost.domains import (
    Centered,
    Cropped,
    Ending,
    FlatRelabeling,
    Placed,
    Relabeling,
    Retracing,
    Viewed,
    symmetries_of,
)
from waypost_learner.algorithms.learner import Learner
from waypost_learner.policies.planning import PlanningSpec


def missing_parts(learner: Learner) -> dict[str, str]:
    """Return what a run uses instead of each part that its preset uses and its domain does not provide.

    Returns:
        one short sentence for each missing part, by the part's name; the run's configuration stores it.

    Raises:
        ValueError: the algorithm cannot do without a part.
    """
    domain, levels, preset = learner.domain, learner.levels, learner.preset
    if levels.q_lo and not levels.flat and not isinstance(domain, Ending):
        raise ValueError(
            f"the domain {domain.name!r} does not say how subgoals end, which reinforcement learning of subpolicies "
            "needs: give it outcome(instance, origin, state, subgoal), or use an algorithm without Q-functions"
        )
    use, mu_imitates = learner.use, not (levels.flat or levels.q_hi)
    plans = any(isinstance(view.network, PlanningSpec) for view in learner.views.values())
    wanted = (use.symmetries and levels.imitating) or (preset.training.dqn.symmetries and levels.reinforced)
    checks = {
        "fields": (
            preset.training.fields is not None and levels.imitating and learner.shared is None,
            "Each policy has its own network: only policies that all imitate, and that see pictures, share one.",
        ),
        "symmetries": (
            wanted and not symmetries_of(domain),
            "Labels are learned only as they were given."
            if learner.shared is None or learner.shared.is_told
            else "Turns and reflections of pictures are used that fit the moves and the labels so far.",
        ),
        "views": (use.views and not isinstance(domain, Viewed), "Policies see whole observations."),
        "centered": (
            use.centered and (levels.imitating or not use.views) and not isinstance(domain, Centered),
            "No view has the agent in the middle.",
        ),
        "crop": (
            use.crop and not levels.flat and not isinstance(domain, Cropped),
            "Subpolicies see as much as mu.",
        ),
        "planning": (
            use.planning is not None and not plans,
            "No network plans over places: pictures use the network of Table 1, vectors a dense network.",
        ),
        "places": (
            preset.rollouts.repeat_penalty > 0 and not levels.flat and not isinstance(domain, Placed),
            "There is no repeat penalty.",
        ),
        "places to explore": (
            preset.training.dqn.exploration.wander > 0
            and levels.q_lo
            and not levels.flat
            and not isinstance(domain, Placed),
            "Attempts at subgoals do not explore.",
        ),
        "relabeling": (
            use.relabeling and mu_imitates and not isinstance(domain, Relabeling),
            "Labels of one task give no labels of other tasks.",
        ),
        "flat relabeling": (
            use.relabeling and levels.flat and levels.imitating and not isinstance(domain, FlatRelabeling),
            "Labels of one task give no labels of other tasks.",
        ),
        "retracing": (
            use.relabeling and mu_imitates and not isinstance(domain, Retracing),
            "A demonstration of one task gives no segments of other tasks.",
        ),
    }
    return {part: instead for part, (missing, instead) in checks.items() if missing}
