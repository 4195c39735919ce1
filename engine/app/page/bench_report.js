// What a session puts into its report: figures and tables with numbers, captions and a sentence each, as lines of the script.
import { session } from "./bench_session.js";
import { luaText, roles, variables } from "./bench_steps.js";
import { isFrench } from "./bench_words.js";

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

/// What tables and legends call things, in English and French.
const BY_HAND = ["by hand", "à la main"];
const TITLE = ["-- title: Identification from ", "-- title: Identification à partir de "];  // as workbench/record_choice.cpp writes it
const HEADS = { models: [["model", "estimation (%)", "validation (%)"], ["modèle", "estimation (%)", "validation (%)"]],
                orders: [["poles", "zeros", "fit (%)", "YIC"], ["pôles", "zéros", "ajustement (%)", "YIC"]] };
const inLanguage = ([english, french]) => (isFrench() ? french : english);
const headText = (head) => `{${head.map(luaText).join(", ")}}`;

/// By view: the figure's code, its caption and what a sentence says that it shows, in English and French.
const FIGURES = {
  record: [({ raw }) => `idplot(${raw})`, "The record: output above, input below", "the record as it was measured",
    "L'enregistrement : sortie en haut, entrée en bas", "l'enregistrement tel qu'il a été mesuré"],
  second: [({ second }) => `idplot(${second})`, "The second record: output above, input below", "the record on which the models are judged",
    "Le second enregistrement : sortie en haut, entrée en bas", "l'enregistrement sur lequel les modèles sont jugés"],
  compare: [({ validation }, models) => `compare(${[validation, ...models, labels(models)].join(", ")})`,
    "Measured output and outputs that the models simulate, with the fit of each", "what was measured and what the models simulate",
    "Sortie mesurée et sorties simulées par les modèles, avec l'ajustement de chacune", "ce qui a été mesuré et ce que simulent les modèles"],
  residuals: [({ validation }, models) => `(resid(${validation}, ${models[models.length - 1]}))`,
    "Autocorrelation of the simulation error, and its correlation with the input; the grey bands are the bounds of chance", "what the model leaves unexplained",
    "Autocorrélation de l'erreur de simulation et corrélation avec l'entrée ; les bandes grises sont les limites du hasard", "ce que le modèle n'explique pas"],
  step: [(_, models) => together("step", models), "Step response, with the band of its confidence where it is known", "the response to a unit step",
    "Réponse indicielle, avec sa bande de confiance là où elle est connue", "la réponse à un échelon unité"],
  impulse: [(_, models) => together("impulse", models), "Impulse response", "the response to an impulse", "Réponse impulsionnelle", "la réponse à une impulsion"],
  bode: [(_, models) => together("bode", models), "Frequency response: magnitude above, phase below", "the frequency response",
    "Réponse fréquentielle : gain en haut, phase en bas", "la réponse fréquentielle"],
  nyquist: [(_, models) => together("nyquist", models), "Nyquist plot", "the frequency response in the complex plane", "Lieu de Nyquist", "la réponse fréquentielle dans le plan complexe"],
  poles: [(_, models) => together("pzmap", models), "Poles (crosses) and zeros (circles) with the regions of their confidence where they are known", "poles and zeros",
    "Pôles (croix) et zéros (cercles) avec leurs régions de confiance là où elles sont connues", "les pôles et les zéros"],
  correlation: [({ estimation }, models) => `(impulseest(${[estimation, ...models, ...(models.length > 0 ? [labels(models)] : [])].join(", ")}))`,
    "Impulse response by correlation; the grey band is what chance alone would give", "the impulse response that the record shows without any model",
    "Réponse impulsionnelle par corrélation ; la bande grise est ce que donnerait le hasard seul", "la réponse impulsionnelle que montre l'enregistrement sans aucun modèle"],
  reading: [({ raw, reading }) => `compare(${raw}, ${reading}_model, ${labels([inLanguage(BY_HAND)])})`, "The record and the model that was read off it by hand", "the model that was read off by hand",
    "L'enregistrement et le modèle lu à la main", "le modèle lu à la main"],
  study: [({ study }) => `${study}:histograms()`, "Estimates of all runs of the Monte Carlo study, with the true values", "the estimates of all runs",
    "Estimées de tous les tirages de l'étude de Monte-Carlo, avec les vraies valeurs", "les estimées de tous les tirages"],
};
const number = (call, digits) => `string.format("%.${digits}f", ${call})`;
const TABLES = {
  parameters: [(_, models) => models.map((model) => `present(${model})`).join("\n")],
  models: [({ estimation, validation }, models, name) => {
    const outputs = variables()[estimation]?.output_names ?? [""];
    const cell = (part, model, i) => number(outputs.length > 1 ? `(select(${i + 1}, fit(${part}, ${model})))` : `fit(${part}, ${model})`, 1);
    const rows = models.flatMap((model) => outputs.map((output, i) => `{${luaText(outputs.length > 1 ? `${model}, ${output}` : model)}, ${cell(estimation, model, i)}, ${cell(validation, model, i)}}`));
    return `report.table("${name}", {\n  ${headText(inLanguage(HEADS.models))},\n  ${rows.join(",\n  ")}})`;
  }, "Fit of the simulated output", "how well the models simulate the records", "Ajustement de la sortie simulée", "l'ajustement des modèles"],
  orders: [({ orders }, _, name) =>
    `local structures = {${headText(inLanguage(HEADS.orders))}}\nfor _, row in ipairs(${orders}.rows) do\n  if not row.failure and #structures <= 10 then\n`
      + `    structures[#structures + 1] = {row.poles, row.zeros, ${number("row.fit_percent", 1)}, ${number("row.yic", 1)}}\n  end\nend\nreport.table("${name}", structures)`,
    "Structures that were compared", "the structures that were compared", "Structures comparées", "les structures comparées"],
};
export const goesIntoReport = (view) => Object.hasOwn(FIGURES, view) || Object.hasOwn(TABLES, view);

/// Views of one kind come under one heading.
const SECTIONS = [["Record", "Enregistrement", ["record", "second", "correlation"]], ["Reading by hand", "Lecture à la main", ["reading"]], ["Choice of the structure", "Choix de la structure", ["orders"]],
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

/// What the cell of a view holds.
function codeOf(view, models, id) {
  const code = (FIGURES[view] ?? TABLES[view])[0](roles(), models, id);
  return FIGURES[view] ? `report.figure("${id}", ${code}, ${luaText(wordsOf(view)[0])})` : code;
}
/// Caption, and what a sentence says.
const wordsOf = (view) => (FIGURES[view] ?? TABLES[view]).slice(isFrench() ? 3 : 1).slice(0, 2);

/// The lines of one view: a cell whose code is not printed, and the text that shows what it made.
function linesOf(view, models, taken) {
  const id = freeId(view, taken), [caption, shows] = wordsOf(view), cell = `\n-- %% id=${id} echo=false\n${codeOf(view, models, id)}\n`;
  if (!caption) return cell;
  const kind = FIGURES[view] ? "fig" : "tbl", sentence = inLanguage(sentences(kind, id, shows, shows));
  return cell + (kind === "fig" ? text(sentence, "", `![${caption}](figure:${id}){#fig:${id}}`) : text(sentence, "", `::: {.table name=${id} #tbl:${id}}`, caption, ":::"));
}
const sentences = (kind, id, shows, montre) => [`@${kind}:${id} shows ${shows}.`, `${kind === "fig" ? "La" : "Le"} @${kind}:${id} montre ${montre}.`];

/// The script with what this wrote into its report in the other language; what somebody has changed stays.
export function reportIn(source, french) {
  const from = french ? 0 : 1, to = 1 - from, turned = new Map();
  const turn = (pair, lineOf = (one) => `-- ${one}`) => turned.set(lineOf(pair[from]), lineOf(pair[to]));
  for (const [english, inFrench] of SECTIONS) turn([english, inFrench], (heading) => `-- ## ${heading}`);
  turn(HEADS.models, (head) => `  ${headText(head)},`);
  turn(HEADS.orders, (head) => `local structures = {${headText(head)}}`);
  const entries = [...Object.entries(FIGURES), ...Object.entries(TABLES)].filter(([, [, caption]]) => caption);
  for (const line of source.split("\n")) {
    const [, kind, id] = /^-- .*@(fig|tbl):(\S+) /.exec(line) ?? [], [, name] = /^report\.figure\("([^"]+)"/.exec(line) ?? [];
    for (const [view, [, caption, shows, legende, montre]] of entries) {
      if (kind) turn(sentences(kind, id, shows, montre));
      if (TABLES[view]) turn([caption, legende]);
      else if (/^-- !\[/.test(line)) turn([caption, legende], (words) => line.replace(/^-- !\[.*\]\(/, () => `-- ![${words}](`));
      else if (name) turn([caption, legende], (words) => line.replace(/, "(?:[^"\\]|\\.)*"\)$/, () => `, ${luaText(words)})`));
    }
  }
  const byHand = labels([BY_HAND[from]]), written = (line) => (line.startsWith("report.figure(") ? line.replace(byHand, () => labels([BY_HAND[to]]))
    : line.startsWith(TITLE[from]) ? TITLE[to] + line.slice(TITLE[from].length) : line);
  return source.split("\n").map((line) => written(turned.get(line) ?? line)).join("\n");
}
const takenIds = () => new Set(session.cells.map(({ id }) => id));

export const viewLines = (view, models) => linesOf(view, models, takenIds());

/// The whole session's report, its views in their order under headings; nothing where the script says by itself what it shows.
export function wholeReport(shown, models) {
  if (/^-- %% \[markdown\]/m.test(session.source) || /\b(report\.|idplot|plot|figure|compare|resid|step|bode|nyquist|pzmap|present|print)\s*[({."]/.test(session.source)) return "";
  const { raw, second, orders, reading, study } = roles(), taken = takenIds();
  const there = { record: raw, second, correlation: raw && shown.includes("correlation"), reading, orders, study };
  const wanted = (view) => (view in there ? there[view] : models.length > 0 && (shown.includes(view) || ["parameters", "models"].includes(view)));
  return SECTIONS.map(([english, french, views]) => [inLanguage([english, french]), views.filter((view) => wanted(view) && goesIntoReport(view))])
    .filter(([, views]) => views.length > 0)
    .map(([heading, views]) => text(`## ${heading}`) + views.map((view) => linesOf(view, models, taken)).join("")).join("");
}

/// The script's cells by their lines, 0-based, `end` behind the last.
function cellsOf(lines) {
  const starts = lines.flatMap((line, i) => (/^-- %%/.test(line) ? [i] : []));
  return starts.map((start, k) => {
    const end = starts[k + 1] ?? lines.length;
    return { start, end, id: /\bid=(\S+)/.exec(lines[start])?.[1], body: lines.slice(start + 1, end).join("\n").trim() };
  });
}
const isHeading = ({ body }) => /^-- #+ [^\n]*$/.test(body);

/// Edits that take a model out of the report's own cells, which go with their texts and headings where nothing is left; and the
/// lines that are seen to by them.
export function reportWithout(name, models) {
  const lines = session.source.replace(/\n$/, "").split("\n"), cells = cellsOf(lines), edits = [], seen = new Set(), gone = new Set();
  cells.forEach((cell, k) => {
    const view = cell.id?.replace(/-\d+$/, "");
    if (!goesIntoReport(view ?? "") || !/ echo=false/.test(lines[cell.start])) return;
    const named = models.filter((model) => new RegExp(`(?<![\\w."])${model}(?!\\w)`).test(cell.body)), rest = named.filter((model) => model !== name);
    if (!named.includes(name)) return;
    for (let line = cell.start; line < cell.end; ++line) seen.add(line + 1);
    if (rest.length > 0) {
      edits.push({ first: cell.start + 2, last: cell.start + 1 + cell.body.split("\n").length, text: codeOf(view, rest, cell.id) });
      return;
    }
    gone.add(k);
    if (new RegExp(`(figure:|name=)${cell.id}\\b`).test(cells[k + 1]?.body ?? "")) gone.add(k + 1);
  });
  cells.forEach((cell, k) => {
    if (!isHeading(cell)) return;
    const next = cells.findIndex((other, i) => i > k && isHeading(other)), below = cells.slice(k + 1, next < 0 ? cells.length : next);
    if (below.length > 0 && below.every((_, i) => gone.has(k + 1 + i))) gone.add(k);
  });
  for (const k of gone) edits.push({ first: cells[k].start + 1, last: cells[k].end, text: "" });
  return { edits, seen };
}
