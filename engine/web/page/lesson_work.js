// The work on a lesson: texts of places of its script and of other files, kept in the browser, exported and imported, in links.
import { LessonScript } from "./lesson_script.js";
import { kept, oneWriter, storedWork, storeWork } from "./work_store.js";

const kSoon = 300;  // ms behind the last letter
const kMostScript = 4 << 20;  // letters of a script that is taken over

/// {name, text | base64} of the files of a folder that lie beside the page.
async function filesOf(description, address) {
  return Promise.all(description.files.map(async (file) => {
    if (file.path === undefined) return file;
    const reply = await fetch(new URL(file.path, address));
    if (!reply.ok) throw new Error(file.path);
    const bytes = new Uint8Array(await reply.arrayBuffer());
    let letters = "";
    for (let i = 0; i < bytes.length; i += 0x8000) letters += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
    return { name: file.name, base64: btoa(letters) };
  }));
}

async function packed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}
/// Nothing where it is no such text, or one of more than `most` bytes.
async function unpacked(written, most) {
  try {
    const bytes = Uint8Array.from(atob(written.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader(), pieces = [];
    let size = 0;
    for (let { done, value } = await reader.read(); !done; { done, value } = await reader.read()) {
      size += value.length;
      if (size > most) return null;
      pieces.push(value);
    }
    return new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(pieces).arrayBuffer());
  } catch {
    return null;
  }
}

export class LessonWork {
  /// `description`: lesson.json; `key`: names the lesson of this site among all that the browser keeps.
  static async open(description, address, key, onWriter) {
    const work = new LessonWork();
    const files = await filesOf(description, address), main = files.find(({ name }) => name === description.file);
    Object.assign(work, { key, description, script: new LessonScript(main.text), texts: new Map(), shared: null, older: null, takenOver: "",
                          others: files.filter((file) => file !== main), changed: new Map(), timer: 0 });
    work.writer = oneWriter(key, async (writes) => { if (writes) await work.recall(); onWriter(writes); });
    await work.recall();
    return work;
  }
  /// What was kept, where it fits the lesson as it is now.
  async recall() {
    const stored = await storedWork(this.key);
    if (!stored) return;
    this.older = stored.older ?? null;
    this.changed = new Map(Object.entries(stored.files ?? {}));
    if (stored.original === this.script.original) {
      this.texts = new Map(stored.texts);
      return;
    }
    const before = new LessonScript(stored.original), written = new Map(stored.texts), mine = before.compose(written).text;
    if (written.size === 0) return;
    const markers = this.script.places.map(({ marker }) => marker);
    const same = markers.length === before.places.length && markers.every((marker, i) => marker === before.places[i].marker);
    this.texts = new Map();
    let lost = 0;
    for (const [place, text] of written) {
      const { marker } = before.places[place], now = same ? place : /\bid=/.test(marker ?? "") ? markers.indexOf(marker) : -1;
      if (now >= 0) this.texts.set(now, text);
      else ++lost;
    }
    this.older = mine;
    this.takenOver = lost > 0 ? "lostPlaces" : "newerLesson";
    await this.store();
  }

  textOf(place) { return this.visible.get(place) ?? this.script.places[place].source; }
  ownText(place) { return this.script.places[place].source; }
  get visible() { return this.shared ?? this.texts; }
  get composed() { return this.script.compose(this.visible); }

  change(place, text) {
    if (text === this.ownText(place)) this.texts.delete(place);
    else this.texts.set(place, text);
    this.storeSoon();
  }
  /// Of another file of the folder, {name, text | base64}.
  fileText(file) { return this.changed.get(file.name) ?? file.text; }
  changeFile(file, text) {
    if (text === file.text) this.changed.delete(file.name);
    else this.changed.set(file.name, text);
    this.storeSoon();
  }
  /// The folder as `dynlab new` makes it, with what was written.
  folder() {
    const others = this.others.map((file) => (file.base64 === undefined ? { name: file.name, text: this.fileText(file) } : file));
    return [{ name: this.description.file, text: this.composed.text }, ...others];
  }

  storeSoon() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.store(), kSoon);
  }
  async store() {
    clearTimeout(this.timer);
    this.timer = 0;
    if (!this.writer.writes) return;
    await storeWork(this.key, { original: this.script.original, texts: [...this.texts], files: Object.fromEntries(this.changed), older: this.older, at: Date.now() });
    this.onStored?.(kept());
  }
  get unsaved() { return this.timer !== 0; }
  get kept() { return kept(); }

  /// The key of a sentence that says why not, or "".
  takeScript(text) {
    if (text.length > kMostScript) return "tooLarge";
    const texts = this.script.textsOf(text.replace(/\r\n?/g, "\n"));
    if (!texts) return "otherScript";
    if (this.texts.size > 0) this.older = this.script.compose(this.texts).text;
    this.texts = texts;
    this.shared = null;
    this.storeSoon();
    return "";
  }
  static get mostMegabytes() { return kMostScript >> 20; }
  reset() {
    if (this.texts.size > 0) this.older = this.script.compose(this.texts).text;
    this.texts = new Map();
    this.changed = new Map();
    this.storeSoon();
  }

  async link() { return `${location.href.split("#")[0]}#script=${await packed(this.composed.text)}`; }
  /// A script that the page's address brings: true where there is one, null where it cannot be read.
  async takeLink() {
    const found = /^#script=([\w-]+)$/.exec(location.hash);
    if (!found) return false;
    const text = await unpacked(found[1], kMostScript), texts = text === null ? null : this.script.textsOf(text);
    if (!texts) return null;
    if (this.script.compose(texts).text === this.composed.text) return false;
    this.shared = texts;
    return true;
  }
  useShared(wanted) {
    const texts = this.shared;
    this.shared = null;
    history.replaceState(null, "", location.href.split("#")[0]);
    if (wanted) this.takeScript(this.script.compose(texts).text);
  }
}

/// A file into the downloads.
export function download(name, content, type = "text/plain;charset=utf-8") {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
