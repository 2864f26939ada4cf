# SPDX-License-Identifier: Apache-2.0
"""The pictures of persons that the chat shows, with their labels (hairline to chin, cheek to cheek)."""
import collections
import csv
import os

from true_grid import Rect

# `picture`: the part of the image file that is shown; both in px of the file.
Person = collections.namedtuple("Person", "name file picture face")


def read_persons(fixtures):
    """Those of tests/fixtures."""
    with open(os.path.join(fixtures, "persons", "persons.csv"), newline="") as file:
        return [Person(row["image"], os.path.join(fixtures, row["image"]), _rect(row, "picture"), _rect(row, "face"))
                for row in csv.DictReader(file)]


def read_samples(folder):
    """Those of a folder of labelled chat screens that show one remote person, as its labels.csv and views.csv say."""
    with open(os.path.join(folder, "views.csv"), newline="") as file:
        views = {row["image"]: _rect(row, "view") for row in csv.DictReader(file) if row["role"] == "remote"}
    with open(os.path.join(folder, "labels.csv"), newline="") as file:
        faces = [row for row in csv.DictReader(file) if row["role"] in ("remote", "other")]
    alone = [row for row in faces if sum(other["image"] == row["image"] for other in faces) == 1]
    return [Person(row["image"], os.path.join(folder, row["image"]), views[row["image"]], _rect(row, "face"))
            for row in alone]


def _rect(row, what):
    return Rect(*(float(row[f"{what}_{side}"]) for side in "xywh"))
