# SPDX-License-Identifier: Apache-2.0
"""The two nets of active_side/finger (overview_net.cpp, tip_net.cpp), for training.

Convolutions pad with zeros to keep size (stride 1) or halve it (stride 2). Batch normalisation follows every
convolution but the last ones and is folded into it when a net is written.
"""
import struct

import torch
from torch import nn
from torch.nn import functional as F


def conv(inputs, outputs, kernel, stride=1, groups=1):
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, groups=groups, bias=False), nn.BatchNorm2d(outputs))


class Separable(nn.Module):
    """A depthwise and a pointwise convolution; with `residual` the input is added to what comes out."""

    def __init__(self, inputs, outputs, kernel, stride=1, residual=False):
        super().__init__()
        self.depthwise = conv(inputs, inputs, kernel, stride, groups=inputs)
        self.pointwise = conv(inputs, outputs, 1)
        self.residual = residual

    def forward(self, x):
        y = F.relu(self.pointwise(F.relu(self.depthwise(x))))
        return x + y if self.residual else y


class OverviewNet(nn.Module):
    """Where fingertips are: logits for every second column and row of the overview."""

    def __init__(self):
        super().__init__()
        self.first = conv(5, 12, 3, 2)
        self.body = nn.Sequential(
            Separable(12, 32, 3, 2), Separable(32, 32, 5, residual=True), Separable(32, 32, 5, residual=True),
            Separable(32, 32, 5, residual=True), Separable(32, 32, 5, residual=True))
        self.hidden = conv(32, 32, 1)
        self.logits = nn.Conv2d(32, 4, 1)
        nn.init.constant_(self.logits.bias, -4.0)

    def forward(self, x):
        x = self.body(F.relu(self.first(x)))
        return F.pixel_shuffle(self.logits(F.relu(self.hidden(x))), 2)[:, 0]


class TipNet(nn.Module):
    """Where in a patch the tip is, and what it does."""

    outputs = ("present", "touches", "hover", "width", "spread_across", "spread_along")

    def __init__(self):
        super().__init__()
        self.first = conv(3, 16, 3, 2)
        self.body = nn.Sequential(
            Separable(16, 32, 3, 2), Separable(32, 48, 5), Separable(48, 48, 5, residual=True),
            Separable(48, 48, 5, residual=True))
        self.heat_hidden = conv(48, 32, 1)
        self.heat = nn.Conv2d(32, 4, 1)
        self.whole = nn.Sequential(Separable(48, 64, 3, 2), Separable(64, 64, 5, residual=True))
        self.judge_hidden = nn.Linear(64 + 48 + 2, 32)
        self.judge = nn.Linear(32, len(self.outputs))

    def forward(self, x, place):
        """x: patches; place: u and v of the patch in the picture. Returns heat logits (every second column and row),
        tip columns and rows in the patch, the outputs."""
        x = self.body(F.relu(self.first(x)))
        logits = F.pixel_shuffle(self.heat(F.relu(self.heat_hidden(x))), 2)[:, 0]
        n, rows, columns = logits.shape
        heat = F.softmax(logits.reshape(n, -1), 1).reshape(n, rows, columns)
        column = (heat.sum(1) * (2 * torch.arange(columns) + 0.5)).sum(1)
        row = (heat.sum(2) * (2 * torch.arange(rows) + 0.5)).sum(1)
        share = F.avg_pool2d(heat[:, None], 2) * 4
        about_tip = (x * share).sum((2, 3))
        whole = self.whole(x).mean((2, 3))
        judged = self.judge(F.relu(self.judge_hidden(torch.cat([whole, about_tip, place], 1))))
        return logits, column, row, judged


def folded(sequence):
    """Weight and bias of a convolution with its batch normalisation folded in."""
    convolution, norm = sequence
    scale = norm.weight / torch.sqrt(norm.running_var + norm.eps)
    return convolution.weight * scale[:, None, None, None], norm.bias - norm.running_mean * scale


def tensors(net):
    """Name and value of every tensor that the program reads, in its order; convolutions as outputs, rows, columns,
    inputs (depthwise: 1 input)."""
    found = []

    def add(name, weight, bias):
        if weight.dim() == 4:
            weight = weight.permute(0, 2, 3, 1)
        found.append((name + ".weight", weight.detach().contiguous()))
        found.append((name + ".bias", bias.detach().contiguous()))

    def walk(name, module):
        if isinstance(module, nn.Sequential) and len(module) == 2 and isinstance(module[1], nn.BatchNorm2d):
            add(name, *folded(module))
        elif isinstance(module, (nn.Conv2d, nn.Linear)):
            add(name, module.weight, module.bias)
        else:
            for child, inner in module.named_children():
                walk(name + "." + child if name else child, inner)

    walk("", net)
    return found


def write(net, path):
    net.eval()
    with open(path, "wb") as file:
        file.write(b"telehug-net 1\n")
        for name, value in tensors(net):
            shape = " ".join(str(size) for size in value.shape)
            file.write(f"{name} {shape}\n".encode())
            file.write(struct.pack(f"<{value.numel()}f", *value.reshape(-1).tolist()))
