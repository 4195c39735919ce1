// The files to submit: the report and the zip of the folder, created on request.
import * as editor from "./editor.js";
import { say } from "./page_words.js";
import { Lost, session } from "./session.js";

const $ = (id) => document.getElementById(id);
const kTasks = { "make-report": [session.makeReport, () => say("makingReport")], "make-pack": [session.makePack, () => say("makingPack")] };

function tell(words, failed = false) {
  delete $("made").dataset.say;
  $("made").textContent = words;
  $("made").classList.toggle("broken", failed);
}

async function make(task, meanwhile) {
  if (editor.hasUnsaved() && !await editor.saveAll()) return tell(say("notMade"), true);
  for (const id of Object.keys(kTasks)) $(id).disabled = true;
  tell(meanwhile());
  try {
    const { done, words } = await task();
    tell(words.trim(), !done);
  } catch (error) {
    tell(error instanceof Lost ? say("lost") : error.message, true);
  }
  for (const id of Object.keys(kTasks)) $(id).disabled = false;
}

for (const [id, [task, meanwhile]] of Object.entries(kTasks)) $(id).onclick = () => make(task, meanwhile);
$("show-hand-in").onclick = () => {
  $("hand-in").hidden = !$("hand-in").hidden;
  $("show-hand-in").setAttribute("aria-expanded", String(!$("hand-in").hidden));
  if (!$("hand-in").hidden) $("make-report").focus({ preventScroll: true });
};
