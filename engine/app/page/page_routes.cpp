#include "app/page/page_routes.h"

#include <filesystem>
#include <span>

#include "app/page/page_files.h"
#include "base/languages.h"
#include "documents/html/script_catalogs.h"
#include "documents/html/web_page.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "workflow/site/site_page.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

const fs::path kCodeMirror = "/usr/share/javascript/codemirror";
constexpr const char* kJavaScript = "text/javascript; charset=utf-8";

std::string type_of_page_file(const fs::path& name) {
    if (name.extension() == ".css") return "text/css; charset=utf-8";
    if (name.extension() == ".js") return kJavaScript;
    return "text/html; charset=utf-8";
}

/// The editor's files as Debian's libjs-codemirror puts them, by the names that the page asks for.
constexpr std::pair<const char*, const char*> kEditorFiles[] = {
    {"/codemirror.js", "codemirror.js"},
    {"/codemirror.css", "codemirror.css"},
    {"/codemirror-lua.js", "mode/lua/lua.js"},
    {"/codemirror-markdown.js", "mode/markdown/markdown.js"},
    {"/codemirror-searchcursor.js", "addon/search/searchcursor.js"},
    {"/codemirror-search.js", "addon/search/search.js"},
    {"/codemirror-dialog.js", "addon/dialog/dialog.js"},
    {"/codemirror-dialog.css", "addon/dialog/dialog.css"},
    {"/codemirror-continue.js", "addon/comment/continuecomment.js"},
    {"/codemirror-comment.js", "addon/comment/comment.js"},
    {"/codemirror-brackets.js", "addon/edit/matchbrackets.js"},
    {"/codemirror-hint.js", "addon/hint/show-hint.js"},
    {"/codemirror-hint.css", "addon/hint/show-hint.css"},
    {"/codemirror-fold.js", "addon/fold/foldcode.js"},
    {"/codemirror-gutter.js", "addon/fold/foldgutter.js"}};

std::string scripts_in(std::span<const PageFile> files) {
    std::string scripts;
    for (const PageFile& file : files)
        if (file.name.ends_with(".js")) scripts += file.text;
    return scripts;
}

/// What the scripts of our pages say in each language.
std::string catalogs_of_pages(const std::string& further = {}) {
    return script_catalogs(shown_scripts(shared_folder() / "report_templates") + scripts_in(page_files()) + further,
                           languages());
}

std::string style_of_documents() {
    return read_text(shared_folder() / "report_templates/html/document.css");
}

/// The workbench's page for the folder workbench/, with the files of page/.
std::string workbench_of_site(std::string html) {
    const std::string head = "<head>\n";
    html.insert(html.find(head) + head.size(), std::string(kSitePolicy) +
                                                   "<base href=\"../page/\">\n"
                                                   "<script src=\"engine_start.js\" type=\"module\" async></script>\n");
    return html;
}

}  // namespace

bool has_editor() {
    return fs::exists(kCodeMirror / "codemirror.js");
}

void serve_page_files(WebServer& server, const std::string& first) {
    for (const PageFile& file : page_files()) {
        if (file.name.ends_with(".lua")) continue;
        const PageReply reply{std::string(file.text), type_of_page_file(file.name)};
        server.on_get("/" + std::string(file.name == first ? "" : file.name),
                      [reply](const PageRequest&) { return reply; });
    }
    server.on_get("/catalogs.js", [](const PageRequest&) { return PageReply{catalogs_of_pages(), kJavaScript}; });
    server.on_get("/plot.js", [](const PageRequest&) {
        return PageReply{shown_scripts(shared_folder() / "report_templates"), kJavaScript};
    });
    server.on_get("/document.css", [](const PageRequest&) {
        return PageReply{style_of_documents(), "text/css; charset=utf-8"};
    });
    for (const auto& [name, file] : kEditorFiles) {
        server.on_get(name, [place = kCodeMirror / file](const PageRequest&) {
            if (!fs::exists(place)) return PageReply{"The package libjs-codemirror is not installed.", kPlainText, 404};
            return PageReply{read_file(place), type_of_page_file(place)};
        });
    }
}

std::map<std::string, std::string> page_files_of_site() {
    const fs::path shared = shared_folder() / "report_templates", html = shared / "html";
    std::map<std::string, std::string> files;
    for (const std::span<const PageFile> some : {page_files(), web_page_files()})
        for (const PageFile& file : some) {
            const std::string name(file.name), text(file.text);
            if (name == "sw.js")
                files[name] = text;
            else if (name == "workbench.html")
                files["workbench/index.html"] = workbench_of_site(text);
            else if (!name.ends_with(".html"))
                files["page/" + name] = text;
        }
    for (const auto& [name, file] : kEditorFiles)
        if (fs::exists(kCodeMirror / file)) files[std::string("page") + name] = read_file(kCodeMirror / file);
    const std::string document = read_file(html / "sliders.js") + read_file(html / "document.js");
    files["page/document.js"] = document;
    files["page/site.js"] = read_file(html / "site.js");
    files["page/document.css"] = style_of_documents();
    files["page/plot.js"] = shown_scripts(shared);
    files["page/catalogs.js"] = catalogs_of_pages(scripts_in(web_page_files()) + document + files["page/site.js"]);
    return files;
}

}  // namespace dynlab::inline app
