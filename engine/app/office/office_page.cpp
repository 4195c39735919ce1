#include "app/office/office_page.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "app/office/office_commands.h"
#include "app/office/office_views.h"
#include "app/page/page_routes.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/interrupt.h"

namespace dynlab::inline app {

DYNLAB_DESCRIBE(OfficeResult, line, code, words)

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr const char* kOfficeJson = "application/json";
constexpr std::size_t kMaxUpload = std::size_t{64} << 20;
constexpr auto kLookAtStore = 150ms;

/// What the page asks to be done.
struct OfficeOrder {
    std::vector<std::string> command;
    std::string language;
};
DYNLAB_DESCRIBE(OfficeOrder, command, language)

struct OfficeNews {
    std::int64_t news = 0;
};
DYNLAB_DESCRIBE(OfficeNews, news)

std::string parameter_or(const PageRequest& asked, const std::string& name) {
    const auto found = asked.parameters.find(name);
    return found == asked.parameters.end() ? "" : found->second;
}

/// A file that commands of the page read or write.
fs::path exchanged_file(const fs::path& course, const std::string& name) {
    if (name.empty() || name.starts_with('.') || fs::path(name).filename() != name)
        throw EnvironmentError(
            "a file name on this page must not be empty, start with a period or contain a folder, but \"{}\" was given",
            name);
    return course / kExchangeFolder / name;
}

void serve_views(WebServer& server, OfficeViews& views) {
    const auto on_view = [&server](const char* path, std::function<std::string(const PageRequest&)> view) {
        server.on_get(path, [view](const PageRequest& asked) { return PageReply{view(asked), kOfficeJson}; });
    };
    on_view("/course", [&](const PageRequest&) { return views.course(); });
    on_view("/today", [&](const PageRequest& asked) { return views.today(parameter_or(asked, "language")); });
    on_view("/student", [&](const PageRequest& asked) {
        return views.student(asked.parameter("name"), parameter_or(asked, "language"));
    });
    on_view("/reviews", [&](const PageRequest& asked) { return views.reviews(parameter_or(asked, "assignment")); });
    on_view("/marks", [&](const PageRequest&) { return views.marks(); });
    on_view("/marking", [&](const PageRequest& asked) {
        return views.marking(parameter_or(asked, "assignment"), parameter_or(asked, "question"),
                             parameter_or(asked, "check"), parameter_or(asked, "language"));
    });
    on_view("/entry", [&](const PageRequest& asked) {
        return views.entry(asked.parameter("assignment"), asked.parameter("name"), asked.parameter("check"));
    });
    server.on_get("/answer", [&](const PageRequest& asked) {
        return PageReply{
            views.answer(asked.parameter("assignment"), asked.parameter("question"), asked.parameter("name")),
            kPlainText};
    });
}

/// Files that go to platforms and come from them.
void serve_exchange(WebServer& server, const fs::path& course) {
    server.on_get("/exports/*", [course](const PageRequest& asked) {
        const fs::path file = exchanged_file(course, fs::path(asked.path).filename());
        if (!fs::exists(file)) throw EnvironmentError("the file {} does not exist", file.filename().string());
        return PageReply{read_file(file), "application/octet-stream"};
    });
    server.on_post("/upload", [course](const PageRequest& asked) {
        const fs::path file = exchanged_file(course, asked.parameter("name"));
        fs::create_directories(file.parent_path());
        write_file_atomically(file, asked.body);
        return PageReply{"", kPlainText, 204};
    });
}

}  // namespace

void serve_office(const OfficeOptions& options) {
    std::atomic<std::int64_t> answers_read = 0;
    OfficeViews views(options.course, [&] { ++answers_read; });
    const fs::path folder = views.folder();
    WebServer server({.port = options.port, .largest_body = kMaxUpload});
    serve_page_files(server, "office.html");
    serve_views(server, views);
    serve_exchange(server, folder);
    std::mutex running;  // one command at a time, in the order in which they came
    server.on_post("/command", [&](const PageRequest& asked) {
        constexpr int kRefused = 400;
        const OfficeOrder order = from_json<OfficeOrder>(asked.body);
        try {
            const OfficeCommand command = office_command(order.command);
            const std::lock_guard lock(running);
            fs::create_directories(folder / kExchangeFolder);
            return PageReply{json_of(run_office_command(command, folder, order.language)), kOfficeJson};
        } catch (const EnvironmentError& error) {
            return PageReply{error.what(), kPlainText, kRefused};
        }
    });
    std::int64_t news = 0;
    std::mutex telling;
    server.on_stream([&] {
        const std::lock_guard lock(telling);
        return json_of(OfficeNews{news});
    });
    server.on_late_visit([&] { options.opened(server.address(), Visit::kLate); });
    server.start();
    options.opened(server.address(), Visit::kFirst);
    std::int64_t seen = views.revision(), read = 0;
    try {
        for (;; std::this_thread::sleep_for(kLookAtStore)) {
            throw_if_interrupted();
            const std::int64_t revision = views.revision(), answers = answers_read;
            if (revision == seen && answers == read) continue;
            seen = revision, read = answers;
            std::string text;
            {
                const std::lock_guard lock(telling);
                text = json_of(OfficeNews{++news});
            }
            server.send("page", text);
        }
    } catch (...) {
        server.send("over", "{}");
        std::this_thread::sleep_for(50ms);  // so that tabs hear of it
        throw;
    }
}

}  // namespace dynlab::inline app
