#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Trains a net of active_side/finger on what telehug-training-frames wrote: train.py overview|tip OUT.net FOLDER"""
import argparse
import copy
import glob
import time

import numpy as np
import torch
from torch.nn import functional as F

import examples
import nets


def overview_loss(net, batch):
    """Penalty-reduced focal loss (Zhou, Wang, Kraehenbuehl: Objects as Points, 2019, equation 1)."""
    x, target, weight = batch
    logits = net(x)
    p = torch.sigmoid(logits)
    peak = (target > 0.9).float()
    positive = -peak * (1 - p) ** 2 * F.logsigmoid(logits)
    negative = -(1 - peak) * (1 - target) ** 4 * p ** 2 * F.logsigmoid(-logits)
    return ((positive + negative) * weight).sum() / max(1.0, float(peak.sum()))


def tip_loss(net, batch):
    x, place, numbers = batch
    logits, column, row, judged = net(x, place)
    present, touches, hover_mm, width = numbers[:, 2], numbers[:, 3], numbers[:, 4], numbers[:, 5]
    many = max(1.0, float(present.sum()))
    n, rows, columns = logits.shape
    across = (2 * torch.arange(columns) + 0.5)[None, None] - numbers[:, 0, None, None]
    along = (2 * torch.arange(rows) + 0.5)[None, :, None] - numbers[:, 1, None, None]
    wanted = torch.exp(-(across ** 2 + along ** 2) / (2 * 2.0 ** 2)).reshape(n, -1)
    wanted = wanted / wanted.sum(1, keepdim=True)
    entropy = -(wanted * F.log_softmax(logits.reshape(n, -1), 1)).sum(1)
    # Laplace distributions about the true place: the nets say how far they may be off.
    loss = 0.3 * (entropy * present).sum() / many
    for error, log_spread in ((column - numbers[:, 0], judged[:, 4]), (row - numbers[:, 1], judged[:, 5])):
        size = torch.sqrt(error ** 2 + 0.05)
        log_spread = log_spread.clamp(-3, 4)
        loss = loss + 0.5 * ((size + size.detach() * torch.exp(-log_spread) + log_spread) * present).sum() / many
    loss = loss + F.binary_cross_entropy_with_logits(judged[:, 0], present)
    certain = torch.where((touches < 0.5) & (hover_mm < 4), 0.3, 1.0) * present
    touch_loss = F.binary_cross_entropy_with_logits(judged[:, 1], touches, reduction="none")
    loss = loss + 2 * (touch_loss * certain).sum() / many
    loss = loss + 0.2 * (F.smooth_l1_loss(judged[:, 2], torch.log1p(hover_mm), reduction="none") * present).sum() / many
    loss = loss + 2 * (F.smooth_l1_loss(judged[:, 3], width / 40, reduction="none") * present).sum() / many
    return loss


@torch.no_grad()
def tip_report(net, patches, rng):
    found = []
    for start in range(0, len(patches), 256):
        picks = range(start, min(start + 256, len(patches)))
        x, place, numbers = examples.tip_batch(patches, picks, rng, False)
        _, column, row, judged = net(x, place)
        found.append(torch.cat([(column - numbers[:, 0]).abs()[:, None], (row - numbers[:, 1]).abs()[:, None],
                                numbers[:, 2:6], judged], 1))
    found = torch.cat(found)
    tip = found[:, 2] > 0.5
    touch = tip & (found[:, 3] > 0.5)
    far = tip & (found[:, 3] < 0.5) & (found[:, 4] >= 10)
    off = lambda k: f"{found[touch, k].mean():.2f} (95 % {found[touch, k].quantile(0.95):.2f})"
    says_touch = found[:, 7] > 0
    return (f"columns off {off(0)} rows {off(1)}; touches called hovering {(~says_touch[touch]).float().mean():.3f}, "
            f"hovering >= 10 mm called touching {says_touch[far].float().mean():.3f} of {int(far.sum())}; "
            f"tips missed {(found[tip, 6] < 0).float().mean():.3f}, invented {(found[~tip, 6] > 0).float().mean():.3f}; "
            f"width {(found[touch, 9] * 40 / found[touch, 5] - 1).abs().mean():.3f}")


@torch.no_grad()
def overview_report(net, overviews, rng):
    """Peaks against tips on whole overviews."""
    tips = missed = invented = 0
    for rig, cells, edge, truth in overviews:
        rows, columns = cells.shape[:2]
        x, _, _ = examples.overview_batch([(rig, cells, edge, truth)], [0], rng, False, columns // 4 * 4, rows // 4 * 4)
        heat = torch.sigmoid(net(x))[0]
        peaks = (heat == F.max_pool2d(heat[None], 3, 1, 1)[0]) & (heat > 0.3)
        places = [(2 * c + 0.5, 2 * r + 0.5) for r, c in peaks.nonzero().tolist()]
        used = set()
        for column, row, crosses, touches, hover, width in truth:
            past = row - np.interp(column, np.arange(columns), edge)
            near = [k for k, (c, r) in enumerate(places) if (c - column) ** 2 + (r - row) ** 2 < 36]
            used.update(near)
            if crosses and past > 0.8 and 0 <= column < columns and row < rows:
                tips += 1
                missed += not near
        invented += len(places) - len(used)
    return f"{tips} tips, {missed} missed, {invented} invented in {len(overviews)} pictures"


@torch.no_grad()
def average(averaged, net, keep):
    """Exponential moving average of weights and of the batch normalisations' statistics."""
    for kept, new in zip(averaged.state_dict().values(), net.state_dict().values()):
        if kept.is_floating_point():
            kept.mul_(keep).add_(new, alpha=1 - keep)
        else:
            kept.copy_(new)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("net", choices=["overview", "tip"])
    parser.add_argument("out")
    parser.add_argument("folder", help="with .bin files; such as are added meanwhile are taken in")
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--batch", type=int, default=64)
    parser.add_argument("--rate", type=float, default=2e-3)
    parser.add_argument("--start", help="weights (.pt) to go on from")
    arguments = parser.parse_args()
    torch.manual_seed(1)
    torch.set_num_threads(1)
    rng = np.random.default_rng(1)

    which = 0 if arguments.net == "overview" else 1
    data, held_back, known = [], [], set()

    def take_new_files():
        for path in sorted(glob.glob(arguments.folder + "/*.bin")):
            if path in known:
                continue
            known.add(path)
            for item in examples.read(path, which):
                (held_back if item[0] % 20 == 7 else data).append(item)  # whole rigs are held back
        print(len(data), "examples,", len(held_back), "held back", flush=True)

    take_new_files()
    net = (nets.OverviewNet() if which == 0 else nets.TipNet()).to(memory_format=torch.channels_last)
    if arguments.start:
        net.load_state_dict(torch.load(arguments.start))
    make, loss_of = ((examples.overview_batch, overview_loss), (examples.tip_batch, tip_loss))[which]
    report = (overview_report, tip_report)[which]
    averaged = copy.deepcopy(net)  # weights averaged over the last steps are better than those of any one step
    optimiser = torch.optim.AdamW(net.parameters(), lr=arguments.rate, weight_decay=1e-3)
    start, step, mean, next_report = time.monotonic(), 0, None, 0.1
    while (done := (time.monotonic() - start) / 60 / arguments.minutes) < 1:
        for group in optimiser.param_groups:  # warm-up, then half a cosine
            group["lr"] = arguments.rate * min(1, (step + 1) / 200) * 0.5 * (1 + np.cos(np.pi * done)) + 1e-6
        loss = loss_of(net, make(data, rng.integers(0, len(data), arguments.batch), rng, True))
        optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(net.parameters(), 5.0)
        optimiser.step()
        average(averaged, net, min(0.9995, step / (step + 10)))
        mean = loss.item() if mean is None else 0.99 * mean + 0.01 * loss.item()
        step += 1
        if done >= next_report or step == 300:
            averaged.eval()
            print(f"{done:.2f} step {step} loss {mean:.3f}:",
                  report(averaged, held_back[:4000], np.random.default_rng(2)), flush=True)
            torch.save(averaged.state_dict(), arguments.out + ".pt")
            take_new_files()
            if done >= next_report:
                next_report += 0.1
    averaged.eval()
    print("end, step", step, report(averaged, held_back, np.random.default_rng(2)), flush=True)
    torch.save(averaged.state_dict(), arguments.out + ".pt")
    nets.write(averaged, arguments.out)


if __name__ == "__main__":
    main()
