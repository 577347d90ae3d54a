"""All refusals of the server, each with an HTTP status that a client can act on. They become RFC 9457 documents.

Refusal
├── Unauthenticated        401  no valid token or session
│   ├── LoginUsed               the login link was used before
│   ├── LoginExpired            the login link has expired
│   ├── Deactivated             the account is deactivated
│   ├── SignInStale             the provider's reply belongs to no sign-in of this browser
│   ├── SignInFailed            the provider refused, or its reply is not valid
│   ├── NoAccount               the provider's person is no user of this server
│   └── NoRole                  none of the person's roles is one of this server's
├── BudgetExhausted        402  the run's budget has too few units left for the query
├── Forbidden              403  the role may not do this, or not to this object
│   ├── NotYours           403  another annotator's assignment
│   ├── OutOfScope         403  the token was made with other scopes
│   ├── WrongToken         403  not the token of this lease
│   └── CrossSite          403  a session cookie came from another site
├── NotFound               404  the object does not exist
├── BodyTooSlow            408  the body did not arrive in time
├── Conflict               409  the state of the store does not allow the request
│   ├── DifferentContent        the same key came with other content
│   ├── KeyReused               an Idempotency-Key came before with another answer
│   ├── LeaseExpired            the answer came too late
│   ├── LeaseEnded              the assignment was released, skipped or answered before
│   ├── QueryCancelled          the run ended before the answer came
│   ├── AnswerUsed              the learner has used the answer
│   ├── AnswerRetracted         the answer was retracted
│   ├── CannotSendBack          the answer is not one of the run's own
│   ├── NotAnswered             the query has no answer at present
│   ├── NotPlayable             the query is not an open demonstration
│   ├── Displaced               a newer connection to the play socket replaced this one
│   ├── RunFinished             a finished run does not allow this
│   ├── TooManyPictures         the learner's pictures have as many bytes as they may
│   ├── NotFinished             only a finished run can be deleted
│   ├── BudgetTooLow            a budget below the units spent and reserved
│   ├── NameTaken               a user with this name exists
│   ├── IdentityTaken           the provider's person is a user already
│   ├── RunExists               the store has the run that is being imported
│   ├── NotActive               a deactivated user gets no login links or tokens
│   ├── StillActive             the data of an active user cannot be deleted
│   ├── UserErased              the user's data were deleted, so the user stays deactivated
│   ├── WebhookOff              a webhook that is off sends nothing
│   └── LastAdministrator       no active administrator would be left
├── BodyTooLarge           413  the body is larger than the server accepts
├── NotJson                415  the body is not declared as JSON
├── Misdirected            421  a Host name that this server does not serve
├── Unprocessable          422  valid JSON, but a field is invalid; the refusal names the field
├── TooManyQueries         429  the run, or the runs of its owner together, have too many open queries
├── TooManyAttempts        429  too many wrong login codes
├── TooManyMessages        429  too many messages on a play socket
├── ProviderFailed         502  the OpenID provider cannot be reached, or fails
├── Stopping               503  the server is about to stop; another one may be ready
└── StorageFailed          503  the database failed; the refusal says that nothing was stored, or that this is not known
    └── StoreBusy               too many requests wait to store something
"""

from collections.abc import Sequence
from typing import ClassVar

Location = Sequence[str | int]


class Refusal(Exception):
    """The request cannot be carried out."""

    status: ClassVar[int] = 400
    name: ClassVar[str] = "refused"
    title: ClassVar[str] = "Refused"

    def __init__(self, detail: str, *, retry_after: float | None = None, **members: object) -> None:
        super().__init__(detail)
        self.detail = detail
        self.retry_after = retry_after
        self.members = members
        """More members of the problem document, for clients that say what happened in their own words."""


class Unauthenticated(Refusal):
    """No valid token or session came with the request."""

    status, name, title = 401, "unauthenticated", "Log in first"


class LoginUsed(Unauthenticated):
    """The login link was used before; each link works once."""

    name, title = "login-used", "The login link was used before"


class LoginExpired(Unauthenticated):
    """The login link has expired."""

    name, title = "login-expired", "The login link is too old"


class Deactivated(Unauthenticated):
    """The account of the login link is deactivated."""

    name, title = "deactivated", "The account is deactivated"


class SignInStale(Unauthenticated):
    """The provider's reply belongs to no sign-in that this browser began in the last ten minutes."""

    name, title = "sign-in-stale", "Begin the sign-in again"


class SignInFailed(Unauthenticated):
    """The provider did not sign the person in, or its reply is not valid. `fault` says why, for the operator."""

    name, title = "sign-in-failed", "The sign-in failed"

    def __init__(self, fault: str) -> None:
        super().__init__(f"The sign-in failed: {fault}. Try again; if it fails again, tell an administrator.")
        self.fault = fault


class NoAccount(Unauthenticated):
    """The person signed in at the provider, but is no user of this server."""

    name, title = "no-account", "No account on this server"


class NoRole(Unauthenticated):
    """The person signed in at the provider, but none of their roles there gives a role here."""

    name, title = "no-role", "No role on this server"


class BudgetExhausted(Refusal):
    """The run's budget has fewer units left than the query may cost."""

    status, name, title = 402, "budget-exhausted", "The run's budget is exhausted"


class Forbidden(Refusal):
    """The caller may not do this: the role does not suffice, or the run belongs to another learner."""

    status, name, title = 403, "forbidden", "Not allowed"


class OutOfScope(Forbidden):
    """The token was made with scopes, and the operation is in none of them."""

    name, title = "out-of-scope", "Not in the scopes of this token"


class NotYours(Forbidden):
    """The assignment belongs to another annotator."""

    name, title = "not-yours", "Another annotator's assignment"


class WrongToken(Forbidden):
    """The token does not belong to this lease."""

    name, title = "wrong-token", "Not the token of this assignment"


class CrossSite(Forbidden):
    """A request with a session cookie may have come from another site."""

    name, title = "cross-site", "Refused from another site"


class NotFound(Refusal):
    """The object does not exist."""

    status, name, title = 404, "not-found", "Not found"


class BodyTooSlow(Refusal):
    """The body did not arrive in time."""

    status, name, title = 408, "body-too-slow", "The body did not arrive in time"


class Conflict(Refusal):
    """The state of the store does not allow the request."""

    status, name, title = 409, "conflict", "Conflict"


class DifferentContent(Conflict):
    """The same key was used before with other content."""

    name, title = "different-content", "Already there with other content"


class KeyReused(Conflict):
    """The same Idempotency-Key came before with another answer."""

    name, title = "idempotency-key-reused", "Idempotency-Key already used"


class LeaseExpired(Conflict):
    """The answer came after its lease had expired. It is kept, but not charged."""

    name, title = "lease-expired", "The lease has expired"


class LeaseEnded(Conflict):
    """The assignment has ended: released, skipped or answered."""

    name, title = "lease-ended", "The assignment has ended"


class QueryCancelled(Conflict):
    """The query was cancelled because its run ended."""

    name, title = "query-cancelled", "The query was cancelled"


class AnswerUsed(Conflict):
    """The learner has used the answer, so it can no longer be retracted."""

    name, title = "answer-used", "The learner has used the answer"


class AnswerRetracted(Conflict):
    """The answer was retracted."""

    name, title = "answer-retracted", "The answer was taken back"


class CannotSendBack(Conflict):
    """The answer is not one of the run's own, so sending it back would mend nothing."""

    name, title = "cannot-send-back", "This answer stays as it is"


class NotAnswered(Conflict):
    """The query has no answer at present."""

    name, title = "not-answered", "Not answered"


class NotPlayable(Conflict):
    """The query is not an open demonstration."""

    name, title = "not-playable", "Not an open demonstration"


class Displaced(Conflict):
    """A newer connection to the play socket replaced this one."""

    name, title = "displaced", "Connected elsewhere"


class RunFinished(Conflict):
    """The run is finished, so it accepts nothing new."""

    name, title = "run-finished", "The run is finished"


class TooManyPictures(Conflict):
    """The learner's pictures would have more bytes than the server allows. Nothing was stored."""

    name, title = "too-many-pictures", "Too many pictures"


class NotFinished(Conflict):
    """The run is not finished, so it cannot be deleted."""

    name, title = "not-finished", "The run is not finished"


class BudgetTooLow(Conflict):
    """The budget is less than the units spent and reserved."""

    name, title = "budget-too-low", "The budget is too low"


class NameTaken(Conflict):
    """A user with this name exists."""

    name, title = "name-taken", "The name is taken"


class IdentityTaken(Conflict):
    """A user is this person of the OpenID provider already."""

    name, title = "identity-taken", "The person is a user already"


class RunExists(Conflict):
    """The store already has the run: it was made here, or imported before."""

    name, title = "run-exists", "The store already has this run"


class NotActive(Conflict):
    """The user is deactivated and cannot get a login link or a token."""

    name, title = "not-active", "The user is deactivated"


class StillActive(Conflict):
    """The user is active, so the user's data cannot be deleted."""

    name, title = "still-active", "The user is active"


class UserErased(Conflict):
    """The user's data were deleted, so the user can no longer be changed."""

    name, title = "user-erased", "The user's data were deleted"


class WebhookOff(Conflict):
    """The webhook is off, so it sends nothing."""

    name, title = "webhook-off", "The webhook is off"


class LastAdministrator(Conflict):
    """The last active administrator cannot be demoted or deactivated."""

    name, title = "last-administrator", "The last administrator stays"


class BodyTooLarge(Refusal):
    """The body is larger than the server accepts."""

    status, name, title = 413, "body-too-large", "The body is too large"


class NotJson(Refusal):
    """The body is not declared as JSON."""

    status, name, title = 415, "not-json", "Send application/json"


class Misdirected(Refusal):
    """The Host header names a host that this server does not serve."""

    status, name, title = 421, "misdirected", "This server does not answer to that host name"


class Unprocessable(Refusal):
    """The request is valid JSON, but a field is invalid; `errors` names each such field."""

    status, name, title = 422, "unprocessable", "The request is not valid"

    def __init__(self, location: Location, message: str) -> None:
        fault = {"loc": list(location), "msg": message, "type": "value_error"}
        super().__init__(f"{'.'.join(str(part) for part in location)}: {message}", errors=[fault])


class TooManyQueries(Refusal):
    """The run, or all runs of its owner together, would have more open queries than the server allows."""

    status, name, title = 429, "too-many-queries", "Too many open queries"


class TooManyAttempts(Refusal):
    """Too many wrong login codes came from this client."""

    status, name, title = 429, "too-many-attempts", "Too many attempts"


class TooManyMessages(Refusal):
    """Too many messages came on a play socket."""

    status, name, title = 429, "too-many-messages", "Too many messages"


class ProviderFailed(Refusal):
    """The OpenID provider cannot be reached, or does not reply as one. Try again later."""

    status, name, title = 502, "provider-failed", "The provider of sign-ins failed"


class Stopping(Refusal):
    """The server is about to stop, so send it nothing new."""

    status, name, title = 503, "stopping", "The server is stopping"


class StorageFailed(Refusal):
    """The database failed. `detail` says that nothing was stored, or that this is not known: send the same again."""

    status, name, title = 503, "storage-failed", "The store failed"


class StoreBusy(StorageFailed):
    """Too many requests wait to store something. Nothing was stored, so send the same request again."""

    name, title = "store-busy", "The store is busy"
