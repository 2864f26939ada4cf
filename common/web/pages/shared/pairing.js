// SPDX-License-Identifier: Apache-2.0
// How this PC and another become a pair, and which pairs there are.
import {beginPage, command, follow, make, onPress, text, write, writeProblem} from "/shared/page.js";

const part = (id) => document.getElementById(id);
let pairing = {state: "idle"};
let pairs = [];
let asked = null;  // the pair that may be revoked

const order = (what, more = {}) => command({command: "pairing", order: what, ...more});

function drawQr(svg) {
  const picture = document.importNode(new DOMParser().parseFromString(svg, "image/svg+xml").documentElement, true);
  picture.setAttribute("role", "img");
  picture.setAttribute("aria-label", text("pairing.qr"));
  part("qr").replaceChildren(picture);
}

function showLeft() {
  const seconds = Math.max(0, Math.round((pairing.ends_s ?? 0) - Date.now() / 1000));
  const time = `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
  write(part("left"), pairing.code ? text("pairing.left", {time}) : "");
}

function showPairing() {
  const {state, code, qr, pair, problem} = pairing;
  const runs = state === "inviting" || state === "accepting";
  part("begin").hidden = state !== "idle";
  part("running").hidden = !runs;
  part("dials").hidden = code !== undefined;
  part("invitation").hidden = code === undefined;
  part("done").hidden = state !== "paired";
  part("failed").hidden = state !== "failed";
  write(part("shown-code"), code ?? "");
  if (qr) drawQr(qr);
  else part("qr").replaceChildren();
  showLeft();
  write(part("why"), problem ?? "");
  if (state === "paired") {
    write(part("done-title"), text("pairing.paired", {name: pair.name}));
    part("words").replaceChildren(...pair.phrase.split(" ").map((word) => make("li", {lang: "en", textContent: word})));
  }
}

function row(pair) {
  const revoke = make("button", {textContent: text("pairing.revoke_of", {name: pair.name})});
  revoke.addEventListener("click", () => ask(pair));
  return make("li", {}, make("span", {}, make("strong", {textContent: pair.name}), " ",
                             text("pairing.until", {date: pair.expires})), revoke);
}

function showPairs() {
  const rows = pairs.map(row);
  part("pairs").replaceChildren(...(rows.length > 0 ? rows : [make("li", {textContent: text("pairing.no_pairs")})]));
}

async function refreshPairs() {
  pairs = (await order("list")).pairs;
  showPairs();
}

// Without asking for the list again: a daemon that has lost its last pair ends, to begin anew without.
async function forget(id) {
  await order("revoke", {id});
  pairs = pairs.filter((pair) => pair.id !== id);
  showPairs();
}

function ask(pair) {
  asked = pair;
  write(part("sure-title"), text("pairing.sure", {name: pair.name}));
  part("sure").showModal();
}

function onSubmit(form, act) {
  form.addEventListener("submit", async (event) => {
    event.preventDefault();
    write(part("refusal"), "");
    try {
      await act();
    } catch (problem) {
      writeProblem(part("refusal"), problem);
    }
  });
}

function beginOrders() {
  onPress(part("stop"), () => command({command: "stop", reason: "the pairing page"}));
  onSubmit(part("invite"), () => order("invite", {name: part("name").value}));
  onSubmit(part("accept"), () => order("accept", {name: part("name").value, code: part("code").value}));
  for (const id of ["cancel", "same", "again"]) onPress(part(id), () => order("cancel"));
  onPress(part("other"), async () => {
    const {id} = pairing.pair;
    await order("cancel");
    await forget(id);
  });
  part("keep").addEventListener("click", () => part("sure").close());
  onPress(part("revoke"), async () => {
    part("sure").close();
    await forget(asked.id);
  });
}

function showNews(news) {
  pairing = news;
  showPairing();
  refreshPairs().catch(() => {});  // that the daemon is gone is said by follow()
}

function writeAll() {
  document.title = `${text("pairing.title")} - telehug`;
  showPairing();
  showPairs();
}

await beginPage(writeAll);
beginOrders();
writeAll();
await refreshPairs();
follow({pairing: showNews});
setInterval(showLeft, 1000);
