// Help pages in a dialog, formatted: headings, paragraphs, lists, tables and code. Their text is never markup of this page.
import { request } from "./bench_session.js";
import { say } from "./bench_words.js";

const node = (tag, ...children) => { const made = document.createElement(tag); made.append(...children); return made; };

/// `code`, **bold** and [words](address) of a line; the address of a link is left out.
export function inline(text) {
  return text.split(/(`[^`]+`|\*\*[^*]+\*\*|\[[^\]]+\]\([^)]+\))/).filter(Boolean).map((piece) => {
    if (piece.startsWith("`")) return node("code", piece.slice(1, -1));
    if (piece.startsWith("**")) return node("b", ...inline(piece.slice(2, -2)));
    const link = /^\[([^\]]+)\]\([^)]+\)$/.exec(piece);
    return link ? node("span", ...inline(link[1])) : piece;
  });
}

const cells = (line) => line.trim().replace(/^\||\|$/g, "").split(/(?<!\\)\|/).map((text) => text.trim().replace(/\\\|/g, "|"));
function tableOf(lines) {
  const [head, ...rows] = lines.filter((line) => !/^[|\s:-]+$/.test(line)).map(cells);
  const row = (texts, tag) => node("tr", ...texts.map((text) => node(tag, ...inline(text))));
  return node("table", node("thead", row(head, "th")), node("tbody", ...rows.map((texts) => row(texts, "td"))));
}

/// Elements for the text of a help page.
export function formatted(text) {
  const lines = text.split("\n"), made = [];
  const isPlain = (line) => line.trim() !== "" && !/^(#|```|\||- )/.test(line);
  const run = (i, holds) => { let end = i; while (end < lines.length && holds(lines[end])) ++end; return end; };
  for (let i = 0; i < lines.length;) {
    const line = lines[i], heading = /^(#+) (.*)$/.exec(line);
    if (line.trim() === "") { ++i; continue; }
    if (heading) { made.push(node(heading[1].length < 3 ? "h3" : "h4", ...inline(heading[2]))); ++i; continue; }
    if (line.startsWith("```")) {
      const end = run(i + 1, (one) => !one.startsWith("```"));
      made.push(node("pre", node("code", lines.slice(i + 1, end).join("\n"))));
      i = end + 1;
    } else if (line.startsWith("|")) {
      const end = run(i, (one) => one.startsWith("|"));
      made.push(tableOf(lines.slice(i, end)));
      i = end;
    } else if (line.startsWith("- ")) {
      const list = node("ul");
      while (i < lines.length && lines[i].startsWith("- ")) {
        const end = run(i + 1, isPlain);
        list.append(node("li", ...inline(lines.slice(i, end).join(" ").slice(2).replace(/\s+/g, " "))));
        i = end;
      }
      made.push(list);
    } else {
      const end = Math.max(i + 1, run(i, isPlain));
      made.push(node("p", ...inline(lines.slice(i, end).join(" "))));
      i = end;
    }
  }
  return made;
}

/// What a page begins with, and the rest of it behind a link.
function shortened(text) {
  const at = text.indexOf("\n## "), [begin, rest] = at < 0 ? [text, ""] : [text.slice(0, at), text.slice(at)];
  const all = formatted(begin), shown = all.slice(0, Math.max(1, all.findIndex((one) => one.tagName === "P" && !one.textContent.includes("->")) + 1));
  const more = [...all.slice(shown.length), ...formatted(rest)];
  return more.length > 0 ? [...shown, node("details", node("summary", say("wholePage")), ...more)] : shown;
}

/// The help page of a function.
export async function help(name) {
  const answer = await request(`help?name=${encodeURIComponent(name)}`);
  document.getElementById("help-title").textContent = say("help", name);
  document.getElementById("help-text").replaceChildren(...shortened((await answer.text()).replace(/^# .*\n+/, "")));
  const dialog = document.getElementById("page-of-help");
  dialog.showModal();
  document.getElementById("help-text").scrollTop = 0;
}
