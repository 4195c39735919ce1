#include "app/workbench/workbench_page.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <re2/re2.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "app/live/background_work.h"
#include "app/live/permissions.h"
#include "app/page/page_routes.h"
#include "app/server/web_server.h"
#include "app/workbench/data_choice.h"
#include "app/workbench/workbench_session.h"
#include "data_io/dataset_index.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/memory.h"
#include "platform/spelling.h"
#include "platform/system_call.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"
#include "workflow/given_script.h"
#include "workflow/lesson_catalog.h"
#include "workflow/recording.h"

namespace dynlab::inline app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kJson = "application/json";
constexpr std::size_t kLargestUpload = std::size_t{256} << 20;

/// The subject of a session: its script, and for a new session the data set.
struct Subject {
    fs::path script;
    std::string data, title;
};

/// The first data set that a lesson loads.
std::string data_of_lesson(const Lesson& lesson) {
    static const RE2 kLoad(R"(\bload\("([^"]+)\"\))", RE2::Latin1);
    std::string data_set;
    if (!RE2::PartialMatch(read_text(lesson.script()), kLoad, &data_set))
        throw EnvironmentError("lesson {} does not load a data set; give a data file or a data set", lesson.slug);
    return data_set;
}

fs::path session_of(const std::string& name) {
    return fs::path(name).stem().string() + "_session.lua";
}

Lesson lesson_called(const std::string& words, const std::vector<std::string>& data_sets) {
    try {
        return find_lesson(words);
    } catch (const EnvironmentError&) {
        const auto near = nearest_word(words, data_sets);
        if (!near) throw;
        throw EnvironmentError("unknown data set or lesson '{}'; did you mean '{}'?", words, *near);
    }
}

Subject subject_of(const std::string& words) {
    expect_plain_name(words);
    if (words.empty()) return {"session.lua", "", "Session"};
    if (words.ends_with(".lua")) {
        if (!fs::exists(words)) throw EnvironmentError(no_such_work(words));
        return {words, "", ""};
    }
    if (is_data_file(words) && !fs::exists(words)) throw EnvironmentError("file not found: {}", words);
    const std::vector<std::string> sets = dataset_names();
    const bool is_data = fs::exists(words) || std::find(sets.begin(), sets.end(), words) != sets.end();
    if (is_data) return {session_of(words), words, "Identification from " + fs::path(words).filename().string()};
    const Lesson lesson = lesson_called(words, sets);
    const std::string data_set = data_of_lesson(lesson);
    return {session_of(lesson.slug), data_set, "Identification from " + fs::path(data_set).stem().string()};
}

/// A data set that the page has to ask about, and why; whether the session is new.
struct Opening {
    std::string data, words;
    bool fresh = false;
};
DYNLAB_DESCRIBE(Opening, data, words, fresh)

/// The script that a session begins with, where there is none yet.
std::string first_script(const Subject& subject, Opening& opening) {
    std::string lines;
    if (!subject.data.empty()) {
        const DataChoice choice = describe_data(subject.data, false);
        try {
            lines = loading_lines_for_page(suggested_order(choice));
        } catch (const EnvironmentError& error) {
            opening = {subject.data, error.what(), true};
        }
    }
    return new_session(subject.title, lines, "en");
}

PageReply done() {
    return {"", kPlainText, 204};
}

void take_script_orders(WebServer& server, WorkbenchSession& bench) {
    server.on_post("/script", [&](const PageRequest& asked) {
        constexpr int kConflict = 409;
        const auto revision = bench.change(from_json<ScriptOrder>(asked.body));
        return revision
                   ? PageReply{std::to_string(*revision), kJson}
                   : PageReply{bench.translated(Message("The script has changed in the meantime. Reload the page.")),
                               kPlainText, kConflict};
    });
    server.on_post("/look", [&](const PageRequest& asked) {
        return PageReply{std::to_string(bench.look(from_json<ViewOrder>(asked.body))), kJson};
    });
    server.on_post("/undo", [&](const PageRequest&) { return bench.undo(), done(); });
    server.on_post("/redo", [&](const PageRequest&) { return bench.redo(), done(); });
    server.on_post("/again", [&](const PageRequest&) { return bench.again(), done(); });
    server.on_post("/stop", [&](const PageRequest&) { return bench.stop(), done(); });
}

/// Whether the file did not exist before: the empty file now reserves the name against all other programs.
bool is_created(const fs::path& file) {
    constexpr mode_t kForAll = 0666;
    const FileDescriptor made(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kForAll));
    if (!made && errno != EEXIST) throw EnvironmentError("{} was not written: {}", file.string(), system_reason(errno));
    return static_cast<bool>(made);
}

/// The name under which a file that was dropped on the page is kept: no folder, no file of that name before.
fs::path free_name(const std::string& requested) {
    const fs::path name = name_of_data_file(requested);
    fs::path file = name;
    for (int k = 2; !is_created(file); ++k)
        file = fmt::format("{}-{}{}", name.stem().string(), k, name.extension().string());
    return file;
}

/// Data sets that a page may inspect before the script contains them, because the user can read them anyway: data sets,
/// files in the folder, and the session's subject.
const std::string& checked_data(const std::string& data, const std::string& subject) {
    const std::vector<std::string> sets = dataset_names();
    const fs::path within = fs::weakly_canonical(data).lexically_relative(fs::current_path());
    const bool leads_out = within.empty() || *within.begin() == "..";
    if (data == subject || std::find(sets.begin(), sets.end(), data) != sets.end() || !leads_out) return data;
    throw EnvironmentError("{} is outside the session folder; drop the file on the page to copy it into the folder",
                           data);
}

void serve_data(WebServer& server, WorkbenchSession& bench, const std::string& subject) {
    server.on_get("/datasets", [](const PageRequest&) {
        nlohmann::json list = dataset_names();
        for (const auto& entry : fs::directory_iterator(".", fs::directory_options::skip_permission_denied))
            if (is_data_file(entry.path())) list.push_back(entry.path().filename().string());
        return PageReply{list.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), kJson};
    });
    server.on_get("/columns", [&](const PageRequest& asked) {
        return PageReply{json_of(describe_data(checked_data(asked.parameter("data"), subject))), kJson};
    });
    server.on_post("/upload", [](const PageRequest& asked) {
        const fs::path file = free_name(asked.parameter("name"));
        write_file_atomically(file, asked.body);
        return PageReply{json_of(describe_data(file.string())), kJson};
    });
    server.on_post("/record", [&](const PageRequest& asked) {
        const DataSelection order = from_json<DataSelection>(asked.body);
        checked_data(order.data, subject);
        const std::string lines = loading_lines_for_page(order);
        bench.put([&](const std::string& script) { return with_data(script, order, lines); });
        return done();
    });
}

/// Help pages as the terminal shows them.
void serve_help(WebServer& server, const WorkbenchSession& bench) {
    server.on_get("/help", [&](const PageRequest& asked) {
        const auto page = find_help_page(asked.parameter("name"));
        constexpr int kMissing = 404;
        if (!page) return PageReply{bench.translated(Message("No help page has this name.")), kPlainText, kMissing};
        return PageReply{page_text(*page, find_function(std::string(page->name))), kPlainText};
    });
}

/// Replies that wait for the work must come while the server still is.
struct StopsBeforeServer {
    BackgroundWork& work;
    ~StopsBeforeServer() { work.stop(); }
};

void serve_documents(WebServer& server, WorkbenchSession& bench, BackgroundWork& background,
                     const Permissions& permissions) {
    server.on_get("/document.pdf", [&](const PageRequest&) {
        constexpr int kFailed = 500, kForbidden = 403, kConflict = 409;
        if (!permissions.granted())
            return PageReply{
                bench.translated(Message("This script is not allowed to run yet. Press \"Run it\" on the page.")),
                kPlainText, kForbidden};
        if (const auto mistake = bench.mistake())
            return PageReply{
                bench.translated(Message("A report cannot be created from a script with an error: {}", *mistake)),
                kPlainText, kConflict};
        background.document_changed({});
        const BackgroundWork::Pdf pdf = background.pdf();
        return pdf.bytes.empty() ? PageReply{bench.translated(pdf.error), kPlainText, kFailed}
                                 : PageReply{pdf.bytes, "application/pdf"};
    });
    server.on_get("/saved/*", [&](const PageRequest& asked) {
        return PageReply{bench.saved(fs::path(asked.path).filename().string()), "application/octet-stream"};
    });
    server.on_get("/script.lua", [&](const PageRequest&) { return PageReply{bench.script(), kPlainText}; });
}

}  // namespace

void serve_workbench(const WorkbenchOptions& options) {
    ScriptRunner runner(
        {.prelude = workbench_prelude(), .draws_figures = false, .keeps_end = false});  // before any thread
    Subject subject = subject_of(options.subject);
    if (const fs::path folder = subject.script.parent_path(); !folder.empty()) {
        fs::current_path(folder);
        subject.script = subject.script.filename();
    }
    const bool fresh = !fs::exists(subject.script);
    Opening opening{.data = "", .words = "", .fresh = fresh};
    if (fresh) write_file_atomically(subject.script, first_script(subject, opening));
    return_freed_memory();  // of the data file
    WorkbenchSession bench(subject.script, runner);
    Permissions permissions(subject.script);
    if (fresh) permissions.grant_script(bench.script());
    if (options.run_at_once) permissions.grant();
    bench.on_saving([&](const std::string& text) { permissions.grant_script(text); });
    if (permissions.granted()) bench.allow_runs();

    BackgroundWork background(subject.script.string());
    WebServer server({.port = options.port,
                      .largest_body = kLargestUpload,
                      .translated = [&bench](const Message& message) { return bench.translated(message); }});
    const StopsBeforeServer stops{background};
    serve_page_files(server, "workbench.html");
    take_script_orders(server, bench);
    serve_data(server, bench, subject.data);
    serve_help(server, bench);
    serve_documents(server, bench, background, permissions);
    server.on_post("/allow", [&](const PageRequest&) {
        permissions.grant_script(bench.script());
        return bench.allow_runs(), done();
    });
    server.on_get("/opening", [&](const PageRequest&) { return PageReply{json_of(opening), kJson}; });
    background.start([] {});
    server.on_stream([&] { return bench.whole(); });
    bench.on_change([&] {
        if (const auto changes = bench.changes()) server.send("page", *changes);
    });
    const fs::path script = fs::absolute(subject.script);
    server.on_late_visit([&] { options.opened(server.address(), Visit::kLate, script); });
    server.start();
    options.opened(server.address(), Visit::kFirst, script);
    try {
        bench.work();
    } catch (...) {
        server.send("over", "{}");
        std::this_thread::sleep_for(std::chrono::milliseconds(50));  // so that tabs hear of it
        throw;
    }
}

}  // namespace dynlab::inline app
