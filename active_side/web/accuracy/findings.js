// SPDX-License-Identifier: Apache-2.0
// All that was found, as markup: what the page shows and the report holds.
import {axisFor, boxPlotsSvg} from "./box_plots.js";
import {errorsBy, summaryOf} from "./errors.js";
import {screenPlotSvg} from "./screen_plot.js";
import {dotsTable, summaryTable} from "./tables.js";

const BY_ROW = {line: "row", name: "accuracy.row_number"};
const BY_COLUMN = {line: "column", name: "accuracy.column_number"};
const KINDS = [
  {title: "accuracy.vertical_by_row", direction: "vertical_mm", ...BY_ROW},
  {title: "accuracy.vertical_by_column", direction: "vertical_mm", ...BY_COLUMN},
  {title: "accuracy.horizontal_by_row", direction: "horizontal_mm", ...BY_ROW},
  {title: "accuracy.horizontal_by_column", direction: "horizontal_mm", ...BY_COLUMN},
];

function plots(results, words) {
  const kinds = KINDS.map(({title, direction, line, name}) => ({
    title: words.text(title),
    groups: errorsBy(results, line, direction).map(({number, values}) => ({name: words.text(name, {number}), values})),
  }));
  // One axis for all, so that they can be compared.
  const end = axisFor(kinds.flatMap(({groups}) => groups));
  return kinds.map(({title, groups}) => boxPlotsSvg(title, groups, end, words)).join("");
}

function counts({found, missed, skipped, open, far}, words) {
  return words.text("accuracy.counts", {found, missed, skipped, open}) +
         (far > 0 ? ` ${words.text("accuracy.counts_far", {far})}` : "");
}

// screen: as of screenPlotSvg(); picture: a data URL, or null.
export function findingsOf({results, screen, picture}, words) {
  const summary = summaryOf(results);
  const section = (key, content) => `<section><h2>${words.text(key)}</h2>${content}</section>`;
  const where = screenPlotSvg(words.text("accuracy.where"), screen, results, picture, words);
  const legend = ["dot", "found", "missed"].map((kind) =>
      `<span class="legend-${kind}">${words.text(`accuracy.legend_${kind}`)}</span>`).join(" ");
  return section("accuracy.summary", `<p>${counts(summary, words)}</p><div class="scroll" tabindex="0" role="group" aria-label="${words.text("accuracy.summary")}">` +
                                     `${summaryTable(summary, words)}</div><p class="soft">${words.text("accuracy.definitions")}</p>`) +
         section("accuracy.where", `${where}<p class="legend">${legend}</p>`) +
         (summary.found > 0 ? section("accuracy.plots", `<div class="plots">${plots(results, words)}</div>` +
                                                        `<p class="soft">${words.text("accuracy.plots_help")}</p>`)
                            : "") +
         section("accuracy.every_dot", `<div class="scroll" tabindex="0" role="group" aria-label="${words.text("accuracy.every_dot")}">` +
                                       `${dotsTable(results, words)}</div>`);
}
