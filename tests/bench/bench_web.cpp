// The course in a browser tab, as a student meets it: a site by `dynlab site` below a folder of a plain web server, the
// engine in its worker, Chromium. Rows are left out where the engine for browsers is not built (scripts/build web).
#include <fmt/format.h>
#include <httplib.h>

#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "bench/bench.h"
#include "bench/program_work.h"
#include "platform/atomic_file.h"
#include "support/browser.h"

namespace dynlab::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Browser;
using test::Workbench;

constexpr int kVisits = 5, kRuns = 3, kManyRuns = 100;
constexpr double kMegabyte = 1e6;
const std::string kReady = "document.querySelector('#lesson[data-engine]')";

/// Serves a folder and notes which files are asked for.
class FileServer {
  public:
    explicit FileServer(const fs::path& folder) {
        server_.set_mount_point("/course/", folder.string());
        server_.set_logger([this](const httplib::Request& request, const httplib::Response& response) {
            const std::lock_guard lock(mutex_);
            if (response.status == 200) asked_.insert(request.path.substr(std::string("/course/").size()));
        });
        port_ = server_.bind_to_any_port("127.0.0.1");
        thread_ = std::thread([this] { server_.listen_after_bind(); });
    }
    ~FileServer() {
        server_.stop();
        thread_.join();
    }
    std::string address(const std::string& page) const {
        return fmt::format("http://127.0.0.1:{}/course/{}", port_, page);
    }
    std::set<std::string> asked() {
        const std::lock_guard lock(mutex_);
        return asked_;
    }

  private:
    httplib::Server server_;
    std::mutex mutex_;
    std::set<std::string> asked_;
    int port_ = 0;
    std::thread thread_;
};

void wait(Browser& browser, const std::string& expression) {
    if (!browser.becomes_true(expression, 120)) throw std::runtime_error("the page never shows: " + expression);
}

/// JavaScript: waits for an expression within the page, looked at once a frame, and returns the time since the page's
/// beginning in seconds.
std::string when(const std::string& doing, const std::string& expression, const std::string& ready = kReady) {
    return "return (async () => { const frame = () => new Promise(requestAnimationFrame);"
           "while (!(" +
           ready + ")) await frame(); const begin = performance.now(); " + doing + "; while (!(" + expression +
           ")) await frame(); return [performance.now() / 1000, (performance.now() - begin) / 1000]; })()";
}

/// Seconds from the beginning of the visit, and from the click, until the first cell of lesson 2 has printed.
std::pair<double, double> seconds_until_a_cell_ran(Browser& browser, const std::string& address) {
    browser.open(address);
    const json times =
        json::parse(browser.evaluate(when("document.querySelector('[data-cell=times] .run-cell').click()",
                                          "document.querySelector('[data-cell=times]').dataset.state === 'done'",
                                          "document.querySelector('[data-cell=times] .run-cell')")));
    return {times[0], times[1]};
}

/// Replaces the page's script by the worked solution of its lesson, as a user imports a file.
void import_solution(Browser& browser, const std::string& slug) {
    const std::string solution = read_text(fs::path(DYNLAB_SOURCE_DIR) / "lessons" / slug / "lesson.lua");
    browser.evaluate("const data = new DataTransfer(); data.items.add(new File([" + json(solution).dump() +
                     "], 'analysis.lua')); const chooser = document.querySelector('.work-menu input[type=file]');"
                     "chooser.files = data.files; chooser.dispatchEvent(new Event('change'))");
    wait(browser,
         "document.querySelector('#lesson-bar:not(.running)') && document.querySelectorAll('.CodeMirror').length");
}

double run_all_seconds(Browser& browser, const std::string& address, const std::string& slug) {
    browser.open(address);
    wait(browser, kReady);
    import_solution(browser, slug);
    std::vector<double> seconds;
    for (int k = 0; k < kRuns; ++k)
        seconds.push_back(
            json::parse(browser.evaluate(when("document.querySelector('#lesson-run').click(); await frame()",
                                              "!document.querySelector('#lesson-bar.running')")))[1]);
    if (browser.evaluate("return document.querySelectorAll('.failure').length") != "0")
        throw std::runtime_error("lesson " + slug + " stops in the page: " +
                                 browser.evaluate("return document.querySelector('.failure').textContent"));
    return median(seconds);
}

/// From an edit of the last cell, behind which all others have run, to its output.
double edit_seconds(Browser& browser) {
    std::vector<double> seconds;
    for (int k = 0; k < kVisits; ++k)
        seconds.push_back(json::parse(browser.evaluate(
            when(fmt::format("const cell = [...document.querySelectorAll('[data-cell]')].filter((one) => "
                             "one.querySelector('.CodeMirror')).pop(); cell.querySelector('.CodeMirror').CodeMirror"
                             ".setValue('print(\"edit {}\")'); cell.querySelector('.run-cell').click()",
                             k),
                 fmt::format("cell.querySelector('pre.output')?.textContent === 'edit {}'", k))))[1]);
    return median(seconds);
}

/// A script that prints the seconds of `count` calls of srivc on `samples` samples, after one call that is not counted.
/// No call repeats another, so that none comes from the cache.
std::string timed_srivc(int samples, int count) {
    return fmt::format(
        "rng(1)\nlocal u = prbs(10, {0})\nu = u:range(1, {1})\n"
        "local y = lsim(tf({{2}}, {{1, 4, 3}}), u, 0.05) + 0.05*randn({1})\nlocal data = iddata(y, u, 0.05)\n"
        "local first = srivc(data, {{1, 2, 0}}, {{lambda = 3}})\ntic()\n"
        "for k = 1, {2} do srivc(data, {{1, 2, 0}}, {{lambda = 3 + 1e-4*k}}) end\nprint('{1} samples:', toc()/{2})\n",
        samples / 1000 + 1, samples, count);
}

/// "1500 samples: 0.0012": the number behind the colon.
double printed_seconds(const std::string& output) {
    return std::stod(output.substr(output.find(':') + 1));
}

double native_seconds(const Workbench& bench, const std::string& script) {
    bench.write("timed.lua", script);
    const ChildResult run = bench.dynlab({"run", "timed.lua", "--out", "timed"});
    must_succeed(run);
    return printed_seconds(run.output);
}

double seconds_in_page(Browser& browser, const std::string& script, int samples) {
    browser.evaluate("document.querySelector('[data-cell=times] .CodeMirror').CodeMirror.setValue(" +
                     json(script).dump() + ")");
    browser.click("[data-cell=times] .run-cell");
    const std::string output = "document.querySelector('[data-cell=times] pre.output')?.textContent";
    wait(browser, fmt::format("{}?.startsWith('{} samples')", output, samples));
    return printed_seconds(json::parse(browser.evaluate("return " + output)));
}

/// Bytes of the engine's memory after so many runs of lesson 2, under Node. MB.
double memory_after(const Workbench& bench, const fs::path& engine, int runs) {
    const fs::path source = DYNLAB_SOURCE_DIR;
    const ChildResult done = bench.shell(
        fmt::format("node {}/tests/web/run_in_node.mjs {}/dynlab.js {} {}/lessons/02_least_squares/lesson.lua {}",
                    source.string(), engine.string(), source.string(), source.string(), runs));
    must_succeed(done);
    return json::parse(done.output)["memory"].get<double>() / kMegabyte;
}

}  // namespace

void measure_web(Report& report) {
    const fs::path engine = fs::path(DYNLAB_SOURCE_DIR) / "build/web/engine";
    if (!fs::exists(engine / "dynlab.wasm")) {
        report.left_out.push_back("the course in a browser: the engine is not built (scripts/build web)");
        return;
    }
    const Workbench bench;
    must_succeed(bench.dynlab({"site", "site"}));
    const auto gzipped = [&](const std::string& file) {
        return std::stod(bench.shell("gzip -9 -c 'site/" + file + "' | wc -c").output) / kMegabyte;
    };
    const auto row = [&](const std::string& what, const std::string& against, double measured, double reference,
                         double goal) {
        report.results.push_back({what, against, measured, reference, 1, goal / reference});
    };

    FileServer server(bench.path("site"));
    const std::string lesson = server.address("lessons/02/");
    std::vector<double> first, second;
    for (int k = 0; k < kVisits; ++k) {
        Browser browser;
        first.push_back(seconds_until_a_cell_ran(browser, lesson).first);
        if (k == 0) {
            double total = 0, of_engine = 0;
            for (const std::string& file : server.asked()) {
                const double size = gzipped(file.empty() || file.ends_with('/') ? file + "index.html" : file);
                if (file.find("dynlab.wasm") != std::string::npos || file.find("dynlab.js") != std::string::npos)
                    of_engine += size;
                total += size;
            }
            row("first visit to lesson 2, gzipped (MB)", "2.5 MB", total, 2.5, 1.5);
            row("the engine of it (MB)", "1.5 MB", of_engine, 1.5, 1);
        }
        wait(browser, "navigator.serviceWorker.controller");
        browser.devtools("Network.enable", "{}");
        browser.devtools("Network.emulateNetworkConditions",
                         R"({"offline": true, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})");
        second.push_back(seconds_until_a_cell_ran(browser, lesson).first);
    }
    row("first visit until a cell has run (s)", "1.5 s", median(first), 1.5, 0.8);
    row("second visit, offline (s)", "0.5 s", median(second), 0.5, 0.3);

    Browser browser;
    row("Run all, lesson 2 (s)", "1 s", run_all_seconds(browser, lesson, "02_least_squares"), 1, 0.5);
    row("Run all, lesson 4 with its Monte Carlo study (s)", "6 s",
        run_all_seconds(browser, server.address("lessons/04/"), "04_estimators"), 6, 3);
    row("edit of lesson 4's last cell to its output (s)", "300 ms", edit_seconds(browser), 0.3, 0.15);

    browser.open(lesson);
    wait(browser, kReady);
    for (const auto& [samples, count] : {std::pair{1'000'000, 5}, std::pair{1'500, 300}}) {
        const std::string script = timed_srivc(samples, count);
        const double native = native_seconds(bench, script);
        report.results.push_back({fmt::format("srivc, {} samples, in the page (s)", samples), "the native program",
                                  seconds_in_page(browser, script, samples), native, 6, 3});
    }
    browser.open(server.address("workbench/"));
    wait(browser, "document.querySelector('.CodeMirror')");
    browser.evaluate("document.querySelector('.CodeMirror').CodeMirror.setValue(" + json(kDraggedSession).dump() + ")");
    measure_dragging(report, browser, " in the page");
    const double few = memory_after(bench, engine, 10);
    row("memory after 100 runs of lesson 2 (MB)", "300 MB", memory_after(bench, engine, kManyRuns), 300, 150);
    report.results.push_back({"the same", "after 10 runs", report.results.back().measured, few, 1, 0});
}

}  // namespace dynlab::bench
