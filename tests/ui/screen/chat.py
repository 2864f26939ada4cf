# SPDX-License-Identifier: Apache-2.0
"""A video chat in a real browser on an X display, of which it is known where the remote person is on the monitor."""
import collections
import contextlib
import time

from browser import Browser
from chat_server import ChatServer
from true_grid import Rect, grid_of

START_S = 60

# What the page showed: the remote person's face and true grid in px of the monitor, and when (monotonic clock): ordered,
# and drawn.
Shown = collections.namedtuple("Shown", "person face grid ordered_ns drawn_ns")


class Chat:
    """Shown while it is entered. `window`: where the browser's window is put, px of the monitor. `scale`: px of the
    monitor a CSS px. `bottom_px`: where the grid ends; None: with the page."""

    def __init__(self, xvfb, persons, window, scale, bottom_px=None):
        self._xvfb = xvfb
        self._persons = persons
        self._window = window
        self._scale = scale
        self._bottom_px = bottom_px
        # The smallest faces: the own picture is never mistaken for a larger remote one.
        self._own = sorted(persons, key=lambda person: person.face.h / person.picture.h)[:2]
        self.page = None  # Rect, px of the monitor

    def __enter__(self):
        with contextlib.ExitStack() as stack:
            self._server = stack.enter_context(ChatServer({person.name: person.file for person in self._persons}))
            self._browser = stack.enter_context(Browser(self._xvfb.display, self._server.url, self._window,
                                                        self._scale))
            self._find_page()
            self._stack = stack.pop_all()
        return self

    def __exit__(self, *_):
        self._stack.close()

    def _find_page(self):
        """Where the page is on the monitor is seen in the X server's own picture."""
        first = self._persons[0]
        answer = self._server.order(self._order(first, {"x": 0, "y": 40, "w": 60, "h": 60}, 0, 0), START_S)
        give_up = time.monotonic() + START_S
        while (marker := self._xvfb.find_marker()) is None:
            if time.monotonic() > give_up or not self._browser.is_running():
                raise RuntimeError("the browser's page is not seen on the display")
            time.sleep(0.05)
        x, y, side = marker
        if abs(answer["device_pixel_ratio"] - self._scale) > 1e-6 or side != round(8 * self._scale):
            raise RuntimeError(f"the page is drawn at a scale of {answer['device_pixel_ratio']}, not {self._scale}")
        size = answer["page"]
        self.page = Rect(x, y, size["w"] * self._scale, size["h"] * self._scale)

    def own_view(self):
        """Where the own picture lies (chat_page.html, chat_page.js), unless it is slimmer."""
        right, bottom = self.page.x + self.page.w, self.page.y + self.page.h
        return Rect(right - 178 * self._scale, bottom - 194 * self._scale, 162 * self._scale, 122 * self._scale)

    def show(self, person, view, liveliness, slide_s=0.0):
        """Has the remote person shown in the view, a Rect in px of the monitor; moves it there within `slide_s`."""
        place = {"x": (view.x - self.page.x) / self._scale, "y": (view.y - self.page.y) / self._scale,
                 "w": view.w / self._scale, "h": view.h / self._scale}
        answer = self._server.order(self._order(person, place, liveliness, slide_s))
        drawn = answer["remote"]
        across, down = drawn["w"] * self._scale / person.picture.w, drawn["h"] * self._scale / person.picture.h
        face = Rect(self.page.x + drawn["x"] * self._scale + (person.face.x - person.picture.x) * across,
                    self.page.y + drawn["y"] * self._scale + (person.face.y - person.picture.y) * down,
                    person.face.w * across, person.face.h * down)
        bottom_px = self._bottom_px or self.page.y + self.page.h
        return Shown(person, face, grid_of(face, bottom_px), answer["ordered_ns"], answer["answered_ns"])

    def _order(self, person, place, liveliness, slide_s):
        own = next(other for other in self._own if other != person)
        return {"remote": _head(person, 1) | place | {"liveliness": liveliness},
                "own": _head(own, 2), "slide_ms": 1000 * slide_s}


def _head(person, seed):
    return {"image": person.name, "seed": seed,
            "person": {"picture": person.picture._asdict(), "face": person.face._asdict()}}


def view_for(person, face_height_px, face_middle_x_px, face_middle_y_px):
    """Where the view of a person must lie so that the face has a height and a place."""
    scale = face_height_px / person.face.h
    picture, face = person.picture, person.face
    return Rect(face_middle_x_px - (face.x + face.w / 2 - picture.x) * scale,
                face_middle_y_px - (face.y + face.h / 2 - picture.y) * scale, picture.w * scale, picture.h * scale)
