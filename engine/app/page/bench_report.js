// What a session puts into its report: figures and tables with numbers, captions and a sentence each, as lines of the script.
import { session } from "/bench_session.js";
import { luaText, roles, variables } from "/bench_steps.js";
import { isFrench } from "/bench_words.js";

const labels = (models) => `{labels = {${models.map(luaText).join(", ")}}}`;
/// The transfer functions of the models, each with what a legend calls it: several where there are several channels.
function channelsOf(models) {
  const data = variables()[roles().estimation], titles = (list, count) => (count > 1 ? list ?? [] : []);
  return models.flatMap((model) => {
    const { outputs = 1, inputs = 1 } = session.views.models?.rows?.find(({ name }) => name === model) ?? {};
    if (outputs * inputs === 1) return [{ code: model, label: model }];
    return Array.from({ length: outputs * inputs }, (_, k) => {
      const i = Math.floor(k / inputs), j = k % inputs;
      const label = [...(models.length > 1 ? [model] : []), titles(data?.input_names, inputs)[j], titles(data?.output_names, outputs)[i]].filter(Boolean).join(", ");
      return { code: `${model}.channels${outputs > 1 ? `[${i + 1}]` : ""}[${j + 1}]`, label };
    });
  });
}
function together(call, models) {
  const all = channelsOf(models);
  return `${call}(${[...all.map(({ code }) => code), ...(all.length > 1 ? [labels(all.map(({ label }) => label))] : [])].join(", ")})`;
}

/// By view: the figure's code, its caption and what a sentence says that it shows, in English and French.
const FIGURES = {
  record: [({ raw }) => `idplot(${raw})`, "The record: output above, input below", "the record as it was measured",
    "L'enregistrement : sortie en haut, entrée en bas", "l'enregistrement tel qu'il a été mesuré"],
  compare: [({ validation }, models) => `compare(${[validation, ...models, labels(models)].join(", ")})`,
    "Measured output and outputs that the models simulate, with the fit of each", "what was measured and what the models simulate",
    "Sortie mesurée et sorties simulées par les modèles, avec l'ajustement de chacune", "ce qui a été mesuré et ce que simulent les modèles"],
  residuals: [({ validation }, models) => `(resid(${validation}, ${models[models.length - 1]}))`,
    "Autocorrelation of the simulation error, and its correlation with the input; the grey bands are the bounds of chance", "what the model leaves unexplained",
    "Autocorrélation de l'erreur de simulation et corrélation avec l'entrée ; les bandes grises sont les limites du hasard", "ce que le modèle n'explique pas"],
  step: [(_, models) => together("step", models), "Step response, with the band of its confidence", "the response to a unit step",
    "Réponse indicielle, avec sa bande de confiance", "la réponse à un échelon unité"],
  impulse: [(_, models) => together("impulse", models), "Impulse response", "the response to an impulse", "Réponse impulsionnelle", "la réponse à une impulsion"],
  bode: [(_, models) => together("bode", models), "Frequency response: magnitude above, phase below", "the frequency response",
    "Réponse fréquentielle : gain en haut, phase en bas", "la réponse fréquentielle"],
  nyquist: [(_, models) => together("nyquist", models), "Nyquist plot", "the frequency response in the complex plane", "Lieu de Nyquist", "la réponse fréquentielle dans le plan complexe"],
  poles: [(_, models) => together("pzmap", models), "Poles (crosses) and zeros (circles) with the regions of their confidence", "poles and zeros",
    "Pôles (croix) et zéros (cercles) avec leurs régions de confiance", "les pôles et les zéros"],
  correlation: [({ estimation }, models) => `(impulseest(${[estimation, ...models, ...(models.length > 0 ? [labels(models)] : [])].join(", ")}))`,
    "Impulse response by correlation; the grey band is what chance alone would give", "the impulse response that the record shows without any model",
    "Réponse impulsionnelle par corrélation ; la bande grise est ce que donnerait le hasard seul", "la réponse impulsionnelle que montre l'enregistrement sans aucun modèle"],
  reading: [({ raw, reading }) => `compare(${raw}, ${reading}_model, {labels = {"by hand"}})`, "The record and the model that was read off it by hand", "the model that was read off by hand",
    "L'enregistrement et le modèle lu à la main", "le modèle lu à la main"],
  study: [({ study }) => `${study}:histograms()`, "Estimates of all runs of the Monte Carlo study, with the true values", "the estimates of all runs",
    "Estimées de tous les tirages de l'étude de Monte-Carlo, avec les vraies valeurs", "les estimées de tous les tirages"],
};
const number = (call, digits) => `string.format("%.${digits}f", ${call})`;
const TABLES = {
  parameters: [(_, models) => models.map((model) => `present(${model})`).join("\n")],
  models: [({ estimation, validation }, models, name) => {
    const head = isFrench() ? ["modèle", "estimation (%)", "validation (%)"] : ["model", "estimation (%)", "validation (%)"];
    const rows = models.map((model) => `{${luaText(model)}, ${number(`fit(${estimation}, ${model})`, 1)}, ${number(`fit(${validation}, ${model})`, 1)}}`);
    return `report.table("${name}", {\n  {${head.map(luaText).join(", ")}},\n  ${rows.join(",\n  ")}})`;
  }, "Fit of the simulated output", "how well the models simulate the records", "Ajustement de la sortie simulée", "l'ajustement des modèles"],
  orders: [({ orders }, _, name) => {
    const head = isFrench() ? ["pôles", "zéros", "ajustement (%)", "YIC"] : ["poles", "zeros", "fit (%)", "YIC"];
    return `local structures = {{${head.map(luaText).join(", ")}}}\nfor _, row in ipairs(${orders}.rows) do\n  if not row.failure and #structures <= 10 then\n`
      + `    structures[#structures + 1] = {row.poles, row.zeros, ${number("row.fit_percent", 1)}, ${number("row.yic", 1)}}\n  end\nend\nreport.table("${name}", structures)`;
  }, "Structures that were compared", "the structures that were compared", "Structures comparées", "les structures comparées"],
};
export const goesIntoReport = (view) => Object.hasOwn(FIGURES, view) || Object.hasOwn(TABLES, view);

/// Views of one kind come under one heading.
const SECTIONS = [["Record", "Enregistrement", ["record", "correlation"]], ["Reading by hand", "Lecture à la main", ["reading"]], ["Choice of the structure", "Choix de la structure", ["orders"]],
  ["Models", "Modèles", ["parameters", "models"]], ["Validation", "Validation", ["compare", "residuals"]], ["Responses", "Réponses", ["step", "impulse", "bode", "nyquist", "poles"]],
  ["Monte Carlo study", "Étude de Monte-Carlo", ["study"]]];

function freeId(view, taken) {
  let k = 1;
  const name = view === "record" ? "measured" : view;  // the record's own cell has that name
  const id = () => `${name}${k > 1 ? `-${k}` : ""}`;
  while (taken.has(id())) ++k;
  taken.add(id());
  return id();
}
const text = (...lines) => `\n-- %% [markdown]\n${lines.map((line) => `-- ${line}`.trimEnd()).join("\n")}\n`;

/// The lines of one view: a cell whose code is not printed, and the text that shows what it made.
function linesOf(view, models, taken) {
  const id = freeId(view, taken), french = isFrench();
  const [code, ...words] = FIGURES[view] ?? TABLES[view], [caption, shows] = french ? words.slice(2) : words;
  const cell = (body) => `\n-- %% id=${id} echo=false\n${body}\n`;
  if (!caption) return cell(code(roles(), models));
  if (FIGURES[view])
    return cell(`report.figure("${id}", ${code(roles(), models)}, ${luaText(caption)})`)
      + text(french ? `La @fig:${id} montre ${shows}.` : `@fig:${id} shows ${shows}.`, "", `![${caption}](figure:${id}){#fig:${id}}`);
  return cell(code(roles(), models, id))
    + text(french ? `Le @tbl:${id} montre ${shows}.` : `@tbl:${id} shows ${shows}.`, "", `::: {.table name=${id} #tbl:${id}}`, caption, ":::");
}
const takenIds = () => new Set(session.cells.map(({ id }) => id));

export const viewLines = (view, models) => linesOf(view, models, takenIds());

/// The whole session's report, its views in their order under headings; nothing where the script says by itself what it shows.
export function wholeReport(shown, models) {
  if (/^-- %% \[markdown\]/m.test(session.source) || /\b(report\.|idplot|plot|figure|compare|resid|step|bode|nyquist|pzmap|present|print)\s*[({."]/.test(session.source)) return "";
  const { raw, orders, reading, study } = roles(), taken = takenIds();
  const there = { record: raw, correlation: raw && shown.includes("correlation"), reading, orders, study };
  const wanted = (view) => (view in there ? there[view] : models.length > 0 && (shown.includes(view) || ["parameters", "models"].includes(view)));
  return SECTIONS.map(([english, french, views]) => [isFrench() ? french : english, views.filter((view) => wanted(view) && goesIntoReport(view))])
    .filter(([, views]) => views.length > 0)
    .map(([heading, views]) => text(`## ${heading}`) + views.map((view) => linesOf(view, models, taken)).join("")).join("");
}
