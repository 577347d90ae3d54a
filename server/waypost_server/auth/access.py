"""Who may do what: one table of all operations, and the checks that enforce it.

`permissions` checks the role before an operation begins. A change of a run checks the role again, and the owner of the
run, in its transaction (`runs.service.lock_own`), so both hold at the commit. `leases.assignments.find` checks whose
assignment it is, and `tokens.revoke_token` whose token.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from sqlalchemy import bindparam, select

from waypost.wire import Role, Scope
from waypost_server import errors
from waypost_server.auth.roles import ADMINS, ANNOTATORS, ANYONE, LEARNERS, WATCHERS
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import users
from waypost_server.db.transaction import Tx


@dataclass(frozen=True)
class Access:
    """The callers of an operation: users with one of these roles.

    A token that was made with scopes may call only the operations of these scopes, and those without a scope, which
    read. Operations on an object of which `own` names the kind are for its owner: the learner who created the run, the
    annotator who leased the query, the user of the token. Administrators may change every run and revoke every token,
    but nobody answers in the place of another annotator.
    """

    roles: frozenset[Role]
    own: Literal["run", "assignment", "token"] | None = None
    scope: Scope | None = None

    @property
    def words(self) -> str:
        """The rule as a sentence for the API's documentation."""
        limited = "" if self.scope is None else f"A token with scopes needs the scope {self.scope}. "
        if self.roles == ANYONE:
            roles = f"{limited}Every role may call it"
        else:
            roles = f"{limited}Needs the role {' or '.join(sorted(self.roles))}"
        if self.own is None:
            return f"{roles}."
        others = "" if self.own == "assignment" else f"; administrators may do it for every {self.own}"
        return f"{roles}. The {self.own} must be the caller's own{others}."


_ALL, _WATCH, _LEARN = Access(ANYONE), Access(WATCHERS), Access(LEARNERS, scope="learn")
_ANSWER, _ADMIN = Access(ANNOTATORS, scope="answer"), Access(ADMINS, scope="manage")
OWN_RUN = Access(LEARNERS, own="run", scope="learn")
_OWN_ASSIGNMENT = Access(ANNOTATORS, own="assignment", scope="answer")
_OWN_TOKEN = Access(ANYONE, own="token", scope="manage")

ACCESS: Mapping[str, Access] = {
    # runs, queries, answers
    "createRun": _LEARN,
    "patchRun": OWN_RUN,
    "deleteRun": OWN_RUN,
    "reportEpisodes": OWN_RUN,
    "ask": OWN_RUN,
    "useAnswer": OWN_RUN,
    "putFrames": _LEARN,
    "missingFrames": _LEARN,
    "addGold": OWN_RUN,
    "retireGold": OWN_RUN,
    "listGold": _LEARN,
    "putPractice": OWN_RUN,
    # review
    "putPredictions": OWN_RUN,
    "listReview": OWN_RUN,
    "comment": OWN_RUN,
    "sendBack": OWN_RUN,
    # assignments
    "lease": _ANSWER,
    "leaseBatch": _ANSWER,
    "answerBatch": _ANSWER,  # each answer is for the owner of its assignment, like `answer`
    "myAssignments": _ANSWER,
    "leave": _ANSWER,
    "answer": _OWN_ASSIGNMENT,
    "renew": _OWN_ASSIGNMENT,
    "release": _OWN_ASSIGNMENT,
    "retract": _OWN_ASSIGNMENT,
    # the play socket: its opening, then one of two first messages
    "play": Access(ANNOTATORS | LEARNERS),
    "playTake": _OWN_ASSIGNMENT,
    "playOffer": OWN_RUN,
    # watching
    "listRuns": _ALL,
    "getRun": _ALL,
    "getCurves": _ALL,
    "getCosts": _ALL,
    "getForecast": _ALL,
    "getFrame": _ALL,
    "listAtWork": _ALL,
    "getOutlook": _ALL,
    "streamEvents": _ALL,
    "streamChanges": _ALL,
    "listQueries": _WATCH,
    "getQuery": _WATCH,
    "getHistory": _WATCH,
    "listQueryRows": _WATCH,
    "listStuck": _WATCH,
    "listAnswers": _WATCH,
    "listLedger": _WATCH,
    "listRecords": _WATCH,
    "getAgreement": _WATCH,
    "exportRun": _WATCH,
    "metrics": _WATCH,
    # the caller's own account, and practice
    "me": _ALL,
    "logout": _ALL,
    "logoutEverywhere": Access(ANYONE, scope="manage"),
    "myNumbers": _ALL,
    "myReturned": _ALL,
    "myTokens": _ALL,
    "mySessions": _ALL,
    "createToken": _OWN_TOKEN,
    "revokeToken": _OWN_TOKEN,
    "getPractice": _ALL,
    "practice": _ALL,
    # people and webhooks
    "listAudit": _ADMIN,
    "exportAudit": _ADMIN,
    "listUsers": _ADMIN,
    "createUser": _ADMIN,
    "getUser": _ADMIN,
    "patchUser": _ADMIN,
    "eraseUser": _ADMIN,
    "createLoginLink": _ADMIN,
    "listTokens": _ADMIN,
    "getNumbers": _ADMIN,
    "listNumbers": _ADMIN,
    "createWebhook": _ADMIN,
    "listWebhooks": _ADMIN,
    "getWebhook": _ADMIN,
    "patchWebhook": _ADMIN,
    "deleteWebhook": _ADMIN,
    "pingWebhook": _ADMIN,
    "listDeliveries": _ADMIN,
    "redeliver": _ADMIN,
}
"""By operation of the API, as OpenAPI names it, or message of the play socket."""

_USER = select(users.c.name, users.c.role, users.c.deactivated_at).where(users.c.id == bindparam("user"))
LOCKED_USER = Prepared(_USER.with_for_update(read=True))


def check_role(access: Access, name: str, role: Role) -> None:
    """Refuse a user who has none of the roles.

    Raises:
        Forbidden: naming the roles that would be allowed.
    """
    if role not in access.roles:
        roles = sorted(access.roles)
        raise errors.Forbidden(f"This needs the role {' or '.join(roles)}; {name} is {role}.", roles=roles)


def check_scope(access: Access, scopes: frozenset[Scope] | None) -> None:
    """Refuse a token whose scopes do not include the operation.

    Raises:
        OutOfScope: naming the scopes.
    """
    if scopes is not None and access.scope is not None and access.scope not in scopes:
        may = ", ".join(sorted(scopes))
        raise errors.OutOfScope(f"This needs the scope {access.scope}; the token has only {may}. Use another token.")


def check_still(tx: Tx, access: Access, user: int) -> Role:
    """Refuse a user who was deactivated or lost the role after the request had come; return the present role.

    The user's row stays locked FOR SHARE until the end of the transaction, so the role still holds at the commit.

    Raises:
        Unauthenticated: the user was deactivated.
        Forbidden: the user's role may not do this.
    """
    row = LOCKED_USER.one(tx.conn, {"user": user})
    if row.deactivated_at is not None:
        raise errors.Unauthenticated("This account was deactivated.")
    role: Role = row.role
    check_role(access, row.name, role)
    return role


def check_owner(tx: Tx, run: str, owner: int, user: int, role: Role) -> None:
    """Refuse a learner who does not own the run.

    Raises:
        Forbidden: naming the owner.
    """
    if user != owner and role not in ADMINS:
        name = tx.conn.execute(_USER, {"user": owner}).one().name
        raise errors.Forbidden(
            f"Run {run} belongs to {name}. Only its owner and administrators may change it; create a run of your own.",
            owner=name,
        )
