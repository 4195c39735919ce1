// What is handed in: the report and the zip of the folder, made when somebody asks for them.
import * as editor from "/editor.js";

const $ = (id) => document.getElementById(id);
const kTasks = { "make-report": ["report", "the report is being made …"], "make-pack": ["pack", "the folder is being packed …"] };

function tell(words, failed = false) {
  $("made").textContent = words;
  $("made").classList.toggle("broken", failed);
}

async function make(command, meanwhile) {
  if (editor.hasUnsaved() && !await editor.saveAll()) return tell("not made: the text in the editor is not saved yet", true);
  for (const id of Object.keys(kTasks)) $(id).disabled = true;
  tell(meanwhile);
  try {
    const reply = await fetch(`/${command}`, { method: "POST" });
    if (!reply.ok) throw new Error(await reply.text());
    const { done, words } = await reply.json();
    tell(words.trim(), !done);
  } catch (error) {
    tell(error instanceof TypeError ? editor.kNoAnswer : error.message, true);
  }
  for (const id of Object.keys(kTasks)) $(id).disabled = false;
}

for (const [id, [command, meanwhile]] of Object.entries(kTasks)) $(id).onclick = () => make(command, meanwhile);
$("show-hand-in").onclick = () => {
  $("hand-in").hidden = !$("hand-in").hidden;
  $("show-hand-in").setAttribute("aria-expanded", String(!$("hand-in").hidden));
  if (!$("hand-in").hidden) $("make-report").focus({ preventScroll: true });
};
