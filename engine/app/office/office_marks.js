// Marks: all assignments with their weights, what has changed since the last export, and the files for Moodle and Canvas.
import { ask, command, fileAddress, upload } from "./office_session.js";
import { button, choice, inFile, make, numberCell, row, shown, table } from "./office_parts.js";
import { say } from "./office_words.js";

let root = null, assignment = "", showStudent = () => {}, made = [];
export const onStudent = (show) => { showStudent = show; };

export async function show(view) {
  root = view;
  await refresh();
}

export async function refresh() {
  const data = await ask("marks");
  const heads = [say("name"), say("group"), ...data.assignments.map((one) => one.name), say("total")];
  const weightOf = (one) => make("td", { className: "number faint", textContent: say("weight", shown(one.weight)) });
  const weights = row([make("td", { colSpan: 2 }), ...data.assignments.map(weightOf), make("td")]);
  const lines = data.rows.map((one) => row([button(one.name || one.id, () => showStudent(one.id), { className: "link", title: one.id }), one.group,
    ...one.percent.map((value, i) => numberCell(value, lookOf(one.state[i]))), numberCell(one.total, { className: "number total" })], { data: { id: one.id } }));
  root.replaceChildren(drawChanges(data), drawPlatform(data), table(heads, [weights, ...lines], { id: "all-marks" }));
}

function lookOf(state) {
  if (state === "missing") return { className: "number missing", title: say("missingMark") };
  return state === "open" ? { className: "number faint", textContent: "…", title: say("openMark") } : {};
}

function drawChanges({ exported, changes }) {
  const title = exported === "" ? say("neverExported") : changes.length === 0 ? say("noChanges", exported) : say("changes", changes.length, exported);
  const rows = changes.map((one) => row([one.name, one.column, one.before || "–", one.now || "–"]));
  const write = () => command(["export", "--out=exports/marks.csv"]).then(({ code }) => offer("marks.csv", code), () => {});
  return make("section", { className: "panel", id: "changes" },
    make("p", {}, title, " ", button(say("exportMarks"), write, { className: "main" }), ...made.map(link)),
    rows.length > 0 && make("details", {}, make("summary", { textContent: say("show") }), table([say("name"), say("column_"), say("was"), say("is")], rows)));
}

const link = (name) => make("a", { href: fileAddress(name), download: name, textContent: ` ${say("download", name)}` });
function offer(name, code) {
  if (code < 0) return;
  made = [...made.filter((one) => one !== name), name];
  refresh();
}

function drawPlatform({ assignments }) {
  const open = document.getElementById("platform")?.open ?? false;
  const file = make("input", { type: "file", id: "worksheet", accept: ".csv,text/csv" }), column = make("input", { type: "text", id: "column", placeholder: "Lab 4 (1234)" });
  const fill = async () => {
    if (file.files.length === 0) return file.click();
    const name = inFile(file.files[0].name), out = `filled-${name}`;
    await upload(file.files[0], name);
    const which = assignment ? [assignment] : [], where = column.value.trim() ? [`--column=${column.value.trim()}`] : [];
    const done = await command(["export", ...which, `--worksheet=exports/${name}`, ...where, `--out=exports/${out}`]);
    return offer(out, done.words.includes(`exports/${out}`) ? 0 : -1);
  };
  const subjects = [["", say("wholeCourse")], ...assignments.map((one) => [one.name, one.name])];
  return make("details", { className: "panel", id: "platform", open }, make("summary", { textContent: say("platform") }), make("div", { className: "choices" },
    choice(say("assignment"), subjects, assignment, (value) => { assignment = value; }),
    make("label", {}, make("span", { textContent: say("worksheet") }), file),
    make("label", {}, make("span", { textContent: say("column") }), column),
    button(say("fillIn"), () => fill().catch(() => {}), { className: "main" })));
}
