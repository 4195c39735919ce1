// What the workbench says.
import { addWords, number, text, tr, trIn } from "./words.js";

addWords({
  undo: tr("Undo"), redo: tr("Redo"), pdf: tr("Report (PDF)"), script: tr("Script"), close: tr("Close"), views: tr("Views"),
  why: tr("why?"), record: tr("Record"), preparation: tr("Preparation"), parts: tr("Estimation and validation"),
  estimate: tr("Estimate"), models: tr("Models"), known: tr("Known system"), reading: tr("Read by hand"),
  open: tr("Open a record"), drop: tr("Drop a data file anywhere on this page, or choose one:"), file: tr("Choose a file"),
  course: tr("course data and files here"), role: tr("role"), unit: tr("unit"), input: tr("input"), output: tr("output"),
  time: tr("time"), unused: tr("not used"), sampling: tr("sampling time (s)"), asFile: tr("as the file says"),
  take: tr("Take this record"), second: tr("Use it for validation only"), experiment: tr("Experiment"),
  advice: tr("What advice says"), clean: tr("Nothing speaks against fitting a model."), show: tr("show"), remove: tr("Delete"),
  off: trIn("step", "on"), up: tr("Earlier"), down: tr("Later"), divide: tr("Divide 60 : 40"),
  whole: tr("Whole record for both"),
  predicts: tr("This method makes the error of the prediction one step ahead small; the fits and pictures here are those of the simulation, which sees no measured output."),
  twoDelays: tr("The preparation has shifted the input by {} samples and this model has a delay of {} s besides: the plant's delay is the sum of both."),
  sameParts: tr("The model is judged on the samples it was fitted to: a model with too many parameters looks good there."),
  method: tr("Method"), newModel: tr("New model"), options: tr("Options"), notGiven: tr("not given"), delay: tr("Delay"),
  free: tr("estimated"), fixed: tr("fixed (s)"), noDelay: trIn("delay", "none"), letterD: tr("delay"),
  letterI: tr("integrator"), letterZ: tr("zero"), letterU: tr("under-damped pair"), search: tr("Search orders"),
  name: tr("name"), fitEstimation: tr("fit est. %"), fitValidation: tr("fit val. %"), condition: tr("cond."),
  white: tr("white"), independent: tr("u in rest"), yesWord: tr("yes"), noWord: tr("no"), shown: tr("shown"), copy: tr("Copy"),
  rename: tr("Rename"), intoScript: tr("+ report"), failed: tr("failed"), older: tr("of the script before the mistake"),
  ended: tr("dynlab has ended; this is its last state"), running: tr("computing"), ready: tr("up to date"),
  stopped: tr("stopped; what stands before is shown"), again: tr("Run again"), system: tr("system"), inputSignal: tr("input"),
  noise: tr("noise, sigma"), runs: tr("runs"), begin: tr("Begin a study"), parameter: tr("parameter"),
  truth: trIn("column of a study", "truth"), meanOf: trIn("column of a study", "mean"),
  scatter: trIn("column of a study", "std"), bound: trIn("column of a study", "Cramér–Rao"),
  reported: trIn("column of a study", "reported std"), value: tr("estimate"), error: tr("std. error"), model: tr("model"),
  poles: tr("poles"), zeros: tr("zeros"), takeOrders: tr("estimate this structure"), estimationPart: tr("estimation"),
  validationPart: tr("validation"), edgeFrom: trIn("part of a record", "beginning"), edgeTo: trIn("part of a record", "end"),
  saveAs: tr("Save as"), help: tr("Help page of {}"), helpPage: tr("Help page"), step: tr("step"),
  estimateHere: tr("Estimate from here"), tooFew: tr("There are no two signals in this file."),
  asked: tr("This script runs programs. Run it? Say yes only if you know where it comes from."), shapeFirst: tr("First order"),
  shapeSecond: tr("Second order"), shapeDelayed: tr("First order with dead time"), argument: tr("argument"),
  slider: tr("slider"), methodOf: tr("Method of {}"), labelled: trIn("label", "{}: {}"), controls: tr("Controls"),
  bar: tr("Session"), language: tr("Language"), giveUp: tr("Cancel"), newName: tr("new name"),
  invitation: tr("Open a record at the left, or begin a study of a known system there: pictures and models stand here then."),
  noName: tr("a name is letters, digits and _, begins with no digit, and is no word of Lua."),
  nameTaken: tr("this name stands in the script already."), nameOfFunction: tr("a function is called so."),
  isUsed: tr("{} is used further on; change that first. Line {}: {}"), unsaved: tr("The script is not saved: {}"),
  changedMeanwhile: tr("Not done: the script is being changed elsewhere all the time; try again."),
  typedOver: tr("Lines that you typed were changed elsewhere meanwhile: yours stand here; Undo brings the others back."),
  notClosed: tr("Not taken over, as it is not closed: {}"), fewDrawn: tr("The pictures show the last {} of {} ticked models."),
  columns: tr("What the columns say"), nameAbout: tr("the variable of the script; a click shows its controls"),
  methodAbout: tr("the function that estimated it"), polesAbout: tr("how many poles"), zerosAbout: tr("how many zeros"),
  delayAbout: tr("pure delay in s, and its standard error"),
  fitEstimationAbout: tr("how much of the output the simulation explains, on the samples of the estimation; 100 % is all"),
  fitValidationAbout: tr("the same on the samples of the validation"),
  "R_T^2About": tr("1 − variance of the simulation error over variance of the output"),
  YICAbout: tr("Young's criterion: small errors and certain parameters; the lower, the better"),
  conditionAbout: tr("condition number of the equations; very large: the data do not tell the parameters apart"),
  whiteAbout: tr("whether the residuals are white: nothing in them is predictable"),
  independentAbout: tr("whether the input still explains a part of the residuals; then the model lacks something"),
  no_raw: tr("There is no record yet: open one at the left."), no_models: tr("There is no model yet: press New model."),
  no_orders: tr("There is no order search yet: press Search orders."),
  no_study: tr("There is no study yet: open Known system and begin one."),
  no_reading: tr("Nothing is read by hand yet: open Read by hand and choose a shape. The record must be a step response."),
  no_second: tr("There is no second record: open one and use it for validation only."),
  no_delays: tr("The last ticked model was not estimated over a grid of delays."), ofRecord: tr("of the record {}"),
  without: tr("without {}"), notAlike: tr("The second record is not prepared as the first is."),
  prepareAlike: tr("Prepare it alike"), levelStep: tr("Level"), trendStep: tr("Trend"), filterStep: tr("Filter"),
  resampleStep: tr("Resample"), outliersStep: tr("Outliers"), rangeStep: tr("Range"),
  samples: tr("{} samples"), channels: tr("Channels …"), otherChannels: tr("Choose the channels of the record in use: {}."),
  otherValidation: tr("The validation data have other channels than the estimation data: divide the record, or open one with the same channels."),
  elsewhere: tr("Not shown: {}. These models have other channels than the data."),
  output_: tr("output"), output_About: tr("the output that the numbers of this line are about"),
  ofOutput: tr("output to search"), ordersOfOne: tr("{} compares structures of one output, but {} has {}. Choose one of them, or delete the search."),
  searchOne: tr("Search for {}"), showControls: tr("Show its controls"), showLine: tr("Show the line"), atStep: trIn("step", "{} ({}): {}"),
  oneInput: tr("Structures are compared for records of one input."), making: tr("making the report"),
  wholePage: tr("The whole page"), readFirst: tr("K = change of y/change of u = {}/{} = {}. T: 63 % of the change after {} s. Within 5 % after 3 T = {} s. Fit {} %."),
  readDelayed: tr("28 % after {} s, 63 % after {} s: T = 1.5 (t63 − t28) = {} s, Td = t63 − T = {} s. K = {}. Fit {} %."),
  readSecond: tr("Overshoot D = {} % after T1 = {} s: z = sqrt(ln(D)²/(ln(D)² + pi²)) = {}, w0 = pi/(T1 sqrt(1 − z²)) = {} rad/s. K = {}. Within 5 % after about 3/(z w0) = {} s. Fit {} %."), notDrawn: tr("Not drawn: {}"),
  noStep: tr("The input of this record is no single step, or the response has not settled."), exports: tr("Exports"),
  exportModels: tr("Models"), exportData: tr("Prepared record"), exportScript: tr("Script"),
});
const VIEWS = {
  record: tr("Record"), second: tr("Second record"), spectrum: tr("Spectrum"), compare: tr("Simulation and record"),
  residuals: tr("Simulation residuals"), step: tr("Step response"), impulse: tr("Impulse response"), bode: tr("Bode"),
  nyquist: tr("Nyquist"), poles: tr("Poles and zeros"), parameters: tr("Parameters"),
  correlation: tr("Impulse response by correlation"), delay: tr("Loss over the delay"), reading: tr("Read by hand"),
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
