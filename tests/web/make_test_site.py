"""Makes a small site with lessons to run in a browser: python3 make_test_site.py DYNLAB SOURCE ENGINE FOLDER LESSON...

Text cells stand in it as plain paragraphs, without Pandoc and without a run: what the pages do with their cells is tested, not how
`dynlab site` sets them. Everything else has the form that `dynlab site` gives it.
"""
import hashlib
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CODE_MIRROR = pathlib.Path("/usr/share/javascript/codemirror")
EDITOR = {"codemirror.js": "codemirror.js", "codemirror.css": "codemirror.css", "codemirror-lua.js": "mode/lua/lua.js",
          "codemirror-markdown.js": "mode/markdown/markdown.js", "codemirror-searchcursor.js": "addon/search/searchcursor.js",
          "codemirror-search.js": "addon/search/search.js", "codemirror-dialog.js": "addon/dialog/dialog.js",
          "codemirror-dialog.css": "addon/dialog/dialog.css", "codemirror-continue.js": "addon/comment/continuecomment.js",
          "codemirror-comment.js": "addon/comment/comment.js", "codemirror-brackets.js": "addon/edit/matchbrackets.js",
          "codemirror-hint.js": "addon/hint/show-hint.js", "codemirror-hint.css": "addon/hint/show-hint.css",
          "codemirror-fold.js": "addon/fold/foldcode.js", "codemirror-gutter.js": "addon/fold/foldgutter.js"}
SHOWN = ["words", "plot_drawing", "motion", "plot_copies", "plot_table", "plot", "choices"]
POLICY = ("default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; connect-src 'self'; worker-src 'self'; manifest-src 'self'; "
          "img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; base-uri 'self'; form-action 'none'")


def cells_of(script):
    """(marker, number of the first line behind it, lines) of each cell."""
    cells = []
    for number, line in enumerate(script.split("\n"), 1):
        if re.match(r"\s*--\s*%%", line):
            cells.append((line, number + 1, []))
        elif cells:
            cells[-1][2].append(line)
    return cells


def text_of(lines):
    markdown = "\n".join(re.sub(r"^-- ?", "", line) for line in lines)
    paragraphs = []
    for block in re.split(r"\n\s*\n", markdown):
        block = html.escape(block.strip())
        figure = re.match(r"!\[(.*)\]\(figure:([\w.-]+)\)", block, re.S)
        if figure:
            paragraphs.append(f'<figure><img alt="" src="data:,"><figcaption>{figure[1]}</figcaption></figure>')
        elif block:
            block = re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", block)
            block = re.sub(r"`([\w.]+)`\{\.value\}", r'<span class="value" data-name="\1">?</span>', block)
            paragraphs.append(f"<p>{block}</p>")
    return "\n".join(paragraphs)


def body_of(script):
    parts = []
    for number, (marker, first, lines) in enumerate(cells_of(script), 1):
        place = f'data-first="{first}" data-last="{first + len(lines) - 1}"'
        if "[markdown]" in marker:
            parts.append(f'<div class="text" {place}>\n{text_of(lines)}</div>')
            continue
        name = re.search(r"id=([\w.-]+)", marker)
        hidden = " hidden" if "echo=false" in marker else ""
        parts.append(f'<section class="cell" data-cell="{name[1] if name else f"cell-{number}"}" {place}>\n'
                     f'<pre class="code"{hidden}>{html.escape(chr(10).join(lines))}</pre>\n<div class="results"></div>\n</section>')
    return "\n".join(parts)


def page_of(title, root, body, module):
    scripts = "".join(f'<script src="{root}page/{name}.js"></script>\n' for name in ["catalogs", "plot", "begin"])
    return (f'<!DOCTYPE html>\n<html lang="en" data-root="{root}" data-offline>\n<head>\n<meta charset="utf-8">\n'
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f'<title>{title}</title>\n<link rel="icon" href="data:,">\n<link rel="stylesheet" href="{root}page/document.css">\n'
            f'<link rel="stylesheet" href="{root}page/{module}.css">\n</head>\n<body class="site">\n{body}\n{scripts}'
            f'<script src="{root}page/{module}.js" type="module"></script>\n</body>\n</html>\n')


def lesson_description(copy, lesson, source, place):
    files = []
    for file in sorted(copy.rglob("*")):
        name = file.relative_to(copy)
        if file.is_file() and not any(part.startswith(".") for part in name.parts) and not (copy / name.parts[0]).is_symlink():
            try:
                files.append({"name": str(name), "text": file.read_bytes().decode()})
            except UnicodeDecodeError:
                shutil.copy(file, place)
                files.append({"name": str(name), "path": str(name)})
    checks = {name: (source / "lessons" / lesson / name).read_text() for name in ["checks.lua", "hints.md"]
              if (source / "lessons" / lesson / name).exists()}
    return {"lesson": lesson, "file": "analysis.lua", "language": "en", "title": lesson, "files": files, "data": [], "checks": checks}


def main(program, source, engine, folder, *lessons):
    source, site = pathlib.Path(source), pathlib.Path(folder)
    shutil.rmtree(site, ignore_errors=True)
    page = site / "page"
    page.mkdir(parents=True)
    for pages in [source / "engine/app/page", source / "engine/app/workbench", source / "engine/web/page"]:
        for file in pages.iterdir():
            if file.suffix in (".js", ".css", ".lua"):
                shutil.copy(file, page)
    (site / "workbench").mkdir()
    workbench = (source / "engine/app/workbench/workbench.html").read_text()
    base = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n<base href="../page/">\n'
    (site / "workbench/index.html").write_text(workbench.replace("<head>\n", "<head>\n" + base))
    (page / "sw.js").rename(site / "sw.js")
    for name, file in EDITOR.items():
        if (CODE_MIRROR / file).exists():
            shutil.copy(CODE_MIRROR / file, page / name)
    shown = source / "report_templates/html"
    (page / "plot.js").write_text("".join((shown / f"{name}.js").read_text() for name in SHOWN))
    (page / "catalogs.js").write_text("const dynlabCatalogs = {};\n")
    (page / "begin.js").write_text("navigator.serviceWorker?.register(document.documentElement.dataset.root + 'sw.js').catch(() => {});\n")
    shutil.copy(shown / "document.css", page)
    shutil.copytree(engine, site / "engine", ignore=lambda _, names: [name for name in names if name.startswith("CMake")])
    index = {}
    for data in sorted((source / "data").iterdir()):
        if not (data / "SOURCE.md").exists():
            continue
        shutil.copytree(data, site / "data" / data.name)
        index[data.name] = [{"file": file.name, "bytes": file.stat().st_size} for file in sorted(data.iterdir())]
    (site / "data/index.json").write_text(json.dumps(index))
    for lesson in lessons:
        with tempfile.TemporaryDirectory() as work:
            copy = pathlib.Path(work) / "copy"
            subprocess.run([program, "new", lesson, copy], check=True, stdout=subprocess.DEVNULL)
            script = (copy / "analysis.lua").read_text()
            slug = re.search(r"^-- lesson: (\S+)", script, re.M)[1]
            place = site / "lessons" / slug.split("_")[0]
            place.mkdir(parents=True)
            body = f'<main id="lesson" data-root="../../" data-lesson="{slug}" data-file="analysis.lua" data-language="en">\n{body_of(script)}\n</main>'
            (place / "index.html").write_text(page_of(slug, "../../", body, "lesson_page"))
            (place / "lesson.json").write_text(json.dumps(lesson_description(copy, slug, source, place)))
    (site / "functions").mkdir()
    example = ('<main><h1>step</h1><pre class="example" data-run>G = tf({1}, {1, 1})\nprint(dcgain(G))\nstep(G)</pre>\n'
               '<pre class="example" data-run>error("not here")</pre></main>')
    (site / "functions/step.html").write_text(page_of("step", "../", example, "help_page"))
    (site / "index.html").write_text(page_of("Site", "", "<main><h1>Site</h1></main>", "help_page"))
    (site / "manifest.webmanifest").write_text(json.dumps({"name": "dynlab", "start_url": "index.html", "scope": "./", "display": "standalone"}))
    write_list(site)


def write_list(site):
    """files.json, as the service worker reads it."""
    files, whole = [], hashlib.sha256()
    for file in sorted(site.rglob("*")):
        path = file.relative_to(site).as_posix()
        if file.is_file() and path not in ("sw.js", "files.json"):
            digest = hashlib.sha256(file.read_bytes()).hexdigest()
            whole.update(f"{path}\n{digest}\n".encode())
            files.append({"path": path, "bytes": file.stat().st_size, "sha256": digest[:16]})
    (site / "files.json").write_text(json.dumps({"version": whole.hexdigest()[:16], "files": files}))


if __name__ == "__main__":
    main(*sys.argv[1:])
