// What a session puts into its report: figures and tables with numbers, captions and a sentence each, as lines of the script.
import { session } from "./bench_session.js";
import { channelOf, luaText, roles, variables } from "./bench_steps.js";
import { languages, text as told, textIn, tr, trIn } from "./bench_words.js";

const labels = (models) => `{labels = {${models.map(luaText).join(", ")}}}`;
const outputsOf = (data) => variables()[data]?.output_names ?? [""];
/// Pairs of an output and an input of data, from 1 on, each with what selects it.
function pairsOf(data) {
  const { outputs = 1, inputs = 1 } = variables()[data] ?? {};
  return Array.from({ length: outputs * inputs }, (_, k) => [1 + Math.floor(k / inputs), 1 + k % inputs]).map(([i, j]) => [outputs * inputs > 1 ? `:select(${i}, ${j})` : "", i, j]);
}
const panels = (figures) => (figures.length > 1 ? `subplot(${figures.length}, 1, {\n  ${figures.join(",\n  ")}})` : figures[0]);
const POWER = tr("power of the output"), FREQUENCY = tr("frequency (rad/s)");
const spectrumOf = (data, y, title) => `loglog(range(1, 1, ${data}.N//2)*(2*math.pi/(${data}.N*${data}.Ts)),\n    fft(${y} - mean(${y})).abs:range(2, ${data}.N//2 + 1)^2*(${data}.Ts/${data}.N),\n`
  + `    {${title ? `title = ${luaText(title)}, ` : ""}xlabel = ${luaText(told(FREQUENCY))}, ylabel = ${luaText(told(POWER))}})`;

/// The models that have these outputs, by output: as compare and fit take them.
const channelOfModel = (name) => channelOf(session.steps.find((step) => step.names[0] === name) ?? { arguments: [] });
function compared(data, models) {
  const outputs = outputsOf(data), own = models.map((model) => channelOfModel(model).output);
  if (outputs.length === 1 || own.every((output) => !output)) return `compare(${[data, ...models, labels(models)].join(", ")})`;
  return panels(outputs.map((_, i) => {
    const some = models.filter((_, k) => !own[k] || own[k] === i + 1);
    return some.length > 0 ? `compare(${[`${data}:select(${i + 1})`, ...some.map((model) => (channelOfModel(model).output ? model : `${model}.channels[${i + 1}][1]`)), labels(some)].join(", ")})` : "";
  }).filter(Boolean));
}
const partOf = (data, model) => {
  const { output, input } = channelOfModel(model);
  return output && outputsOf(data).length > 1 ? `${data}:select(${[output, input].filter(Boolean).join(", ")})` : data;
};

/// The transfer functions of the models, each with what a legend calls it: several where there are several channels.
function channelsOf(models) {
  const data = variables()[roles().estimation], titles = (list, count) => (count > 1 ? list ?? [] : []);
  return models.flatMap((model) => {
    const { outputs = 1, inputs = 1 } = session.views.models?.rows?.find(({ name }) => name === model) ?? {};
    if (outputs * inputs === 1) return [{ code: model, label: model, ...channelOfModel(model) }];
    return Array.from({ length: outputs * inputs }, (_, k) => {
      const i = Math.floor(k / inputs), j = k % inputs;
      const label = [...(models.length > 1 ? [model] : []), titles(data?.input_names, inputs)[j], titles(data?.output_names, outputs)[i]].filter(Boolean).join(", ");
      return { code: `${model}.channels${outputs > 1 ? `[${i + 1}]` : ""}[${j + 1}]`, label, output: i + 1, input: j + 1 };
    });
  });
}
function together(call, models) {
  const all = channelsOf(models);
  return `${call}(${[...all.map(({ code }) => code), ...(all.length > 1 ? [labels(all.map(({ label }) => label))] : [])].join(", ")})`;
}

/// What tables and legends call things.
const BY_HAND = tr("by hand");
const TITLE = tr("Identification from {}");  // as workbench/record_choice.cpp writes it
const HEADS = { models: [tr("model"), tr("estimation (%)"), tr("validation (%)")],
                orders: [tr("poles"), tr("zeros"), trIn("report", "fit (%)"), "YIC"] };
const headText = (head, write = told) => `{${head.map((one) => luaText(write(one))).join(", ")}}`;

/// By view: the figure's code, its caption and what a sentence says that it shows.
const FIGURES = {
  record: [({ raw }) => `idplot(${raw})`,
    tr("The data: output above, input below"), tr("the measured data")],
  second: [({ second }) => `idplot(${second})`,
    tr("The validation data: output above, input below"), tr("the validation data")],
  compare: [({ validation }, models) => compared(validation, models),
    tr("Measured output and simulated outputs of the models, with the fit of each"),
    tr("measured and simulated outputs")],
  residuals: [({ validation }, models) => `(resid(${partOf(validation, models.at(-1))}, ${models.at(-1)}))`,
    tr("Autocorrelation of the simulation residuals, and their cross-correlation with the input; the gray bands show the confidence bounds"),
    tr("the residuals of the model")],
  step: [(_, models) => together("step", models),
    tr("Step response, with its confidence band if known"),
    tr("the response to a unit step")],
  impulse: [(_, models) => together("impulse", models), tr("Impulse response"), tr("the response to a unit impulse")],
  bode: [(_, models) => together("bode", models),
    tr("Frequency response: magnitude above, phase below"), tr("the frequency response")],
  nyquist: [(_, models) => together("nyquist", models),
    tr("Nyquist plot"), tr("the frequency response in the complex plane")],
  poles: [(_, models) => together("pzmap", models),
    tr("Poles (crosses) and zeros (circles) with their confidence regions if known"),
    tr("poles and zeros")],
  spectrum: [({ raw }) => panels(outputsOf(raw).map((name, i, all) => (all.length > 1 ? spectrumOf(raw, `${raw}.y:col(${i + 1})`, name) : spectrumOf(raw, `${raw}.y`)))),
    tr("Spectrum of the measured outputs"), tr("the output power as a function of frequency")],
  correlation: [({ estimation }, models) => panels(pairsOf(estimation).map(([pair, i, j]) => {
    const parts = models.map((model) => [channelsOf([model]).find((one) => !one.output || (one.output === i && one.input === j))?.code, model]).filter(([code]) => code);
    return `(impulseest(${[`${estimation}${pair}`, ...parts.map(([code]) => code), ...(parts.length > 0 ? [labels(parts.map(([, model]) => model))] : [])].join(", ")}))`;
  })),
    tr("Impulse response estimated by correlation; the gray band shows the confidence bounds"),
    tr("the impulse response estimated from the data without a model")],
  reading: [({ raw, reading }) => `compare(${raw}, ${reading}_model, ${labels([told(BY_HAND)])})`,
    tr("The data and the model determined by hand"), tr("the model determined by hand")],
  study: [({ study }) => `${study}:histograms()`,
    tr("Estimates of all runs of the Monte Carlo study, with the true values"),
    tr("the estimates of all runs")],
};
const number = (call, digits) => `string.format("%.${digits}f", ${call})`;
const TABLES = {
  parameters: [(_, models) => models.map((model) => `present(${model})`).join("\n")],
  models: [({ estimation, validation }, models, name) => {
    const outputs = variables()[estimation]?.output_names ?? [""];
    const cell = (part, model, i) => number(outputs.length > 1 && partOf(part, model) === part ? `(select(${i + 1}, fit(${part}, ${model})))` : `fit(${partOf(part, model)}, ${model})`, 1);
    const rows = models.flatMap((model) => outputs.map((output, i) => [output, i]).filter(([, i]) => [undefined, i + 1].includes(channelOfModel(model).output)).map(([output, i]) => `{${luaText(outputs.length > 1 ? `${model}, ${output}` : model)}, ${cell(estimation, model, i)}, ${cell(validation, model, i)}}`));
    return `report.table("${name}", {\n  ${headText(HEADS.models)},\n  ${rows.join(",\n  ")}})`;
  }, tr("Fit of the simulated output"), tr("how well the models simulate the data")],
  orders: [({ orders }, _, name) =>
    `local structures = {${headText(HEADS.orders)}}\nfor _, row in ipairs(${orders}.rows) do\n  if not row.failure and #structures <= 10 then\n`
      + `    structures[#structures + 1] = {row.poles, row.zeros, ${number("row.fit_percent", 1)}, ${number("row.yic", 1)}}\n  end\nend\nreport.table("${name}", structures)`,
    tr("Compared structures"), tr("the compared structures")],
};
export const goesIntoReport = (view) => Object.hasOwn(FIGURES, view) || Object.hasOwn(TABLES, view);

/// Views of one kind come under one heading.
const SECTIONS = [[tr("Data"), ["record", "second", "spectrum", "correlation"]], [tr("Model determined by hand"), ["reading"]], [tr("Choice of the structure"), ["orders"]],
  [tr("Models"), ["parameters", "models"]], [tr("Validation"), ["compare", "residuals"]], [tr("Responses"), ["step", "impulse", "bode", "nyquist", "poles"]],
  [tr("Monte Carlo study"), ["study"]]];

function freeId(view, taken) {
  let k = 1;
  const name = view === "record" ? "measured" : view;  // the cell of the data has that name
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
const wordsOf = (view, write = told) => (FIGURES[view] ?? TABLES[view]).slice(1).map((one) => write(one));

/// The lines of one view: a cell whose code is not printed, and the text that shows what it made.
function linesOf(view, models, taken) {
  const id = freeId(view, taken), [caption, shows] = wordsOf(view), cell = `\n-- %% id=${id} echo=false\n${codeOf(view, models, id)}\n`;
  if (!caption) return cell;
  const kind = FIGURES[view] ? "fig" : "tbl", sentence = told(SENTENCES[kind], id, shows);
  return cell + (kind === "fig" ? text(sentence, "", `![${caption}](figure:${id}){#fig:${id}}`) : text(sentence, "", `::: {.table name=${id} #tbl:${id}}`, caption, ":::"));
}
const SENTENCES = { fig: tr("@fig:{} shows {}."), tbl: tr("@tbl:{} shows {}.") };

/// The script with this module's own report texts in that language; texts that the user has changed stay.
export function reportIn(source, language) {
  const writers = languages.filter((code) => code !== language).map((code) => textIn.bind(null, code)), write = textIn.bind(null, language);
  const turned = new Map();
  const turn = (lineBy) => { for (const before of writers) turned.set(lineBy(before), lineBy(write)); };
  for (const [heading] of SECTIONS) turn((by) => `-- ## ${by(heading)}`);
  turn((by) => `  ${headText(HEADS.models, by)},`);
  turn((by) => `local structures = {${headText(HEADS.orders, by)}}`);
  const captioned = [...Object.keys(FIGURES), ...Object.keys(TABLES)].filter((view) => wordsOf(view).length > 0);
  for (const view of captioned) if (TABLES[view]) turn((by) => `-- ${wordsOf(view, by)[0]}`);
  for (const line of source.split("\n")) {
    const [, kind, id] = /^-- .*@(fig|tbl):([\w-]+)/.exec(line) ?? [], isFigure = /^report\.figure\("[^"]+"/.test(line), isPicture = /^-- !\[/.test(line);
    for (const view of captioned) {
      if (kind) turn((by) => `-- ${by(SENTENCES[kind], id, wordsOf(view, by)[1])}`);
      if (TABLES[view]) continue;
      if (isPicture) turn((by) => line.replace(/^-- !\[.*\]\(/, () => `-- ![${wordsOf(view, by)[0]}](`));
      else if (isFigure) turn((by) => line.replace(/, "(?:[^"\\]|\\.)*"\)$/, () => `, ${luaText(wordsOf(view, by)[0])})`));
    }
  }
  const byHand = (by) => labels([by(BY_HAND)]);
  const rewritten = (line) => {
    if (line.startsWith("report.figure(")) return writers.reduce((text, before) => text.replace(byHand(before), () => byHand(write)), line);
    for (const before of writers) {
      const [head, tail] = `-- title: ${before(TITLE, "\n")}`.split("\n");
      if (line.startsWith(head) && line.endsWith(tail)) return `-- title: ${write(TITLE, line.slice(head.length, line.length - tail.length))}`;
    }
    return line;
  };
  return source.split("\n").map((line) => rewritten(turned.get(line) ?? line)).join("\n");
}
const takenIds = () => new Set(session.cells.map(({ id }) => id));

export const viewLines = (view, models) => linesOf(view, models, takenIds());

/// The whole session's report, its views in order under headings; empty if the script itself already shows results.
export function wholeReport(shown, models) {
  if (/^-- %% \[markdown\]/m.test(session.source) || /\b(report\.|idplot|plot|figure|compare|resid|step|bode|nyquist|pzmap|present|print)\s*[({."]/.test(session.source)) return "";
  const { raw, second, orders, reading, study } = roles(), taken = takenIds();
  const there = { record: raw, second, correlation: raw && shown.includes("correlation"), spectrum: raw && shown.includes("spectrum"), reading, orders, study };
  const wanted = (view) => (view in there ? there[view] : models.length > 0 && (shown.includes(view) || ["parameters", "models"].includes(view)));
  return SECTIONS.map(([heading, views]) => [told(heading), views.filter((view) => wanted(view) && goesIntoReport(view))])
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

/// Edits that take names out of the report's own cells, which go with their texts and headings where nothing is left; and the
/// lines that are seen to by them.
export function reportWithout(names, models) {
  const lines = session.source.replace(/\n$/, "").split("\n"), cells = cellsOf(lines), edits = [], seen = new Set(), gone = new Set();
  cells.forEach((cell, k) => {
    const view = cell.id?.replace(/-\d+$/, "");
    if (!goesIntoReport(view ?? "") || !/ echo=false/.test(lines[cell.start])) return;
    const isIn = (name) => new RegExp(`(?<![\\w."])${name}(?!\\w)`).test(cell.body), rest = models.filter((model) => isIn(model) && !names.includes(model));
    if (!names.some(isIn)) return;
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
