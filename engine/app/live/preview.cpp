#include "app/live/preview.h"

#include <fstream>
#include <mutex>
#include <thread>

#include "app/live/background_work.h"
#include "app/live/editor_routes.h"
#include "app/live/live_document.h"
#include "app/live/page_notes.h"
#include "app/live/permissions.h"
#include "app/live/source_files.h"
#include "app/page/page_routes.h"
#include "app/server/web_server.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/error.h"
#include "platform/hash.h"
#include "platform/locks/file_lock.h"
#include "workflow/authoring/made_folders.h"
#include "workflow/given_script.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

/// How the document is read, now and after every change.
std::function<ReportRequest()> reader_of(const std::string& document) {
    const bool names_file = document.ends_with(".lua") || document.find('/') != std::string::npos;
    if (names_file && !fs::exists(document)) throw EnvironmentError(no_such_work(document));
    if (fs::exists(document) && !fs::is_directory(document))
        return [document] { return report_of_script(read_percent_script(document), "preview.html"); };
    return [document] { return report_of(document, "preview.html", ""); };
}

void serve_page(WebServer& server, LivePage& page) {
    server.on_get("/picture/*", [&page](const PageRequest& asked) {
        const auto picture = page.picture(fs::path(asked.path).filename().string());
        if (!picture) return PageReply{page.translated(Message("This picture is no longer shown.")), kPlainText, 404};
        return PageReply{picture->second, picture->first};
    });
}

/// What a page says when sliders were moved.
struct SliderOrder {
    std::map<std::string, double> values;  ///< by their names
};
DYNLAB_DESCRIBE(SliderOrder, values)

PageReply done() {
    return {"", kPlainText, 204};
}

void take_orders(WebServer& server, LiveDocument& document, Permissions& permissions) {
    server.on_post("/stop", [&](const PageRequest&) { return document.stop_run(), done(); });
    server.on_post("/run-all", [&](const PageRequest&) { return document.run_again_from_start(), done(); });
    server.on_post("/slider", [&](const PageRequest& asked) {
        document.set_sliders(from_json<SliderOrder>(asked.body).values);
        return done();
    });
    server.on_post("/allow", [&](const PageRequest&) {
        permissions.grant();
        document.allow_runs();
        return done();
    });
}

/// The files that an editing page may read and write: the script, a template that belongs to the document, and the file
/// with the authors of the submission.
SourceFiles sources_of(const ReportRequest& request) {
    std::vector<fs::path> files = {request.script.file};
    if (fs::weakly_canonical(request.template_file.parent_path()) ==
        fs::weakly_canonical(request.script.file.parent_path()))
        files.push_back(request.template_file);
    if (const fs::path group = request.script.file.parent_path() / "group.toml"; fs::exists(group))
        files.push_back(group);
    return SourceFiles(files);
}

/// How something that was asked for went.
struct MadeReply {
    bool done = false;
    std::string words;
};
DYNLAB_DESCRIBE(MadeReply, done, words)

PageReply not_allowed(const LivePage& page) {
    constexpr int kForbidden = 403;
    return {page.translated(Message("This document is not allowed to run yet. Press \"Run it\" on the page.")),
            kPlainText, kForbidden};
}

/// Serves the PDF made in the background, and creates the files for submission on request.
void serve_work(WebServer& server, BackgroundWork& background, const Permissions& permissions, const LivePage& page) {
    server.on_get("/document.pdf", [&](const PageRequest&) {
        if (!permissions.granted()) return not_allowed(page);
        const BackgroundWork::Pdf pdf = background.pdf();
        return pdf.bytes.empty() ? PageReply{page.translated(pdf.error), kPlainText, 500}
                                 : PageReply{pdf.bytes, "application/pdf"};
    });
    if (!background.can_submit()) return;
    const auto makes = [&](BackgroundWork::Made (BackgroundWork::*make)()) {
        return [&, make](const PageRequest&) {
            if (!permissions.granted()) return not_allowed(page);
            const auto [done, words] = (background.*make)();
            return PageReply{json_of(MadeReply{done, page.translated(words)}), "application/json"};
        };
    };
    server.on_post("/report", makes(&BackgroundWork::make_report));
    server.on_post("/pack", makes(&BackgroundWork::make_pack));
}

void serve_sources(WebServer& server, SourceFiles& sources, LivePage& page) {
    constexpr const char* kJson = "application/json";
    server.on_get("/sources", [&](const PageRequest&) { return PageReply{json_of(sources.read()), kJson}; });
    server.on_post("/save", [&, kJson](const PageRequest& asked) {
        constexpr int kConflict = 409;
        const SourceFiles::Outcome outcome = sources.save(from_json<SourceText>(asked.body));
        page.set_sources(sources.digests());
        return PageReply{json_of(outcome.now), kJson, outcome.written ? 200 : kConflict};
    });
}

void serve_notes(WebServer& server, PageNotes& notes) {
    server.on_get("/notes", [&](const PageRequest&) { return PageReply{json_of(notes.read()), "application/json"}; });
    server.on_post("/notes", [&](const PageRequest& asked) {
        notes.put(from_json<PageNote>(asked.body));
        return PageReply{"", kPlainText};
    });
}

/// The only preview of a document: a second one that starts learns of the first.
class OnlyPreview {
  public:
    explicit OnlyPreview(const std::string& document) : file_(file_for(document)), lock_(file_) {}
    /// Of the one that is there; nothing when this is it.
    std::optional<std::string> other() const {
        if (lock_.held()) return {};
        const auto key = EntranceKey::of_text(read_text(file_));
        return key ? std::optional(key->address()) : std::nullopt;
    }
    void store_key(const EntranceKey& key) const {
        std::ofstream(file_, std::ios::trunc)
            << key.text() << std::flush;  // not another file in its place: the lock is on this
    }
    void forget() const { fs::resize_file(file_, 0); }

  private:
    static fs::path file_for(const std::string& document) {
        const fs::path folder = Cache().root() / "previews";
        fs::create_directories(folder);
        return folder / digest_of(fs::weakly_canonical(fs::absolute(document)).string()).hex();
    }
    fs::path file_;
    FileLock lock_;
};

/// Replies that wait for the work must arrive while the server still exists, and the work's messages need the server.
struct StopsBeforeServer {
    BackgroundWork& work;
    ~StopsBeforeServer() { work.stop(); }
};

}  // namespace

void preview(const PreviewOptions& options) {
    ScriptRunner runner;  // before any thread
    const std::function<ReportRequest()> read = reader_of(options.document);
    const ReportRequest request = read();
    const OnlyPreview only(request.script.file.string());
    if (const auto address = only.other()) return options.opened(*address, Visit::kElsewhere);
    Permissions permissions(request.script.file);
    LivePage page;
    LiveDocument document(read, runner, page);
    if (options.run_at_once) permissions.grant();
    if (permissions.granted()) document.allow_runs();

    SourceFiles sources = options.edit ? sources_of(request) : SourceFiles({});
    PageNotes notes(request.script.file);
    BackgroundWork background(options.document);
    std::mutex sending;  // news come from two threads, and the later must not go first
    std::function<void()> send_changes, look_for_readers;
    WebServer server(
        {.port = options.port, .translated = [&page](const Message& message) { return page.translated(message); }});
    const StopsBeforeServer stops{background};
    send_changes = [&] {
        const std::lock_guard lock(sending);
        if (const auto changes = page.changes()) server.send("page", *changes);
    };
    look_for_readers = [&] { background.want(server.streams() > 0 && permissions.granted() && page.settled()); };
    serve_page_files(server, "index.html");
    serve_page(server, page);
    take_orders(server, document, permissions);
    serve_sources(server, sources, page);
    if (options.edit) serve_editor(server, runner, document, page, sources);
    serve_notes(server, notes);
    page.set_sources(sources.digests());

    background.start([&] {
        page.set_work(background.findings(), background.pdf_is_ready(), background.checking());
        send_changes();
    });
    serve_work(server, background, permissions, page);
    page.set_can_submit(background.can_submit());
    page.set_made_here(was_made_here(request.script.file.parent_path()));
    server.on_stream([&] { return look_for_readers(), page.whole(); });
    document.on_reading([&](const std::map<std::string, double>& slider_values) {
        background.document_changed(slider_values);
        page.set_work(background.findings(), false);
        page.set_sources(sources.digests());
    });
    document.on_change([&] {
        look_for_readers();
        send_changes();
    });
    server.on_late_visit([&] { options.opened(server.address(), Visit::kLate); });
    server.start();
    only.store_key(server.key());
    options.opened(server.address(), Visit::kFirst);
    try {
        document.work();
    } catch (...) {
        only.forget();
        server.send("over", "{}");
        std::this_thread::sleep_for(std::chrono::milliseconds(50));  // so that tabs hear of it
        throw;
    }
}

}  // namespace dynlab::inline app
