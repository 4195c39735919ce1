// What is handed in: the report and the zip of the folder, made when somebody asks for them.
import * as editor from "./editor.js";
import { order } from "./orders.js";
import { say } from "./page_words.js";

const $ = (id) => document.getElementById(id);
const kTasks = { "make-report": ["report", () => say("makingReport")], "make-pack": ["pack", () => say("makingPack")] };

function tell(words, failed = false) {
  delete $("made").dataset.say;
  $("made").textContent = words;
  $("made").classList.toggle("broken", failed);
}

async function make(command, meanwhile) {
  if (editor.hasUnsaved() && !await editor.saveAll()) return tell(say("notMade"), true);
  for (const id of Object.keys(kTasks)) $(id).disabled = true;
  tell(meanwhile());
  try {
    const reply = await order(command);
    if (!reply.ok) throw new Error(await reply.text());
    const { done, words } = await reply.json();
    tell(words.trim(), !done);
  } catch (error) {
    tell(error instanceof TypeError ? say("lost") : error.message, true);
  }
  for (const id of Object.keys(kTasks)) $(id).disabled = false;
}

for (const [id, [command, meanwhile]] of Object.entries(kTasks)) $(id).onclick = () => make(command, meanwhile);
$("show-hand-in").onclick = () => {
  $("hand-in").hidden = !$("hand-in").hidden;
  $("show-hand-in").setAttribute("aria-expanded", String(!$("hand-in").hidden));
  if (!$("hand-in").hidden) $("make-report").focus({ preventScroll: true });
};
