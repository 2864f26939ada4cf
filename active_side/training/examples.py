# SPDX-License-Identifier: Apache-2.0
"""Reads what telehug-training-frames writes (example_writer.hpp tells how) and varies it."""
import struct

import numpy as np
import torch
from torch.nn import functional as F

CANVAS_COLUMNS, CANVAS_ROWS = 128, 184
PATCH_COLUMNS, PATCH_ROWS = 64, 80
ROWS_PER_COLUMN = 1.5  # of the same length in the picture
TIP_COLUMN, TIP_ROW = 32, 44  # where a patch is laid so that the tip is there
EDGE_REACH_CELLS = 16


def read(path, which):
    """Of a file: its overviews (rig, cells, edge, tips) if `which` is 0, its patches (rig, numbers, pixels) if 1."""
    data = np.fromfile(path, dtype=np.uint8)
    view = memoryview(data)
    at, found = 0, []
    while at < len(data):
        magic, rig, columns, rows, tips, count = struct.unpack_from("<IIHHHH", view, at)
        assert magic == 0x54485543, path + " was written by another telehug-training-frames"
        at += 16
        cells = data[at:at + columns * rows * 4].reshape(rows, columns, 4)
        at += cells.size
        edge = np.frombuffer(view, "<f4", columns, at)
        at += 4 * columns
        tip_rows = np.frombuffer(view, "<f4", 6 * tips, at).reshape(tips, 6)
        at += 24 * tips
        if which == 0:
            found.append((rig, cells.copy(), edge.copy(), tip_rows.copy()))
        for _ in range(count):
            numbers = np.frombuffer(view, "<f4", 8, at)
            at += 32
            size = CANVAS_COLUMNS * CANVAS_ROWS * 3
            if which == 1:
                pixels = data[at:at + size].reshape(CANVAS_ROWS, CANVAS_COLUMNS, 3)
                found.append((rig, numbers.copy(), pixels.copy()))
            at += size
    return found


def vary_colours(x, rng):
    """Other light, skin, screens and sensors. x: n, 3, rows, columns within 0..1."""
    n = len(x)
    draw = lambda low, high, *shape: torch.from_numpy(rng.uniform(low, high, shape)).float()
    gamma = torch.exp(draw(-0.35, 0.35, n, 1, 1, 1))
    gain = torch.exp(draw(-0.45, 0.35, n, 1, 1, 1) + draw(-0.18, 0.18, n, 3, 1, 1))
    x = (x.clamp(1e-4, 1) ** gamma * gain).clamp(0, 1)
    grey = x.mean(1, keepdim=True)
    saturation = torch.where(draw(0, 1, n, 1, 1, 1) < 0.3, draw(0, 1.6, n, 1, 1, 1), draw(0.8, 1.2, n, 1, 1, 1))
    x = (grey + saturation * (x - grey)).clamp(0, 1)
    exchanged = torch.from_numpy(rng.uniform(size=n) < 0.12)
    x[exchanged] = x[exchanged][:, rng.permutation(3)]
    sd = draw(0, 0.03, n, 1, 1, 1) * (draw(0, 1, n, 1, 1, 1) < 0.6)
    return (x + sd * torch.randn(x.shape)).clamp(0, 1)


def vary_sharpness(x, rng):
    """Other lenses and webcams' sharpening: a third blurred, a third sharpened with the bright and dark rims it makes."""
    n = len(x)
    kind = torch.from_numpy(rng.uniform(size=(n, 1, 1, 1))).float()
    strength = torch.from_numpy(rng.uniform(size=(n, 1, 1, 1))).float()
    amount = torch.where(kind < 0.33, -strength, torch.where(kind < 0.67, 1.5 * strength, torch.zeros_like(strength)))
    blurred = F.avg_pool2d(F.pad(x, (1, 1, 1, 1), mode="replicate"), 3, 1)
    return (x + amount * (x - blurred)).clamp(0, 1)


def vary_light(x, rng):
    """Light that fades across the picture, in one colour or another."""
    n, _, rows, columns = x.shape
    slope = lambda size: torch.from_numpy(rng.normal(0, 0.15, (n, 3 if size > 1 else 1, 1, 1))).float()
    across, along = torch.linspace(-1, 1, columns)[None, None, None], torch.linspace(-1, 1, rows)[None, None, :, None]
    return (x * torch.exp(slope(1) * across + slope(1) * along + 0.4 * slope(3) * along)).clamp(0, 1)


def vary_parts(x, rng):
    """Edges where there are none: in a third of the patches what lies on one side of a line has another colour."""
    n, _, rows, columns = x.shape
    angle = rng.uniform(0, 2 * np.pi, (n, 1, 1))
    across, along = np.meshgrid(np.arange(columns), np.arange(rows))
    from_column, from_row = rng.uniform(10, columns - 10, (n, 1, 1)), rng.uniform(0, rows - 20, (n, 1, 1))
    side = np.cos(angle) * (across - from_column) + np.sin(angle) * (along - from_row)
    share = np.clip(side / rng.uniform(0.5, 4, (n, 1, 1)) + 0.5, 0, 1) * (rng.uniform(size=(n, 1, 1)) < 0.35)
    share = torch.from_numpy(share).float()[:, None]
    tint = torch.from_numpy(rng.uniform(0, 1, (n, 3, 1, 1))).float()
    strength = torch.from_numpy(rng.uniform(0.1, 0.55, (n, 1, 1, 1))).float()
    return x + share * strength * (tint - x)


def overview_batch(overviews, picks, rng, vary, columns=160, rows=72):
    """Inputs n, 5, rows, columns; targets and weights for every second column and row."""
    n = len(picks)
    cells = np.zeros((n, rows, columns, 4), np.uint8)
    edge_distance = np.zeros((n, rows, columns), np.float32)
    target = np.zeros((n, rows // 2, columns // 2), np.float32)
    weight = np.ones((n, rows // 2, columns // 2), np.float32)
    grid_column = 2 * np.arange(columns // 2) + 0.5
    grid_row = 2 * np.arange(rows // 2) + 0.5
    for i, pick in enumerate(picks):
        _, whole, edge, tips = overviews[pick]
        high, wide = whole.shape[:2]
        left = rng.integers(0, wide - columns + 1) if wide > columns else 0
        top = rng.integers(0, min(8, high - rows) + 1) if high > rows else 0
        if len(tips) and wide > columns and rng.uniform() < 0.7:
            left = int(np.clip(tips[rng.integers(len(tips)), 0] - rng.uniform(0, columns), 0, wide - columns))
        index_rows = np.minimum(top + np.arange(rows), high - 1)
        index_columns = np.minimum(left + np.arange(columns), wide - 1)
        cells[i] = whole[index_rows][:, index_columns]
        away = (index_rows[:, None] - edge[index_columns][None]) / EDGE_REACH_CELLS
        edge_distance[i] = np.clip(away, -1, 1)
        flip = vary and rng.uniform() < 0.5
        for column, row, crosses, _, _, width in tips:
            past = row - np.interp(column, np.arange(wide), edge)
            column, row = column - left, row - top
            if flip:
                column = columns - 1 - column
            d2 = (grid_column[None] - column) ** 2 + (grid_row[:, None] - row) ** 2
            if crosses and past > 0.8:
                target[i] = np.maximum(target[i], np.exp(-d2 / (2 * 1.8 ** 2)))
            elif past > -1.2:
                weight[i][d2 < 25] = 0
        if flip:
            cells[i] = cells[i][:, ::-1]
            edge_distance[i] = edge_distance[i][:, ::-1]
    x = torch.from_numpy(cells).permute(0, 3, 1, 2).float() / 255
    colours, difference = x[:, :3], x[:, 3:]
    if vary:
        colours = vary_colours(colours, rng)
        scale = torch.from_numpy(np.exp(rng.uniform(-0.4, 0.4, (n, 1, 1, 1)))).float()
        difference = (difference * scale).clamp(0, 1)
    x = torch.cat([2 * colours - 1, difference, torch.from_numpy(edge_distance)[:, None]], 1)
    return x, torch.from_numpy(target), torch.from_numpy(weight)


def tip_batch(patches, picks, rng, vary):
    """Inputs n, 3, rows, columns; places; numbers (column and row of the tip in the patch, present, touches, hover_mm,
    width in columns)."""
    n = len(picks)
    pixels = np.stack([patches[k][2] for k in picks])
    numbers = np.stack([patches[k][1] for k in picks]).astype(np.float32)
    # Columns and rows: most first looks are less than 8 and 12 off, second ones less than 3 and 4.
    reach = rng.choice([(3, 4), (8, 12), (14, 20)], n, p=[0.4, 0.4, 0.2])
    shift = (reach * rng.uniform(-1, 1, (n, 2))).astype(np.float32)
    present = numbers[:, 2] > 0.5
    middle = np.where(present[:, None], numbers[:, :2], [(CANVAS_COLUMNS - 1) / 2, (CANVAS_ROWS - 1) / 2])
    zoom = np.exp(rng.uniform(-0.13, 0.13, n)).astype(np.float32) if vary else np.ones(n, np.float32)
    turn = rng.uniform(-0.09, 0.09, n).astype(np.float32) if vary else np.zeros(n, np.float32)
    flip = np.where(rng.uniform(size=n) < 0.5, -1.0, 1.0).astype(np.float32) if vary else np.ones(n, np.float32)
    # Patch pixel p is canvas pixel M (p - tip_at) + middle, so the tip lies at its place plus the shift. affine_grid
    # counts in halves of the pictures from their middles.
    cos, sin = np.cos(turn) / zoom, np.sin(turn) / zoom
    matrix = np.stack([np.stack([cos * flip, -sin / ROWS_PER_COLUMN], 1),
                       np.stack([sin * flip * ROWS_PER_COLUMN, cos], 1)], 1)
    tip_at = np.array([TIP_COLUMN, TIP_ROW], np.float32) + shift
    half_patch = np.array([PATCH_COLUMNS - 1, PATCH_ROWS - 1]) / 2
    half_canvas = np.array([CANVAS_COLUMNS - 1, CANVAS_ROWS - 1]) / 2
    centre = np.einsum("nij,nj->ni", matrix, half_patch - tip_at) + middle
    theta = np.concatenate([matrix * half_patch / half_canvas[:, None], (centre / half_canvas - 1)[..., None]], 2)
    grid = F.affine_grid(torch.from_numpy(theta.astype(np.float32)), (n, 3, PATCH_ROWS, PATCH_COLUMNS), True)
    x = torch.from_numpy(pixels).permute(0, 3, 1, 2).float() / 255
    x = F.grid_sample(x, grid, padding_mode="border", align_corners=True)
    if vary:
        x = vary_colours(vary_light(vary_sharpness(vary_parts(x, rng), rng), rng), rng)
    place = numbers[:, 6:8].copy()
    place[:, 0] *= flip
    out = numbers[:, :6].copy()
    out[:, :2] = tip_at
    out[:, 5] *= zoom
    return 2 * x - 1, torch.from_numpy(place), torch.from_numpy(out)
