// What the workbench says.
import { addWords, number, text, tr, trIn } from "./words.js";

addWords({
  undo: tr("Undo"), redo: tr("Redo"), pdf: tr("Report (PDF)"), script: tr("Script"), close: tr("Close"), views: tr("Views"),
  why: tr("why?"), record: tr("Data"), preparation: tr("Preprocessing"), parts: tr("Estimation and validation"),
  estimate: tr("Estimate"), models: tr("Models"), known: tr("Known system"), reading: tr("Read by hand"),
  open: tr("Open data"), drop: tr("Drop a data file anywhere on this page, or choose one:"), file: tr("Choose a file"),
  course: tr("course data sets, and files in this folder"), role: tr("role"), unit: tr("unit"), input: tr("input"), output: tr("output"),
  time: tr("time"), unused: tr("not used"), sampling: tr("sampling time (s)"), asFile: tr("as in the file"),
  take: tr("Use these data"), second: tr("Use for validation only"), experiment: tr("Experiment"),
  advice: tr("Advice"), clean: tr("No problems were found. You can fit a model."), show: tr("show"), remove: tr("Delete"),
  off: trIn("step", "on"), up: tr("Move this step up"), down: tr("Move this step down"), divide: tr("Split 60 : 40"),
  whole: tr("All data for estimation and validation"),
  predicts: tr("This method minimizes the one-step prediction error; the fits and figures here show the simulation, which uses no measured output."),
  twoDelays: tr("The preprocessing has shifted the input (shift in samples: {}), and this model has an additional delay of {} s. The delay of the plant is the sum of both delays."),
  sameParts: tr("The model is evaluated on its estimation data, on which a model with too many parameters also fits well."),
  method: tr("Method"), newModel: tr("New model"), options: tr("Options"), notGiven: tr("not given"), delay: tr("Delay"),
  free: tr("estimated"), fixed: tr("fixed (s)"), noDelay: trIn("delay", "none"), letterD: tr("delay"),
  letterI: tr("integrator"), letterZ: tr("zero"), letterU: tr("underdamped pair"), search: tr("Search orders"),
  name: tr("name"), fitEstimation: tr("fit est. %"), fitValidation: tr("fit val. %"), condition: tr("cond."),
  white: tr("white"), independent: tr("input in residuals"), yesWord: tr("yes"), noWord: tr("no"), shown: tr("shown"), copy: tr("Copy"),
  rename: tr("Rename"), intoScript: tr("+ report"), failed: tr("failed"), older: tr("results of the script before the error"),
  ended: tr("dynlab has exited; this is the last state of the session"), running: tr("computing"), ready: tr("up to date"),
  stopped: tr("stopped; the results before the stop are shown"), again: tr("Run again"), system: tr("system"), inputSignal: tr("input"),
  noise: tr("noise, sigma"), runs: tr("runs"), begin: tr("Start study"), parameter: tr("parameter"),
  truth: trIn("column of a study", "truth"), meanOf: trIn("column of a study", "mean"),
  scatter: trIn("column of a study", "std"), bound: trIn("column of a study", "Cramér–Rao"),
  reported: trIn("column of a study", "reported std"), value: tr("estimate"), error: tr("std. error"), model: tr("model"),
  poles: tr("poles"), zeros: tr("zeros"), takeOrders: tr("estimate this structure"), estimationPart: tr("estimation"),
  validationPart: tr("validation"), edgeFrom: trIn("part of a record", "start"), edgeTo: trIn("part of a record", "end"),
  saveAs: tr("Save as"), help: tr("Help page of {}"), helpPage: tr("Help page"), step: tr("step"),
  estimateHere: tr("Estimate from here"), tooFew: tr("This file contains fewer than two signals."),
  asked: tr("This script runs programs. Run it? Answer yes only if you trust its source."), shapeFirst: tr("First order"),
  shapeSecond: tr("Second order"), shapeDelayed: tr("First order with dead time"), argument: tr("argument"),
  slider: tr("slider"), methodOf: tr("Method of {}"), labeled: trIn("label", "{}: {}"), controls: tr("Controls"),
  bar: tr("Session"), language: tr("Language"), giveUp: tr("Cancel"), newName: tr("new name"),
  invitation: tr("Open data on the left, or start a study of a known system there. Figures and models then appear here."),
  noName: tr("a name must consist of letters, digits and _; it must not start with a digit or be a Lua keyword."),
  nameTaken: tr("this name is already used in the script."), nameOfFunction: tr("a function has this name."),
  isUsed: tr("{} is used later in the script. Change that line first. Line {}: {}"), unsaved: tr("The script is not saved: {}"),
  changedMeanwhile: tr("Not applied, because another program keeps changing the script. Try again."),
  typedOver: tr("Another program changed lines that you edited. Your lines are shown; Undo restores the lines of the other program."),
  notClosed: tr("Not applied, because a quotation mark or bracket is not closed: {}"), fewDrawn: tr("The figures show the last {} of {} selected models."),
  columns: tr("Column meanings"), nameAbout: tr("variable of the script; click to show its controls"),
  methodAbout: tr("function that estimated the model"), polesAbout: tr("number of poles"), zerosAbout: tr("number of zeros"),
  delayAbout: tr("pure delay in s, and its standard error"),
  fitEstimationAbout: tr("fit of the simulated output to the estimation data, in percent; 100 % is a perfect fit"),
  fitValidationAbout: tr("fit of the simulated output to the validation data, in percent; 100 % is a perfect fit"),
  "R_T^2About": tr("1 minus the ratio of the variance of the simulation error to the variance of the output"),
  YICAbout: tr("Young's information criterion, which is lower if the errors are smaller and the parameters are better determined"),
  conditionAbout: tr("condition number of the equations; if it is very large, the data do not determine the parameters separately"),
  whiteAbout: tr("whether the residuals are white, that is, not predictable"),
  independentAbout: tr("whether the input still explains a part of the residuals; if so, the model is incomplete"),
  no_raw: tr("No data yet: open data on the left."), no_models: tr("No model yet: press \"New model\"."),
  no_orders: tr("No order search yet: press \"Search orders\"."),
  no_study: tr("No study yet: open \"Known system\" and start a study."),
  no_reading: tr("No model determined by hand yet: open \"Read by hand\" and choose a shape. The data must be a step response."),
  no_second: tr("No validation data: open data and use them for validation only."),
  no_delays: tr("The last selected model was not estimated over a grid of delays."), ofRecord: tr("of the data {}"),
  without: tr("without {}"), notAlike: tr("The validation data are not preprocessed like the estimation data."),
  prepareAlike: tr("Apply the same preprocessing"), levelStep: tr("Level"), trendStep: tr("Trend"), filterStep: tr("Filter"),
  resampleStep: tr("Resample"), outliersStep: tr("Outliers"), rangeStep: tr("Range"),
  samples: tr("{} samples"), channels: tr("Channels …"), otherChannels: tr("Choose the channels of the data: {}."),
  otherValidation: tr("The validation data and the estimation data have different channels: split the data, or open data with the same channels."),
  elsewhere: tr("Not shown: {}. The channels of these models and of the data differ."),
  output_: tr("output"), output_About: tr("output to which the numbers in this row refer"),
  ofOutput: tr("output to search"), ordersOfOne: tr("{} compares structures of one output, but {} has the outputs {}. Choose one output, or delete the search."),
  searchOne: tr("Search for {}"), showControls: tr("Show the controls of this step"), showLine: tr("Show the line"), atStep: trIn("step", "{} ({}): {}"),
  oneInput: tr("Structures can be compared only for data with one input."), making: tr("creating the report"),
  wholePage: tr("The whole page"), readFirst: tr("K = change of y/change of u = {}/{} = {}. y reaches 63 % of its change after T = {} s and stays within 5 % of its final value after 3 T = {} s. Fit {} %."),
  readDelayed: tr("y reaches 28 % of its change after t28 = {} s and 63 % after t63 = {} s, so T = 1.5 (t63 − t28) = {} s and Td = t63 − T = {} s. K = {}. Fit {} %."),
  readSecond: tr("Overshoot D = {} % after T1 = {} s: z = sqrt(ln(D)²/(ln(D)² + pi²)) = {}, w0 = pi/(T1 sqrt(1 − z²)) = {} rad/s. K = {}. y stays within 5 % of its final value after about 3/(z w0) = {} s. Fit {} %."), notDrawn: tr("Not drawn: {}"),
  noStep: tr("The input of these data is not a single step, or the response has not settled."), exports: tr("Exports"),
  exportModels: tr("Models"), exportData: tr("Preprocessed data"), exportScript: tr("Script"),
});
const VIEWS = {
  record: tr("Data"), second: tr("Validation data"), spectrum: tr("Spectrum"), compare: tr("Simulation and data"),
  residuals: tr("Simulation residuals"), step: tr("Step response"), impulse: tr("Impulse response"), bode: tr("Bode"),
  nyquist: tr("Nyquist"), poles: tr("Poles and zeros"), parameters: tr("Parameters"),
  correlation: tr("Impulse response by correlation"), delay: tr("Loss versus delay"), reading: tr("Read by hand"),
  orders: tr("Orders"), study: tr("Monte Carlo study"),
};
export { browserLanguage, label, language, languages, say, text, textIn, tr, trIn, useLanguage } from "./words.js";
export const viewName = (key) => (Object.hasOwn(VIEWS, key) ? text(VIEWS[key]) : key);
export const viewNames = () => Object.keys(VIEWS);
/// A number as a table shows it.
export function shortNumber(value, digits = 4) {
  if (value === null || value === undefined || typeof value !== "number") return "";
  const plain = Number(value.toPrecision(digits)), size = Math.abs(plain);
  if (size === 0 || (size < 1e6 && size >= 1e-4) || !Number.isFinite(size)) return number(String(plain).replace("-", "−"));
  const [factor, power] = value.toExponential(digits - 1).split("e"), raised = [...power.replace("+", "")].map((sign) => (sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign])).join("");
  return `${number(String(Number(factor)).replace("-", "−"))}·10${raised}`;
}
