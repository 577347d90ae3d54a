"""Every message that crosses HTTP, and nothing else: pydantic and the standard library only.

The server and the learner's client both import this package, and the page's TypeScript types are generated from it
(through the OpenAPI document), so there is one contract. Words are the paper's: a *segment* is one (s_h, g_h, tau_h),
a subgoal and the LO-level trajectory that carried it out (Le et al. 2018, section 3).

Subgoals and actions travel by name (a run declares both lists); states and instances travel as the domain's own JSON
view, which the server stores without looking inside. Times are seconds since the epoch; costs are units (the price
of one label, unless the run sets others).
"""

from server.wire.answers import *
from server.wire.assignments import *
from server.wire.frames import *
from server.wire.gold import *
from server.wire.people import *
from server.wire.play import *
from server.wire.queries import *
from server.wire.runs import *
from server.wire.system import *
from server.wire.watching import *
from server.wire.words import *
