"""Every refusal of the server, each with the status a client can act on; all become RFC 9457 problem documents.

Refusal
├── Unauthenticated        401  no valid token or session
│   ├── LoginUsed               the login link was used before
│   ├── LoginExpired            the login link is too old
│   └── Deactivated             the account is deactivated
├── BudgetExhausted        402  the query's reserve does not fit the run's budget
├── Forbidden              403  the role may not do this
│   ├── NotYours           403  another annotator's assignment
│   ├── WrongToken         403  not the token of this lease
│   └── CrossSite          403  a cookie used from a foreign page
├── NotFound               404
├── BodyTooSlow            408
├── Conflict               409  the store is in another state than the request assumes
│   ├── DifferentContent        the same key came with other content
│   ├── KeyReused               an Idempotency-Key was used for something else
│   ├── LeaseExpired            the answer came too late
│   ├── LeaseEnded              the assignment was released, skipped or answered before
│   ├── QueryCancelled          the run ended before the answer came
│   ├── AnswerUsed              the learner has trained on the answer
│   ├── AnswerRetracted         the answer was taken back
│   ├── NotAnswered             there is no answer to use
│   ├── NotPlayable             no open demonstration to play
│   ├── Displaced               another connection has taken this end of the play socket
│   ├── RunFinished             a finished run asks nothing more
│   ├── BudgetTooLow            a budget below what is spent and reserved
│   ├── NameTaken               a user of that name exists
│   ├── NotActive               a deactivated user gets no links and no tokens
│   └── LastAdministrator       nobody would be left to let others in
├── BodyTooLarge           413
├── NotJson                415
├── Misdirected            421  a Host this server does not answer to
├── Unprocessable          422  well-formed, but wrong; names the field
├── TooManyQueries         429  the run has too many open queries
├── TooManyAttempts        429  too many wrong login codes
├── TooManyMessages        429  more on a socket than any person sends
└── StorageFailed          503  nothing was stored; try again
"""

from collections.abc import Sequence
from typing import ClassVar

Location = Sequence[str | int]


class Refusal(Exception):
    """The request cannot be carried out."""

    status: ClassVar[int] = 400
    name: ClassVar[str] = "refused"
    title: ClassVar[str] = "Refused"

    def __init__(self, detail: str, *, retry_after: float | None = None) -> None:
        super().__init__(detail)
        self.detail = detail
        self.retry_after = retry_after
        self.errors: list[dict[str, object]] | None = None


class Unauthenticated(Refusal):
    """No valid token or session came with the request."""

    status, name, title = 401, "unauthenticated", "Log in first"


class LoginUsed(Unauthenticated):
    """The login link was used before; each works once."""

    name, title = "login-used", "The login link was used before"


class LoginExpired(Unauthenticated):
    """The login link is too old."""

    name, title = "login-expired", "The login link is too old"


class Deactivated(Unauthenticated):
    """The account of the login link is deactivated."""

    name, title = "deactivated", "The account is deactivated"


class BudgetExhausted(Refusal):
    """The query's reserve does not fit what is left of the run's budget."""

    status, name, title = 402, "budget-exhausted", "The run's budget is exhausted"


class Forbidden(Refusal):
    """The caller's role may not do this."""

    status, name, title = 403, "forbidden", "Not allowed"


class NotYours(Forbidden):
    """The assignment belongs to another annotator."""

    name, title = "not-yours", "Another annotator's assignment"


class WrongToken(Forbidden):
    """The token is not the one this lease was given."""

    name, title = "wrong-token", "Not the token of this assignment"


class CrossSite(Forbidden):
    """A session cookie came with a request that another site may have caused."""

    name, title = "cross-site", "Refused from another site"


class NotFound(Refusal):
    """There is no such thing."""

    status, name, title = 404, "not-found", "Not found"


class BodyTooSlow(Refusal):
    """The body did not arrive in time."""

    status, name, title = 408, "body-too-slow", "The body did not arrive in time"


class Conflict(Refusal):
    """The store is in another state than the request assumes."""

    status, name, title = 409, "conflict", "Conflict"


class DifferentContent(Conflict):
    """The same key was used before with other content."""

    name, title = "different-content", "Already there with other content"


class KeyReused(Conflict):
    """An Idempotency-Key was used before for something else."""

    name, title = "idempotency-key-reused", "Idempotency-Key already used"


class LeaseExpired(Conflict):
    """The answer came after its lease had ended; it is kept, uncharged."""

    name, title = "lease-expired", "The lease has expired"


class LeaseEnded(Conflict):
    """The assignment has ended: released, skipped or answered."""

    name, title = "lease-ended", "The assignment has ended"


class QueryCancelled(Conflict):
    """The query was cancelled because its run ended."""

    name, title = "query-cancelled", "The query was cancelled"


class AnswerUsed(Conflict):
    """The learner has used the answer; it can be taken back no more."""

    name, title = "answer-used", "The learner has used the answer"


class AnswerRetracted(Conflict):
    """The answer was taken back."""

    name, title = "answer-retracted", "The answer was taken back"


class NotAnswered(Conflict):
    """The query has no answer now."""

    name, title = "not-answered", "Not answered"


class NotPlayable(Conflict):
    """The query is no demonstration, or no longer an open one."""

    name, title = "not-playable", "Not an open demonstration"


class Displaced(Conflict):
    """A newer connection has taken this end of the play socket."""

    name, title = "displaced", "Connected elsewhere"


class RunFinished(Conflict):
    """A finished run takes nothing new."""

    name, title = "run-finished", "The run is finished"


class BudgetTooLow(Conflict):
    """A budget cannot be less than what is spent and reserved."""

    name, title = "budget-too-low", "The budget is too low"


class NameTaken(Conflict):
    """A user of that name exists."""

    name, title = "name-taken", "The name is taken"


class NotActive(Conflict):
    """The user is deactivated, so no link and no token is made for them."""

    name, title = "not-active", "The user is deactivated"


class LastAdministrator(Conflict):
    """Without this administrator nobody could let others in."""

    name, title = "last-administrator", "The last administrator stays"


class BodyTooLarge(Refusal):
    """The body is larger than the server takes."""

    status, name, title = 413, "body-too-large", "The body is too large"


class NotJson(Refusal):
    """Bodies are JSON and say so."""

    status, name, title = 415, "not-json", "Send application/json"


class Misdirected(Refusal):
    """The Host header names another server."""

    status, name, title = 421, "misdirected", "This server does not answer to that host name"


class Unprocessable(Refusal):
    """Well-formed, but not valid; `errors` names each field at fault."""

    status, name, title = 422, "unprocessable", "The request is not valid"

    def __init__(self, location: Location, message: str) -> None:
        super().__init__(f"{'.'.join(str(part) for part in location)}: {message}")
        self.errors = [{"loc": list(location), "msg": message, "type": "value_error"}]


class TooManyQueries(Refusal):
    """The run has as many open queries as it may."""

    status, name, title = 429, "too-many-queries", "Too many open queries"


class TooManyAttempts(Refusal):
    """Too many wrong login codes came from this client."""

    status, name, title = 429, "too-many-attempts", "Too many attempts"


class TooManyMessages(Refusal):
    """More messages came on a socket than playing needs."""

    status, name, title = 429, "too-many-messages", "Too many messages"


class StorageFailed(Refusal):
    """The store could not take it; nothing was stored."""

    status, name, title = 503, "storage-failed", "The store failed"
