// SPDX-License-Identifier: Apache-2.0
// What was found, on the page and as files. run: as in accuracy.js.
import {make, text, write} from "/shared/page.js";
import {csvOf} from "./csv.js";
import {findingsOf} from "./findings.js";
import {reportHtml} from "./report.js";

const part = (id) => document.getElementById(id);

export function showFindings({check, status}, background, words) {
  write(part("done-title"), text(check.isDone ? "accuracy.done" : "accuracy.stopped_early"));
  part("go-on").hidden = check.isDone;
  part("with-picture").hidden = background.shown !== "picture";
  // All texts in it are escaped.
  part("findings").innerHTML = findingsOf({results: check.results, screen: status.touch_screen, picture: null}, words);
}

function save(run, content, type, ending) {
  const name = `telehug-accuracy-${run.date.toISOString().slice(0, 10)}.${ending}`;
  const link = make("a", {href: URL.createObjectURL(new Blob([content], {type})), download: name});
  link.click();
  URL.revokeObjectURL(link.href);
  write(part("saved"), text("accuracy.saved"));
}

export async function saveReport(run, background, words) {
  const style = await (await fetch("/accuracy/results.css")).text();
  const picture = part("with").checked ? background.thumbnail(run.status.touch_screen) : null;
  const {check, status, spacing_mm, date} = run;
  save(run, reportHtml({results: check.results, status, spacing_mm, background: background.shown, picture, date}, style, words),
       "text/html", "html");
}

export function saveCsv(run) {
  save(run, csvOf(run.check.results), "text/csv", "csv");
}
