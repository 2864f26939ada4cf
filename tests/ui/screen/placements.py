# SPDX-License-Identifier: Apache-2.0
"""Random places and sizes for the remote view of a chat."""
import math

from chat import view_for
from true_grid import Rect

LEAST_FACE_SHARE = 0.1  # of the page's long side, as the smallest remote face of ordinary chats; smaller ones are found less well
CORNER_SHARE = 0.2  # a face so near to a corner of the page, on both axes, is taken for the user's own


def random_view(random, chat, person):
    """A view that lies within the page as a whole and shows the person's face, clear of the own picture."""
    page = chat.page
    picture, face = person.picture, person.face
    least_px = LEAST_FACE_SHARE * max(page.w, page.h)
    most_px = min(page.w / picture.w, page.h / picture.h) * face.h
    while True:
        height_px = math.exp(random.uniform(math.log(least_px), math.log(most_px)))
        scale = height_px / face.h
        x = random.uniform(page.x, page.x + page.w - picture.w * scale)
        y = random.uniform(page.y, page.y + page.h - picture.h * scale)
        middle_x = x + (face.x + face.w / 2 - picture.x) * scale
        middle_y = y + (face.y + face.h / 2 - picture.y) * scale
        shown = Rect(middle_x - height_px / 2, middle_y - height_px / 2, height_px, height_px)
        if not _overlap(shown, chat.own_view()) and not _in_corner(middle_x, middle_y, page):
            return view_for(person, height_px, middle_x, middle_y)


def _overlap(a, b):
    return a.x < b.x + b.w and b.x < a.x + a.w and a.y < b.y + b.h and b.y < a.y + a.h


def _in_corner(x, y, page):
    def near_an_end(position, length):
        return min(position, length - position) < CORNER_SHARE * length
    return near_an_end(x - page.x, page.w) and near_an_end(y - page.y, page.h)
