"""The control example in the page: it shows Gymnasium's pictures, and every kind of query is answered by keyboard."""

import pytest
from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner
from tests.browser.test_access import violations
from tests.examples.page import asked, give, wait_for
from waypost_control import upright_pendulum

from waypost_server.serving import Served

SEED = 4
TABLET = {"width": 768, "height": 1024}


@pytest.mark.parametrize("size", [{"width": 1440, "height": 900}, TABLET], ids=["desktop", "tablet"])
def test_every_kind_of_query_is_answered_with_the_keyboard(
    open_page: Open, learner: Learner, served: Served, size: dict[str, int]
) -> None:
    with asked(served, upright_pendulum, SEED) as queries:
        page = open_page(f"/work?run={queries[0].run}", size=size)
        for one in queries:
            wait_for(page, one)
            if one.ask.kind == "hier_demo":
                page.locator("[data-stage=here]").wait_for()
            picture = page.locator("img.shown")
            expect(picture).to_be_visible()
            expect(picture).to_have_js_property("naturalWidth", 500)
            assert violations(page) == [], one.ask.kind
            give(page, one)
            assert learner.answer_of(one.query) == one.stored
