// Reviews: who reviews whom with which scores, what is far from the others, reports with one review.
import { ask } from "./office_session.js";
import { askAndRun, button, choice, make, numberCell, reasonField, row, shown, table } from "./office_parts.js";
import { say } from "./office_words.js";

let root = null, assignment = "", rows = "all", chosen = "", showStudent = () => {};
export const onStudent = (show) => { showStudent = show; };

export async function show(view) {
  root = view;
  await refresh();
}

const keyOf = ({ reviewer, report }) => `${reviewer} ${report}`;

export async function refresh() {
  const data = await ask("reviews", { assignment });
  ({ assignment } = data);
  if (!assignment) return root.replaceChildren(make("p", { textContent: say("noReports") }));
  const step = (word, verb) => button(say(word), () => askAndRun(say(word), [], () => ["review", verb, assignment]));
  const bar = make("div", { className: "choices" },
    choice(say("assignment"), data.assignments.map((one) => [one, one]), assignment, (value) => { assignment = value; refresh(); }),
    ...["all", "outliers", "once", "unreviewed"].map((one) => filter(data, one)),
    step("assignAll", "assign"), step("sendAll", "send"), step("releaseAll", "release"));
  if (data.reviews.length === 0) return root.replaceChildren(bar, make("p", { textContent: say("noPairs") }));
  const most = Math.max(...data.reports.map((report) => of(data, report).length), 0);
  const lines = data.reports.filter(fits[rows](data)).map((report) => drawReport(data, report, most));
  const heads = [say("report"), say("author"), say("work"), say("ownReviews"), "", ...Array.from({ length: most }, (_, i) => `${say("reviewer")} ${i + 1}`)];
  const panel = data.reviews.find((one) => keyOf(one) === chosen);
  return root.replaceChildren(bar, panel ? drawPanel(data, panel) : "", table(heads, lines, { className: "matrix" }));
}

function filter(data, name) {
  const count = data.reports.filter(fits[name](data)).length;
  return button(`${say(name)} (${count})`, () => { rows = name; refresh(); }, { ariaPressed: String(rows === name) });
}

const of = (data, { report }) => data.reviews.filter((one) => one.report === report && (one.state !== "ended" || keyOf(one) === chosen));
const fits = {
  all: () => () => true,
  outliers: (data) => (report) => of(data, report).some((one) => one.outlier),
  once: () => (report) => report.scored === 1,
  unreviewed: () => (report) => report.scored === 0,
};

function stateOf(one) {
  return [say(`${one.state}State`), one.held && say("heldState"), one.stopped && say("stoppedState")].filter(Boolean).join(", ");
}

function drawReview({ criteria }, one) {
  const title = one.points.map((value, i) => `${criteria[i].name}: ${value ?? "–"}`).join("\n");
  const look = { className: `review${one.outlier ? " outlier" : ""}`, ariaPressed: String(keyOf(one) === chosen), title };
  return make("button", { type: "button", onclick: () => { chosen = keyOf(one); refresh(); }, ...look },
    make("b", { textContent: one.percent === undefined ? "–" : `${shown(one.percent)} %` }), ` ${one.reviewer}`, make("small", { textContent: stateOf(one) }));
}

function drawReport(data, report, most) {
  const cells = of(data, report).map((one) => make("td", {}, drawReview(data, one)));
  while (cells.length < most) cells.push(make("td"));
  const about = report.held ? say("heldState") : report.scored === 1 && report.wanted > 1 ? say("once") : report.scored === 0 ? say("unreviewed") : "";
  const author = button(report.author, () => showStudent(report.author), { className: "link" });
  return row([report.report, author, numberCell(report.work), numberCell(report.reviews), about, ...cells], { data: { report: report.report } });
}

function drawPanel({ criteria, over }, one) {
  const which = ["--stage=review", `--of=${one.report}`];
  const act = (word, words, fields = [reasonField()]) => button(say(word), () => askAndRun(say(word), fields, words));
  const buttons = [
    one.held ? act("free", ({ reason }) => ["withhold", assignment, one.reviewer, ...which, "--end", `--reason=${reason}`])
      : act("hold", ({ reason }) => ["withhold", assignment, one.reviewer, ...which, `--reason=${reason}`]),
    one.percent !== undefined && act("dropScore", ({ reason }) => ["scores", assignment, "--drop", one.reviewer, one.report, `--reason=${reason}`]),
    over && one.state === "written" && !one.held && act("release", () => ["review", "release", assignment], []),
    one.stopped && act("accept", ({ reason }) => ["review", "release", assignment, `--accept=${one.reviewer}`, `--reason=${reason}`]),
    ["written", "released", "voluntary"].includes(one.state) && act("withdraw", ({ reason }) => ["withdraw", assignment, one.reviewer, ...which, `--reason=${reason}`]),
    one.state === "withdrawn" && act("restore", ({ reason }) => ["restore", assignment, one.reviewer, ...which, `--reason=${reason}`]),
  ];
  const warnings = [one.outlier && say("outlier"), one.retaliation && say("retaliation")].filter(Boolean);
  return make("section", { className: "panel", id: "chosen-review" }, make("h2", { textContent: say("chosen", one.report, one.reviewer) }),
    make("p", { textContent: `${one.author} · ${stateOf(one)}` }), warnings.length > 0 && make("p", { className: "broken", textContent: warnings.join("; ") }),
    make("p", { className: "facts" }, ...criteria.map(({ name, most }, i) => make("span", { textContent: `${name}: ${one.points[i] ?? "–"} / ${shown(most)}` }))),
    make("p", {}, ...buttons.filter(Boolean), button(say("close"), () => { chosen = ""; refresh(); })));
}
