# SPDX-License-Identifier: Apache-2.0
"""The grid of boxes over the remote person's body, and how far another one is off it. Lengths are px of the monitor."""
import collections
import math

COLUMNS = 5

Rect = collections.namedtuple("Rect", "x y w h")

# How far one grid is off another, in face heights of the other: the middle (to the right), the chin (down) and the
# height of the face (higher).
Offset = collections.namedtuple("Offset", "middle chin height")


class Grid(collections.namedtuple("Grid", "middle_px chin_px side_px bottom_px")):
    """Squares of half a face height, five a row, centred on the face, from the chin down to the bottom."""

    @property
    def face_height_px(self):
        return 2 * self.side_px

    def box_at(self, x_px, y_px):
        """The number of the box under a point, from 1, row by row; None beside the grid."""
        column = math.floor((x_px - self.middle_px) / self.side_px + COLUMNS / 2)
        row = math.floor((y_px - self.chin_px) / self.side_px)
        if not 0 <= column < COLUMNS or row < 0 or y_px > self.bottom_px:
            return None
        return row * COLUMNS + column + 1

    def boxes_near(self, x_px, y_px, reach_boxes):
        """The boxes under a point and those that begin within the reach of it, None among them if the grid ends there."""
        steps = [share * reach_boxes * self.side_px for share in (-1, 0, 1)]
        return {self.box_at(x_px + dx, y_px + dy) for dx in steps for dy in steps}

    def offset_from(self, other):
        height = other.face_height_px
        return Offset((self.middle_px - other.middle_px) / height, (self.chin_px - other.chin_px) / height,
                      (self.face_height_px - height) / height)

    def corrected(self, offset):
        """The grid that is off this one by `offset`."""
        height = self.face_height_px
        return Grid(self.middle_px + offset.middle * height, self.chin_px + offset.chin * height,
                    self.side_px * (1 + offset.height), self.bottom_px)

    def random_point(self, random, screen):
        """A point of the grid that lies on the part of the monitor `screen`, a Rect."""
        left = max(screen.x, self.middle_px - self.side_px * COLUMNS / 2)
        right = min(screen.x + screen.w, self.middle_px + self.side_px * COLUMNS / 2)
        return random.uniform(left, right), random.uniform(self.chin_px, self.bottom_px)


def size(offset):
    """How far off in all, in face heights."""
    return max(abs(part) for part in offset)


def grid_of(face, bottom_px):
    """Of a face from hairline to chin."""
    return Grid(face.x + face.w / 2, face.y + face.h, face.h / 2, bottom_px)
