"""Every message that crosses HTTP, and nothing else: pydantic and the standard library only.

The server and the learner's client both import this package, and the page's TypeScript types are generated from it
(through the OpenAPI document), so there is one contract. Words are the paper's: a *segment* is one (s_h, g_h, tau_h),
a subgoal and the LO-level trajectory that carried it out (Le et al. 2018, section 3).

Subgoals and actions travel by name (a run declares both lists); states and instances travel as the domain's own JSON
view, which the server stores without looking inside. Times are seconds since the epoch; costs are units (the price
of one label, unless the run sets others).
"""

from waypost.wire.answers import *
from waypost.wire.assignments import *
from waypost.wire.frames import *
from waypost.wire.gold import *
from waypost.wire.people import *
from waypost.wire.play import *
from waypost.wire.queries import *
from waypost.wire.runs import *
from waypost.wire.system import *
from waypost.wire.watching import *
from waypost.wire.words import *
