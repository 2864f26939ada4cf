// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace telehug {

inline constexpr std::string_view report_style = R"css(
:root { color-scheme: light dark; --page: #fcfcfb; --ink: #1c2024; --soft: #5b646d; --line: #d8dcdf; --stripe: #f2f4f5;
  --true: #00708a; --found: #d2500a; --bad: #b3261e; --box: #cfe3ea; --screen: #f2f4f5; }
@media (prefers-color-scheme: dark) {
  :root { --page: #16191c; --ink: #e6e8ea; --soft: #9aa4ad; --line: #363d44; --stripe: #1e2327; --true: #4cc3de;
    --found: #ff9350; --bad: #ff8a80; --box: #274c5a; --screen: #1e2327; } }
body { background: var(--page); color: var(--ink); font: 15px/1.45 system-ui, sans-serif; margin: 0 auto;
  max-width: 1180px; padding: 24px; }
h1 { font-size: 26px; margin: 0 0 4px; } h2 { font-size: 19px; margin: 36px 0 8px; }
p, dl { max-width: 75ch; } .soft, figcaption { color: var(--soft); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 2px 16px; } dt { color: var(--soft); } dd { margin: 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { padding: 3px 9px; text-align: right; white-space: nowrap; }
thead th { border-bottom: 1px solid var(--soft); white-space: normal; vertical-align: bottom; min-width: 5ch; }
tbody th { font-weight: 500; } tr > th:first-child { text-align: left; } tbody tr:nth-child(even) { background: var(--stripe); }
tr.bad td, tr.bad th { color: var(--bad); } tr.sum th, tr.sum td { font-weight: 650; }
tbody tr:not(.sum) + tr.sum > * { border-top: 1px solid var(--soft); }
.warning { border-left: 4px solid var(--bad); padding: 6px 12px; background: var(--stripe); }
.row { display: flex; flex-wrap: wrap; gap: 20px; } .row > svg { flex: 1 1 330px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(260px, 1fr)); gap: 16px; }
figure { margin: 0; } figcaption { font-size: 13px; } figcaption b { color: var(--ink); }
svg { width: 100%; height: auto; font-family: system-ui, sans-serif; display: block; }
svg text { fill: var(--ink); font-size: 12px; } svg text.title { font-size: 14px; font-weight: 600; }
svg text.small { fill: var(--soft); font-size: 11px; } svg text.tiny { font-size: 9px; }
svg text.far { fill: var(--found); font-size: 11px; }
svg text.on-dark { fill: #fff; } svg text.on-pale { fill: #1c2024; }
.grid { stroke: var(--line); } .axis { stroke: var(--soft); }
.whisker { stroke: var(--ink); } .box { fill: var(--box); stroke: var(--ink); }
.median { stroke: var(--found); stroke-width: 2.5; } .outlier { fill: none; stroke: var(--soft); }
.screen, .cell { fill: var(--screen); stroke: var(--line); }
.error { stroke: var(--found); stroke-width: 1.2; opacity: .75; } .true { fill: none; stroke: var(--true); stroke-width: 1.6; }
.found { fill: var(--found); } .missed { stroke: var(--bad); stroke-width: 2; fill: none; }
.mark-true, .mark-found, .mark-edge { fill: none; } .mark-edge { stroke: #000; opacity: .6; }
.mark-true { stroke: #35d6ff; } .mark-found { stroke: #ff8a2b; } .mark-line { stroke: #ff8a2b; }
.key-true { color: #0aa4cc; } .key-found { color: #e86f10; }
)css";

}  // namespace telehug
