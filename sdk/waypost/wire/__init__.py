"""Defines all messages of the HTTP API, with pydantic and the standard library only.

The server and the client both use these classes. The TypeScript types of the web app are generated from them through
the OpenAPI document. The terms are those of the paper: a *segment* is one (s_h, g_h, tau_h), that is, a subgoal and the
LO-level trajectory that carried it out (Le et al. 2018, section 3).

Messages contain subgoals and actions by name; a run declares both lists. They contain states and instances as JSON
views of the domain, which the server stores without reading them. Times are in seconds since the Unix epoch, except in
the audit log. Costs are in units: one label costs one unit, unless the run sets other prices.
"""

from waypost.wire.answers import *
from waypost.wire.assignments import *
from waypost.wire.audit import *
from waypost.wire.comments import *
from waypost.wire.frames import *
from waypost.wire.gold import *
from waypost.wire.people import *
from waypost.wire.play import *
from waypost.wire.queries import *
from waypost.wire.records import *
from waypost.wire.review import *
from waypost.wire.runs import *
from waypost.wire.system import *
from waypost.wire.watching import *
from waypost.wire.webhooks import *
from waypost.wire.words import *
