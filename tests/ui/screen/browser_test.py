#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Holds `telehug-active look` against a video chat in a real browser (Chromium under Xvfb), where the test puts, scales
and moves the picture of a person and so knows where the grid of boxes must be:
  1. the box under random points of the person's body,
  2. how still the grid stands on somebody who sits still and talks,
  3. how soon it has settled after the view was moved.
Prints what it measured; exits 0 only if every limit is kept."""
import argparse
import contextlib
import os
import random
import shutil
import signal
import sys
import tempfile

import report
from chat import Chat
from looker import Looker
from measurements import measure_move, measure_placement, measure_sitting
from persons import read_persons, read_samples
from xvfb import Xvfb

WIDTH_PX, HEIGHT_PX = 1920, 1080
RUN_S = 280  # everything is ended then

POINTS = 50  # a placement
PLACEMENTS = 10  # in each of the two arrangements
SITTING_S = 9  # a person
MOVES = [("jump", 0.8, 1.0), ("slide", -0.8, 1.2), ("jump", -0.8, 1.2), ("slide", 0.8, 1 / 1.2),
         ("jump", 0.8, 1 / 1.2), ("slide", -0.8, 1.0), ("jump", -0.8, 1.2), ("slide", 0.8, 1 / 1.2)]
SLIDE_S = 0.7

WINDOW_TITLE = "telehug test chat"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--telehug", required=True, help="the program telehug-active")
    parser.add_argument("--fixtures", required=True, help="the folder tests/fixtures")
    parser.add_argument("--samples", help="a folder of labelled chat screens whose persons are shown, too, if it is there")
    parser.add_argument("--seed", type=int, default=1, help="of places and points")
    parser.add_argument("--screenshot", help="PNG file for a picture of the display")
    return parser.parse_args()


def looking(given, xvfb, settings=()):
    return Looker(given.telehug, xvfb.display, xvfb.folder, ["body_map.source=x11", *settings], RUN_S)


def on_the_whole_monitor(given, xvfb, persons, rng, results):
    with Chat(xvfb, persons, (0, 0, WIDTH_PX, HEIGHT_PX), 1, HEIGHT_PX) as chat, looking(given, xvfb) as looker:
        for i in range(PLACEMENTS):
            results.placements.append(measure_placement(rng, chat, looker, persons[i % len(persons)], POINTS))
        if given.screenshot:
            xvfb.save_png(given.screenshot)
        for person in persons[:7]:
            results.sittings.append(measure_sitting(chat, looker, person, 250, SITTING_S))
        shown = results.sittings[-1].shown
        for kind, sideways_fh, scale in MOVES:
            slide_s = SLIDE_S if kind == "slide" else 0
            move = measure_move(chat, looker, shown, kind, sideways_fh, scale, slide_s)
            results.moves.append(move)
            shown = move.shown


def in_a_pinned_window(given, xvfb, persons, rng, results):
    window = (210, 60, 1500, 960)
    with Chat(xvfb, persons, window, 1.5) as chat, \
            looking(given, xvfb, [f"body_map.window={WINDOW_TITLE}"]) as looker:
        for i in range(PLACEMENTS):
            person = persons[(PLACEMENTS + i) % len(persons)]
            results.placements.append(measure_placement(rng, chat, looker, person, POINTS))


def main():
    given = arguments()
    for program in ("Xvfb", "chromium"):
        if not shutil.which(program):
            sys.exit(f"{program} is missing: install it with 'deploy/setup test'.")
    for number in (signal.SIGTERM, signal.SIGALRM):
        signal.signal(number, lambda number, _: sys.exit(f"ended by signal {number}"))
    signal.alarm(RUN_S)
    persons = read_persons(given.fixtures)
    if given.samples and os.path.exists(given.samples):
        persons += read_samples(given.samples)
    rng = random.Random(given.seed)
    results = report.Results([], [], [])
    with contextlib.ExitStack() as stack:
        folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="telehug_xvfb."))
        xvfb = stack.enter_context(Xvfb(folder, WIDTH_PX, HEIGHT_PX))
        on_the_whole_monitor(given, xvfb, persons, rng, results)
        in_a_pinned_window(given, xvfb, persons, rng, results)
    return report.tell(results)


if __name__ == "__main__":
    sys.exit(main())
