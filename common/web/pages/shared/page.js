// SPDX-License-Identifier: Apache-2.0
// What all pages share: texts, commands to the daemon, live data, the language, the emergency stop.

let texts = {};

// The text of a key, with {name} replaced.
export function text(key, values = {}) {
  const found = texts[key];
  if (found === undefined) throw new Error(`there is no text "${key}"`);
  return found.replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? whole);
}

// Elements say by data-text what they contain, by data-label what screen readers call them.
export function writeTexts(root = document) {
  for (const element of root.querySelectorAll("[data-text]")) element.textContent = text(element.dataset.text);
  for (const element of root.querySelectorAll("[data-label]"))
    element.setAttribute("aria-label", text(element.dataset.label));
}

// Writes only what has changed, so that screen readers read nothing twice.
export function write(element, content) {
  if (element.textContent !== content) element.textContent = content;
}

// A text, and what the daemon says to it, which is English.
export function writeWithSaid(element, content, said) {
  if (element.textContent === `${content} ${said}`.trim()) return;
  element.replaceChildren(content);
  if (said !== "") element.append(content === "" ? "" : " ", make("span", {lang: "en", textContent: said}));
}

// What was refused: by the daemon, or by the page itself.
export function writeProblem(element, problem) {
  write(element, problem.message);
  if (problem.fromDaemon) element.lang = "en";
  else element.removeAttribute("lang");
}

export function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

function complain(message) {
  const note = document.getElementById("lost");
  write(note, message);
  note.hidden = message === "";
}

// Sends what the local socket takes (common/ctl/README.md). Throws an Error with the daemon's sentence if it refuses.
export async function command(request) {
  const response = await fetch("/command", {
    method: "POST",
    headers: {"Content-Type": "application/json"},
    body: JSON.stringify(request),
  });
  if (response.status === 401) complain(text("lost.session"));
  const answer = response.headers.get("Content-Type") === "application/json" ? await response.json() : {};
  if (answer.error) throw Object.assign(new Error(answer.error), {fromDaemon: true});
  if (!response.ok) throw new Error(text("lost.connection"));
  return answer;
}

// Follows topics while the page can be seen, or always; handlers[topic] gets each newest value. Returns what ends it.
// Browsers have six connections for all pages of a server: forgotten tabs would keep others from loading, and from
// stopping.
export function follow(handlers, {inBackground = false} = {}) {
  let source = null;
  let again = 0;
  const begin = () => {
    source = new EventSource(`/live?topics=${Object.keys(handlers).join(",")}`);
    for (const [topic, handle] of Object.entries(handlers)) {
      source.addEventListener(topic, (event) => {
        complain("");
        handle(JSON.parse(event.data));
      });
    }
    source.addEventListener("error", () => {
      complain(text("lost.connection"));
      // The browser tries again by itself, but not after an answer that was a refusal: then there is no session any
      // more, or for the moment no place.
      if (source.readyState !== EventSource.CLOSED) return;
      again = setTimeout(() => {
        begin();
        command({command: "status"}).catch(() => {});
      }, 3000);
    });
  };
  const pause = () => {
    clearTimeout(again);
    source?.close();
    source = null;
  };
  const judge = () => {
    if (document.hidden && !inBackground) pause();
    else if (source === null) begin();
  };
  judge();
  document.addEventListener("visibilitychange", judge);
  return () => {
    document.removeEventListener("visibilitychange", judge);
    pause();
  };
}

async function loadTexts(language) {
  const response = await fetch(language ? `/texts.json?lang=${encodeURIComponent(language)}` : "/texts.json");
  const answer = await response.json();
  texts = answer.texts;
  document.documentElement.lang = answer.language;
  return answer;
}

function offerLanguages(answer, changed) {
  const choice = document.getElementById("language");
  choice.replaceChildren(...answer.languages.map((language) =>
    make("option", {value: language, lang: language, textContent: text(`language.${language}`),
                    selected: language === answer.language})));
  choice.onchange = async () => {
    localStorage.setItem("language", choice.value);
    await loadTexts(choice.value);
    writeTexts();
    changed();
  };
}

// Shows problems as the daemon words them, in English.
export function showProblems(list, problems) {
  const shown = JSON.stringify(problems);
  if (list.dataset.shown === shown) return;
  list.dataset.shown = shown;
  list.replaceChildren(...problems.map((problem) =>
    make("li", {}, make("strong", {lang: "en", textContent: problem.what}),
         make("p", {}, text("problem.what_to_do"), " ", make("span", {lang: "en", textContent: problem.do})))));
  list.hidden = problems.length === 0;
}

// What a press of a button does: it can't be pressed twice at once, and what is refused is said.
export function onPress(button, act) {
  button.addEventListener("click", async () => {
    if (button.getAttribute("aria-busy") === "true") return;
    button.setAttribute("aria-busy", "true");
    const refusal = document.getElementById("refusal");
    write(refusal, "");
    try {
      await act();
    } catch (problem) {
      writeProblem(refusal, problem);
    } finally {
      button.removeAttribute("aria-busy");
    }
  });
}

// `changed` is called when the language has.
export async function beginPage(changed) {
  const answer = await loadTexts(localStorage.getItem("language"));
  offerLanguages(answer, changed);
  writeTexts();
}
