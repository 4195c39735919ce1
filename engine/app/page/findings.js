// What `dynlab check` finds in the folder, and which answers are open, in a panel beside the document.
const $ = (id) => document.getElementById(id);

function item({ severity, place, page, what, remedy }, goTo) {
  const node = document.createElement("li");
  node.className = severity;
  const sentence = document.createElement("p");
  sentence.textContent = what;
  node.append(sentence);
  const where = place || (page ? `page ${page}` : "");
  const line = /([^\s/:]+):(\d+)$/.exec(place ?? "");
  if (line) {
    const button = document.createElement("button");
    button.textContent = where;
    button.onclick = () => goTo(line[1], Number(line[2]));
    node.append(button);
  } else if (where) {
    node.append(Object.assign(document.createElement("span"), { className: "faint", textContent: where }));
  }
  if (remedy) node.append(Object.assign(document.createElement("p"), { className: "faint", textContent: remedy }));
  return node;
}

function heading(text) {
  return Object.assign(document.createElement("h2"), { textContent: text });
}

const counted = (number, one, many) => `${number} ${number === 1 ? one : many}`;

/// `older`: the files have changed since, and are being checked again.
export function showFindings(result, openAnswers, older, goTo) {
  const findings = result?.findings ?? [];
  const rules = findings.filter(({ severity }) => severity === "rule"), hints = findings.filter(({ severity }) => severity !== "rule");
  const answers = openAnswers ? openAnswers.split(", ") : [];
  const words = [];
  if (answers.length > 0) words.push(counted(answers.length, "answer open", "answers open"));
  if (rules.length > 0) words.push(counted(rules.length, "rule broken", "rules broken"));
  if (hints.length > 0) words.push(counted(hints.length, "hint", "hints"));
  if (words.length === 0 && result) words.push("checked");
  $("show-findings").textContent = words.join(", ");
  $("show-findings").hidden = words.length === 0;
  $("show-findings").classList.toggle("broken", rules.length > 0);
  $("show-findings").classList.toggle("older", older);
  $("show-findings").title = older ? "of the files before the last change; they are being checked again" : "";
  const panel = $("findings");
  panel.replaceChildren();
  if (answers.length > 0) {
    const list = document.createElement("ul");
    list.append(...answers.map((text) => Object.assign(document.createElement("li"), { textContent: text })));
    panel.append(heading("Answers that are not given yet"), list);
  }
  for (const [title, some] of [["To be mended", rules], ["Hints", hints]]) {
    if (some.length === 0) continue;
    const list = document.createElement("ul");
    list.append(...some.map((finding) => item(finding, goTo)));
    panel.append(heading(title), list);
  }
  if (panel.children.length === 0) panel.append(Object.assign(document.createElement("p"), { textContent: "dynlab check finds nothing to mend." }));
}

$("show-findings").onclick = () => {
  const panel = $("findings");
  panel.hidden = !panel.hidden;
  $("show-findings").setAttribute("aria-expanded", String(!panel.hidden));
  if (!panel.hidden) panel.focus({ preventScroll: true });
};
