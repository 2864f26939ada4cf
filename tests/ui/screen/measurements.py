# SPDX-License-Identifier: Apache-2.0
"""What is measured of the grid that telehug lays over the remote person."""
import collections
import statistics

from chat import view_for
from placements import random_view
from true_grid import size

STILL_S = 0.75  # a grid that has stood so long has come to rest
GIVE_UP_S = 10
MOVED_FH = 0.004  # a grid that is off its last place by less has not moved
SETTLED_FH = 0.1  # a fifth of a box

Point = collections.namedtuple("Point", "x_px y_px true named near")
Placement = collections.namedtuple("Placement", "shown grid offset points problem")
Sitting = collections.namedtuple("Sitting", "shown looks moved lost offset")
Move = collections.namedtuple("Move", "shown kind sideways_fh scale true_s rest_s ordered_s offset")

LISTENING, TALKING = 0.15, 1.0  # how lively a head is


def measure_placement(random, chat, looker, person, points):
    """The boxes under random points of the body, once the grid has come to rest after the view was put elsewhere."""
    shown = chat.show(person, random_view(random, chat, person), LISTENING)
    look, _ = looker.wait_until_still(shown.drawn_ns, STILL_S, GIVE_UP_S)
    grid = look.grid if look else None
    found = []
    for _ in range(points):
        x, y = shown.grid.random_point(random, chat.page)
        named = grid.box_at(x, y) if grid else None
        found.append(Point(x, y, shown.grid.box_at(x, y), named,
                           grid is not None and named in shown.grid.boxes_near(x, y, SETTLED_FH * 2)))
    return Placement(shown, grid, grid.offset_from(shown.grid) if grid else None, found, look.problem if look else "")


def measure_sitting(chat, looker, person, face_height_px, seconds):
    """How often the grid moves while somebody sits still and talks."""
    page = chat.page
    view = view_for(person, face_height_px, page.x + 0.45 * page.w, page.y + 0.35 * page.h)
    shown = chat.show(person, view, TALKING)
    rested, _ = looker.wait_until_still(shown.drawn_ns, STILL_S, GIVE_UP_S)
    from_ns = rested.looked_ns if rested else shown.drawn_ns
    looker.wait(lambda looks: looks and looks[-1].looked_ns >= from_ns + seconds * 1e9, seconds + GIVE_UP_S)
    looks = looker.looks(from_ns)
    pairs = list(zip(looks, looks[1:]))
    lost = sum(look.grid is None for look in looks[1:])
    moved = sum(not before.grid or not after.grid or size(after.grid.offset_from(before.grid)) > MOVED_FH
                for before, after in pairs)
    offsets = [size(look.grid.offset_from(shown.grid)) for look in looks if look.grid]
    return Sitting(shown, len(pairs), moved, lost, statistics.median(offsets) if offsets else None)


def measure_move(chat, looker, before, kind, sideways_fh, scale, slide_s):
    """How soon the grid has settled after the view `before` was moved sideways and scaled. Seconds from when the page
    has drawn it: until the grid stays within a fifth of a box of the true place, of the place where it comes to rest
    (also from when the move was ordered); None: never."""
    face = before.face
    view = view_for(before.person, face.h * scale, face.x + face.w / 2 + sideways_fh * face.h, face.y + face.h / 2)
    shown = chat.show(before.person, view, LISTENING, slide_s)
    rested, _ = looker.wait_until_still(shown.drawn_ns, STILL_S, GIVE_UP_S)
    looks = looker.looks(shown.drawn_ns)
    rest = rested.grid if rested else None
    true_ns = _settled_ns(looks, shown.grid)
    rest_ns = _settled_ns(looks, rest) if rest else None
    since = lambda settled_ns, begin_ns: None if settled_ns is None else (settled_ns - begin_ns) / 1e9
    return Move(shown, kind, sideways_fh, scale, since(true_ns, shown.drawn_ns), since(rest_ns, shown.drawn_ns),
                since(rest_ns, shown.ordered_ns), rest.offset_from(shown.grid) if rest else None)


def _settled_ns(looks, target):
    """When it was first told that the grid is at the target, where it then stayed."""
    settled_ns = None
    for look in looks:
        if look.grid and size(look.grid.offset_from(target)) <= SETTLED_FH:
            settled_ns = settled_ns or look.told_ns
        else:
            settled_ns = None
    return settled_ns
