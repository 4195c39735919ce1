// CodeMirror, from beside this file, where it is installed.
const kFiles = ["codemirror-lua.js", "codemirror-markdown.js", "codemirror-searchcursor.js", "codemirror-dialog.js", "codemirror-dialog.css",
  "codemirror-search.js", "codemirror-continue.js", "codemirror-comment.js", "codemirror-brackets.js", "codemirror-hint.js",
  "codemirror-hint.css", "codemirror-fold.js", "codemirror-gutter.js"];

function loaded(file) {
  return new Promise((yes, no) => {
    const css = file.endsWith(".css"), address = new URL(file, import.meta.url).href;
    const node = document.createElement(css ? "link" : "script");
    if (css) Object.assign(node, { rel: "stylesheet", href: address });
    else Object.assign(node, { src: address, async: false });
    node.onload = yes;
    node.onerror = no;
    document.head.append(node);
  });
}

/// Whether it is there as window.CodeMirror, with what our editors use of it.
export async function loadCodeMirror() {
  try {
    await Promise.all(["codemirror.css", "codemirror.js"].map(loaded));
    await Promise.all(kFiles.map(loaded));
    return true;
  } catch {
    window.CodeMirror = undefined;
    return false;
  }
}
