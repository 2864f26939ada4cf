#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what the trained nets say about made-up pictures, for tests/unit/net: golden.py OVERVIEW.pt TIP.pt FOLDER"""
import math
import sys

import torch

import nets


def wave(*sizes):
    i = torch.arange(math.prod(sizes), dtype=torch.float64)
    values = torch.sin(0.37 * i) * torch.cos(0.0021 * i)
    return values.float().reshape(1, *sizes).permute(0, 3, 1, 2)  # rows, columns, channels: channels first for PyTorch


overview, tip = nets.OverviewNet(), nets.TipNet()
overview.load_state_dict(torch.load(sys.argv[1]))
tip.load_state_dict(torch.load(sys.argv[2]))
overview.eval()
tip.eval()
with torch.no_grad():
    logits = overview(wave(53, 101, 5))[0]
    best = int(logits.argmax())
    row, column = divmod(best, logits.shape[1])
    with open(sys.argv[3] + "/overview.txt", "w") as file:
        print(2 * column + 0.5, 2 * row + 0.5, float(logits[row, column]), file=file)
    _, column, row, judged = tip(wave(80, 64, 3), torch.tensor([[0.25, -0.5]]))
    judged = judged[0].tolist()
    with open(sys.argv[3] + "/tip.txt", "w") as file:
        print(float(column), float(row), judged[0], judged[1], max(0, math.expm1(judged[2])), max(0, 40 * judged[3]),
              math.exp(judged[4]), math.exp(judged[5]), file=file)
