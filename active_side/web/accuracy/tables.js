// SPDX-License-Identifier: Apache-2.0
// The figures as tables, as markup for the page and the report.
import {FAR_MM, THESIS, errorOf} from "./errors.js";

const cell = (content) => `<td>${content}</td>`;
const row = (head, cells) => `<tr><th scope="row">${head}</th>${cells.map(cell).join("")}</tr>`;
const heads = (names) => `<thead><tr>${names.map((name) => `<th scope="col">${name}</th>`).join("")}</tr></thead>`;
const table = (kind, caption, head, rows) =>
    `<table class="${kind}"><caption>${caption}</caption>${head}<tbody>${rows.join("")}</tbody></table>`;

export function missedText({missed, found, missed_percent}, words) {
  if (missed_percent === null) return "–";
  return words.text("accuracy.missed_of", {percent: words.number(missed_percent), missed: missed,
                                           touched: missed + found});
}

// summary: of summaryOf().
export function summaryTable(summary, words) {
  const {horizontal, vertical, distance} = summary;
  const figure = (spread, name) => spread === null ? "–" : words.number(spread[name]);
  const offset = (spread) => spread === null ? "–" : words.signed(spread.offset_mm);
  const head = heads(["", words.text("accuracy.horizontal"), words.text("accuracy.vertical"),
                      words.text("accuracy.distance"), words.text("accuracy.thesis")]);
  const thesis = words.text("accuracy.thesis_means", {horizontal: words.number(THESIS.horizontal_mm),
                                                      vertical: words.number(THESIS.vertical_mm)});
  const three = (name) => [horizontal, vertical, distance].map((spread) => figure(spread, name));
  return table("summary", words.text("accuracy.summary_caption"), head, [
    row(words.text("accuracy.mean_size"), [...three("size_mm"), thesis]),
    row(words.text("accuracy.p95"), [...three("p95_mm"), "–"]),
    row(words.text("accuracy.most"), [...three("most_mm"), "–"]),
    row(words.text("accuracy.mean_offset"), [offset(horizontal), offset(vertical), "–", "–"]),
    row(words.text("accuracy.sd"), [figure(horizontal, "sd_mm"), figure(vertical, "sd_mm"), "–", "–"]),
    `<tr><th scope="row">${words.text("accuracy.missed")}</th><td colspan="3">${missedText(summary, words)}</td>` +
        cell(`${words.number(THESIS.missed_percent)} %`) + "</tr>",
  ]);
}

function dotRow(result, i, words) {
  const {dot, outcome} = result;
  const known = [dot.row, dot.column, words.number(dot.x_mm, 1), words.number(dot.y_mm, 1)];
  const name = words.number(i + 1, 0);
  if (outcome !== "found") return row(name, [...known, "–", "–", "–", words.text(`accuracy.was_${outcome}`)]);
  const {horizontal_mm, vertical_mm, distance_mm} = errorOf(result);
  const remark = distance_mm > FAR_MM ? words.text("accuracy.far", {mm: FAR_MM}) : "";
  return row(name, [...known, words.signed(horizontal_mm), words.signed(vertical_mm), words.number(distance_mm), remark]);
}

// Dots that were not reached yet are left out.
export function dotsTable(results, words) {
  const head = heads(["accuracy.dot", "accuracy.row", "accuracy.column", "accuracy.from_left", "accuracy.from_top",
                      "accuracy.horizontal", "accuracy.vertical", "accuracy.distance", "accuracy.remark"]
                         .map((key) => words.text(key)));
  const rows = results.flatMap((result, i) => result.outcome === "open" ? [] : [dotRow(result, i, words)]);
  return table("dots", words.text("accuracy.dots_caption"), head, rows);
}
