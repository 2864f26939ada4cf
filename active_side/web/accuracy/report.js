// SPDX-License-Identifier: Apache-2.0
// The findings as one HTML file that needs nothing else and holds no script.
import {findingsOf} from "./findings.js";
import {escaped} from "./words.js";

function facts({status, spacing_mm, background, date}, words) {
  const screen = status.touch_screen;
  const size = {width: words.number(screen.width_mm, 0), height: words.number(screen.height_mm, 0),
                width_px: screen.width_px, height_px: screen.height_px};
  return [
    ["date", escaped(date.toLocaleString(words.language, {dateStyle: "long", timeStyle: "short"}))],
    ["screen", words.text(screen.width_px > 0 ? "accuracy.size_px" : "accuracy.size", size)],
    ["camera", escaped(status.camera.name)],
    ["calibrated", escaped(screen.calibrated)],
    ["detector", escaped(`${status.detector.name}, ${status.detector.model}`)],
    ["spacing", `${words.number(spacing_mm, 0)} mm`],
    ["background", words.text(`accuracy.back_${background}`)],
    ["version", escaped(status.version)],
  ].map(([key, value]) => `<dt>${words.text(`accuracy.fact_${key}`)}</dt><dd>${value}</dd>`).join("");
}

// check: {results, status (of the daemon), spacing_mm, background ("dark", "bright" or "picture"), picture (data URL or
// null), date}; style: the text of results.css.
export function reportHtml(check, style, words) {
  const title = words.text("accuracy.report_title");
  return `<!DOCTYPE html>
<html lang="${words.language}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:">
<title>${title}</title>
<style>
${style}</style>
</head>
<body class="report">
<main>
<h1>${title}</h1>
<p>${words.text("accuracy.report_intro")}</p>
<dl>${facts(check, words)}</dl>
${findingsOf({results: check.results, screen: check.status.touch_screen, picture: check.picture}, words)}
</main>
</body>
</html>
`;
}
