"""A hand on a picture of cells: it points at cells, and draws along them, with a mouse or with a finger."""

from dataclasses import dataclass
from itertools import pairwise

from playwright.sync_api import CDPSession, FloatRect, Page
from tests.browser.kit import Cell

BETWEEN = 4  # where a pointer is seen between two cells


@dataclass(frozen=True)
class Board:
    """A picture of cells."""

    selector: str
    rows: int
    columns: int


MAZE, CORRIDOR = Board("canvas", 17, 17), Board("img.shown", 1, 13)


class Mouse:
    """Clicks and drags with the mouse alone."""

    def __init__(self, page: Page, board: Board = MAZE) -> None:
        self._page, self._board = page, board

    def point(self, cell: Cell, beside: tuple[float, float] = (0, 0)) -> tuple[float, float]:
        """Where a cell is in the window, in pixels; `beside` is added, as (right, down)."""
        box = box_of(self._page, self._board)
        x = box["x"] + (cell[1] + 0.5) * box["width"] / self._board.columns
        y = box["y"] + (cell[0] + 0.5) * box["height"] / self._board.rows
        return x + beside[0], y + beside[1]

    def click(self, cell: Cell, beside: tuple[float, float] = (0, 0)) -> None:
        """Click on a cell."""
        self._page.mouse.click(*self.point(cell, beside))

    def press(self, name: str) -> None:
        """Press a button."""
        self._page.get_by_role("button", name=name).first.click()

    def draw(self, *cells: Cell) -> None:
        """Draw along the lines from each cell to the next."""
        self.begin(*cells)
        self.end(cells[-1])

    def begin(self, *cells: Cell) -> None:
        """Draw along the lines from each cell to the next, and stay on the last one."""
        mouse = self._page.mouse
        mouse.move(*self.point(cells[0]))
        mouse.down()
        for cell in cells[1:]:
            mouse.move(*self.point(cell), steps=BETWEEN)

    def end(self, cell: Cell) -> None:
        """Draw on to a cell, and stop."""
        self._page.mouse.move(*self.point(cell), steps=BETWEEN)
        self._page.mouse.up()


class Finger(Mouse):
    """Taps and drags on a touch screen alone."""

    def __init__(self, page: Page, board: Board = MAZE) -> None:
        super().__init__(page, board)
        self._screen: CDPSession = page.context.new_cdp_session(page)

    def click(self, cell: Cell, beside: tuple[float, float] = (0, 0)) -> None:
        """Tap on a cell."""
        self._page.touchscreen.tap(*self.point(cell, beside))

    def press(self, name: str) -> None:
        """Tap on a button."""
        self._page.get_by_role("button", name=name).first.tap()

    def draw(self, *cells: Cell) -> None:
        """Draw with a finger: Playwright has taps only."""
        points = [self.point(cell) for cell in cells]
        self._touch("touchStart", [points[0]])
        for (left, top), (right, bottom) in pairwise(points):
            for part in range(1, BETWEEN + 1):
                share = part / BETWEEN
                self._touch("touchMove", [(left + (right - left) * share, top + (bottom - top) * share)])
        self._touch("touchEnd", [])

    def _touch(self, type_: str, points: list[tuple[float, float]]) -> None:
        touched = [{"x": x, "y": y} for x, y in points]
        self._screen.send("Input.dispatchTouchEvent", {"type": type_, "touchPoints": touched})


def box_of(page: Page, board: Board = MAZE) -> FloatRect:
    """The place of the picture in the window."""
    box = page.locator(board.selector).bounding_box()
    assert box is not None
    return box
