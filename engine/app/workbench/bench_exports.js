// Exports of the session: models, the prepared data, the script.
import { session } from "./bench_session.js";
import { button, element } from "./bench_fields.js";
import { modelSteps, roles } from "./bench_steps.js";
import { download, save } from "./bench_views.js";
import { say } from "./bench_words.js";

export function exportsPanel() {
  if (!roles().raw && modelSteps().length === 0) return "";
  const { prepared } = roles(), node = element("section", { className: "panel" }, element("h2", { textContent: say("exports") }));
  const row = (words, ...buttons) => node.append(element("div", { className: "adding" }, element("span", { textContent: say("labeled", words, "").trimEnd() }), ...buttons));
  if (modelSteps().length > 0) row(say("exportModels"), ...["csv", "mat"].map((format) => button(format.toUpperCase(), () => save({ what: "models", format }), { ariaLabel: say("labeled", say("exportModels"), format) })));
  if (prepared) row(say("exportData"), ...["csv", "mat"].map((format) => button(format.toUpperCase(), () => save({ what: "data", name: prepared, format }), { ariaLabel: say("labeled", say("exportData"), format) })));
  row(say("exportScript"), button("Lua", () => download(session.file.split("/").pop(), new Blob([session.source], { type: "text/plain" })), { ariaLabel: say("labeled", say("exportScript"), "Lua") }));
  return node;
}
