#include "app/page/page_routes.h"

#include <filesystem>

#include "app/page/page_files.h"
#include "base/languages.h"
#include "documents/html/script_catalogs.h"
#include "documents/html/web_page.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"

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
    server.on_get("/catalogs.js", [](const PageRequest&) {
        std::string scripts = shown_scripts(shared_folder() / "report_templates");
        for (const PageFile& file : page_files())
            if (file.name.ends_with(".js")) scripts += file.text;
        return PageReply{script_catalogs(scripts, languages()), kJavaScript};
    });
    server.on_get("/plot.js", [](const PageRequest&) {
        return PageReply{shown_scripts(shared_folder() / "report_templates"), kJavaScript};
    });
    server.on_get("/document.css", [](const PageRequest&) {
        return PageReply{read_text(shared_folder() / "report_templates/html/document.css"), "text/css; charset=utf-8"};
    });
    for (const auto& [name, file] : kEditorFiles) {
        server.on_get(name, [place = kCodeMirror / file](const PageRequest&) {
            if (!fs::exists(place)) return PageReply{"The package libjs-codemirror is not installed.", kPlainText, 404};
            return PageReply{read_file(place), type_of_page_file(place)};
        });
    }
}

}  // namespace dynlab::inline app
