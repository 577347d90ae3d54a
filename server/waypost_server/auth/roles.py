"""The groups of roles that operations are open to."""

from waypost.wire import Role

ANYONE: frozenset[Role] = frozenset({"admin", "learner", "annotator", "viewer"})
# Who may see single queries of runs. Annotators may not, because they could then tell gold queries from others.
WATCHERS: frozenset[Role] = frozenset({"admin", "learner", "viewer"})
LEARNERS: frozenset[Role] = frozenset({"admin", "learner"})
ANNOTATORS: frozenset[Role] = frozenset({"admin", "annotator"})
ADMINS: frozenset[Role] = frozenset({"admin"})
