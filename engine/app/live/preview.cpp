#include "app/live/preview.h"

#include <mutex>
#include <thread>

#include "app/live/live_document.h"
#include "app/page/page_files.h"
#include "app/server/web_server.h"
#include "documents/error.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/child_process.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/temporary_folder.h"
#include "platform/text_file.h"
#include "workflow/lesson_catalogue.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

/// How the document is read, now and after every change.
std::function<ReportRequest()> reader_of(const std::string& document) {
    if (fs::is_regular_file(document))
        return [document] { return report_of_script(read_percent_script(document), "preview.html"); };
    return [document] { return report_of(document, "preview.html", ""); };
}

/// Which folders' scripts may be run: those that somebody allowed, and the lessons.
class Permissions {
  public:
    explicit Permissions(const fs::path& script) : folder_(fs::weakly_canonical(fs::absolute(script).parent_path())) {}
    bool granted() const {
        const fs::path lessons = fs::weakly_canonical(shared_folder() / "lessons");
        const bool is_lesson =
            std::mismatch(lessons.begin(), lessons.end(), folder_.begin(), folder_.end()).first == lessons.end();
        return is_lesson || cache_.recall(name()).has_value();
    }
    void grant() const { cache_.remember(name(), "allowed"); }

  private:
    std::string name() const { return EntryName("allowed_folders", "1").add(folder_.string()).text(); }
    fs::path folder_;
    Cache cache_;
};

PageReply file_of_page(const std::string& name, const char* type) {
    for (const PageFile& file : page_files())
        if (file.name == name) return {std::string(file.text), type};
    return {"There is nothing here.", "text/plain; charset=utf-8", 404};
}

void serve_files(WebServer& server) {
    server.on_get("/", [](const PageRequest&) { return file_of_page("index.html", "text/html; charset=utf-8"); });
    server.on_get("/page.css", [](const PageRequest&) { return file_of_page("page.css", "text/css; charset=utf-8"); });
    server.on_get("/page.js",
                  [](const PageRequest&) { return file_of_page("page.js", "text/javascript; charset=utf-8"); });
    server.on_get("/document.css", [](const PageRequest&) {
        return PageReply{read_text(shared_folder() / "report_templates/html/document.css"), "text/css; charset=utf-8"};
    });
}

void serve_page(WebServer& server, LivePage& page) {
    server.on_stream([&page] { return page.whole(); });
    server.on_get("/picture/*", [&page](const PageRequest& asked) {
        const auto picture = page.picture(fs::path(asked.path).filename().string());
        if (!picture) return PageReply{"This picture is no longer shown.", "text/plain; charset=utf-8", 404};
        return PageReply{picture->second, picture->first};
    });
}

/// The document as `dynlab report` makes it, by a process of its own.
class PrintedDocument {
  public:
    explicit PrintedDocument(std::string document) : document_(std::move(document)) {}

    PageReply pdf() {
        const std::lock_guard lock(mutex_);
        const fs::path file = folder_.path() / "document.pdf";
        fs::remove(file);
        ChildOptions child;
        child.command = {fs::read_symlink("/proc/self/exe").string(),
                         fs::is_regular_file(document_) ? "weave" : "report", document_, "-o", file.string()};
        child.timeout = std::chrono::minutes(10);
        const ChildResult made = run_child(child, "dynlab");
        if (!fs::exists(file)) return {made.error_output, "text/plain; charset=utf-8", 500};
        return {read_file(file), "application/pdf"};
    }

  private:
    const std::string document_;
    TemporaryFolder folder_;
    std::mutex mutex_;
};

PageReply done() {
    return {"", "text/plain; charset=utf-8", 204};
}

}  // namespace

void preview(const PreviewOptions& options) {
    ScriptRunner runner;  // before any thread
    const std::function<ReportRequest()> read = reader_of(options.document);
    const Permissions permissions(read().script.file);
    LivePage page;
    LiveDocument document(read, runner, page);
    if (options.run_at_once) permissions.grant();
    if (permissions.granted()) document.allow_runs();

    WebServer server({.port = options.port});
    serve_files(server);
    serve_page(server, page);
    PrintedDocument printed(options.document);
    server.on_get("/document.pdf", [&printed](const PageRequest&) { return printed.pdf(); });
    server.on_post("/stop", [&](const PageRequest&) { return document.stop_run(), done(); });
    server.on_post("/anew", [&](const PageRequest&) { return document.run_anew(), done(); });
    server.on_post("/allow", [&](const PageRequest&) {
        permissions.grant();
        document.allow_runs();
        return done();
    });
    document.on_change([&] {
        if (const auto changes = page.changes()) server.send("page", *changes);
    });
    server.start();
    options.opened(server.address());
    try {
        document.work();
    } catch (...) {
        server.send("over", "{}");
        std::this_thread::sleep_for(std::chrono::milliseconds(50));  // so that tabs hear of it
        throw;
    }
}

}  // namespace dynlab::inline app
