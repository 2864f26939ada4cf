# SPDX-License-Identifier: Apache-2.0
"""Tells what was measured, and whether the limits are kept."""
import collections
import statistics

from true_grid import size

LEAST_RIGHT = 0.98
LEAST_STRICTLY = 0.75  # far from the edges of boxes nothing must be wrong
LEAST_STILL = 0.99
MOST_SETTLING_S = 1.0

Results = collections.namedtuple("Results", "placements sittings moves")


def tell(results):
    """0 if every limit is kept, else 1."""
    kept = [tell_boxes(results.placements), tell_sittings(results.sittings), tell_moves(results.moves)]
    return 0 if all(kept) else 1


def tell_boxes(placements):
    print("\nBoxes under random points (off by: of the face height, to the right, down, higher)")
    print(f"  {'person':<22}{'face px':>8}{'middle':>9}{'chin':>8}{'height':>8}{'right':>8}{'near':>6}")
    for placement in placements:
        right = sum(point.named == point.true for point in placement.points)
        near = sum(point.near for point in placement.points)
        off = placement.offset
        where = f"{off.middle:>+9.3f}{off.chin:>+8.3f}{off.height:>+8.3f}" if off else f"{'no grid':>25}"
        print(f"  {placement.shown.person.name:<22}{placement.shown.face.h:>8.0f}{where}{right:>8}{near:>6}"
              f"  {placement.problem}")
    points = [point for placement in placements for point in placement.points]
    found = [placement.offset for placement in placements if placement.offset]
    for name in ("middle", "chin", "height"):
        values = sorted(abs(getattr(offset, name)) for offset in found)
        if values:
            print(f"  {name}: off by {statistics.median(values):.3f} in the median, "
                  f"{values[int(0.9 * (len(values) - 1))]:.3f} in 90 %, {values[-1]:.3f} at most")
    strict = sum(point.named == point.true for point in points) / len(points)
    near = sum(point.near for point in points) / len(points)
    exact = _verdict(f"{len(points)} points in {len(placements)} placements: the box itself {strict:.1%}",
                     strict >= LEAST_STRICTLY, f"at least {LEAST_STRICTLY:.0%}")
    return exact & _verdict(f"the box, or the next one within a fifth of a box of its edge: {near:.1%}", near >= LEAST_RIGHT,
                    f"at least {LEAST_RIGHT:.0%}")


def tell_sittings(sittings):
    print("\nSitting still and talking")
    for sitting in sittings:
        off = "-" if sitting.offset is None else f"{sitting.offset:.3f}"
        print(f"  {sitting.shown.person.name:<22} moved in {sitting.moved} of {sitting.looks} looks, no grid in "
              f"{sitting.lost}, off by {off} face heights")
    looks = sum(sitting.looks for sitting in sittings)
    still = 1 - sum(sitting.moved for sitting in sittings) / looks if looks else 0
    return _verdict(f"still in {still:.1%} of {looks} looks", still >= LEAST_STILL, f"at least {LEAST_STILL:.0%}")


def tell_moves(moves):
    print("\nSettled after a move (s until the grid stays within a fifth of a box of where it comes to rest; of the true "
          "place; from when the move was ordered)")
    for move in moves:
        off = "no grid" if move.offset is None else f"{size(move.offset):.3f}"
        print(f"  {move.kind:<6} {move.sideways_fh:>+5.1f} face heights, x{move.scale:.2f}: {_seconds(move.rest_s)}; "
              f"{_seconds(move.true_s)}; {_seconds(move.ordered_s)}; at rest off by {off}")
    worst = max((move.rest_s if move.rest_s is not None else float("inf")) for move in moves)
    return _verdict(f"the slowest of {len(moves)} moves: {worst:.2f} s", worst <= MOST_SETTLING_S,
                    f"at most {MOST_SETTLING_S:g} s")


def _seconds(value):
    return "never" if value is None else f"{value:.2f} s"


def _verdict(what, kept, limit):
    print(f"  {'ok    ' if kept else 'MISSED'} {what} ({limit})")
    return kept
