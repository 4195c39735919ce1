// The workbench as a user at the browser sees it: from the start of the program to the frame that Chromium has painted,
// and the frames during a drag.
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "bench/bench.h"
#include "platform/program_lookup.h"
#include "support/browser.h"
#include "support/preview_program.h"

namespace dynlab::bench {
namespace {

namespace fs = std::filesystem;
using test::Browser;
using test::PageProgram;

constexpr int kOpenings = 5;
constexpr int kMillion = 1'000'000;
constexpr double kFrame = 1.0 / 30;  ///< s

double now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void wait(Browser& browser, const std::string& expression) {
    if (!browser.becomes_true(expression, 60)) throw std::runtime_error("the workbench never shows: " + expression);
}
const std::string kRest = "document.getElementById('state')?.textContent === 'up to date'";
const std::string kPicture = "document.querySelector('.tile[data-view=record] canvas')";

/// A noisy second-order plant that is switched at irregular times, as CSV.
void write_million(const fs::path& file) {
    std::ofstream out(file);
    out << "time (s),u,y\n";
    double x = 0, v = 0;
    unsigned noise = 1;
    for (int k = 0; k < kMillion; ++k) {
        const double u = (k / 37 + k / 59) % 2 == 0 ? 1 : -1;
        noise = noise * 1664525u + 1013904223u;
        out << fmt::format("{:.2f},{},{:.5f}\n", 0.01 * k, u, x + 0.02 * (noise / 4294967296.0 - 0.5));
        v += 0.01 * (2 * u - 3 * x - 2 * v);
        x += 0.01 * v;
    }
}

/// Of the program and of what it started: shared pages in parts. MB.
double memory(const PageProgram& program) {
    double kilobytes = 0;
    for (const pid_t process : program.processes()) {
        std::ifstream pages("/proc/" + std::to_string(process) + "/smaps_rollup");
        for (std::string word; pages >> word;) {
            double number = 0;
            if (word == "Pss:" && pages >> number) kilobytes += number;
        }
    }
    return kilobytes / 1000;
}

/// Runs `moving` in a browser for five seconds and returns the drawings per second.
double drawings(Browser& browser, const std::string& view, const std::string& setting_up, const std::string& moving) {
    return std::stod(browser.evaluate("return (async () => { const box = document.querySelector('.tile[data-view=" +
                                      view + "] .plot'); let k = 0, drawn = 0; " + setting_up +
                                      "; box.addEventListener('drawn', () => ++drawn); const timer = setInterval(() => "
                                      "{ ++k; " +
                                      moving +
                                      "; }, 16); await new Promise((yes) => setTimeout(yes, 5000)); "
                                      "clearInterval(timer); return drawn / 5; })()"));
}

void measure_native_dragging(Report& report, Browser& browser) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "drag.lua") << kDraggedSession;
    const PageProgram program({"app", "drag.lua", "--run"}, {}, folder.path());
    browser.open(program.address());
    measure_dragging(report, browser, "");
}

void measure_million(Report& report, Browser& browser) {
    const TemporaryFolder folder;
    write_million(folder.path() / "million.csv");
    std::vector<double> picture_seconds;
    for (int i = 0; i < kOpenings; ++i) {
        fs::remove(folder.path() / "million_session.lua");
        const double started = now();
        const PageProgram program({"app", "million.csv"}, {}, folder.path());
        browser.open(program.address());
        wait(browser, kPicture);
        picture_seconds.push_back(now() - started);
        double max_memory = 0;
        for (const double end = now() + 3; now() < end; std::this_thread::sleep_for(std::chrono::milliseconds(20)))
            max_memory = std::max(max_memory, memory(program));
        if (i + 1 < kOpenings) continue;
        wait(browser, kRest);
        report.results.push_back({"workbench: memory with 10^6 samples (MB)", "150 MB", memory(program), 150, 1, 0});
        report.results.push_back({"workbench: most, while advice looks at them (MB)", "150 MB", max_memory, 150, 1, 0});
        const double drawn =
            drawings(browser, "record", "const panel = box.plot.panels[0]; box.plot.zoom(panel, [0.4, 0.5], null)",
                     "box.plot.move(panel, 0.01 * Math.sin(k / 20), 0)");
        report.results.push_back(
            {"workbench: 10^6 samples panned (s a frame)", "30 frames a second", 1 / drawn, kFrame, 1, 0});
    }
    report.results.push_back(
        {"workbench: CSV of 10^6 samples to its picture (s)", "1 s", median(picture_seconds), 1, 1, 0});
}

/// The page itself, before there is anything on it.
void measure_first_page(Report& report, Browser& browser) {
    const TemporaryFolder folder;
    std::vector<double> pages;
    for (int i = 0; i < kOpenings; ++i) {
        const double started = now();
        const PageProgram program({"app"}, {}, folder.path());
        browser.open(program.address());
        pages.push_back(now() - started);
    }
    report.results.push_back({"workbench: program started, page loaded (s)", "0.3 s", median(pages), 0.3, 1, 0});
}

}  // namespace

/// The page shows the data, simulated output, residuals, step response and Bode plot beside it.
const char* const kDraggedSession =
    "-- %% id=record\nlocal u = prbs(8, 6)\nlocal y = lsim(tf({2}, {1, 4, 3}), u, 0.05)\n"
    "data = iddata(y:range(1, 1500) + 0.05*randn(1500), u:range(1, 1500), 0.05)\n\n"
    "-- %% id=parts\nestimation = data\nvalidation = data\n\n"
    "-- %% id=G1\nG1 = srivc(estimation, {1, 2, 0}, {lambda = 3})\n";

void measure_dragging(Report& report, Browser& browser, const std::string& where) {
    wait(browser, "document.querySelectorAll('.tile canvas').length >= 5");
    wait(browser, kRest);
    const double drawn =
        drawings(browser, "step",
                 "const slider = [...document.querySelectorAll('.controls label')].find((one) => "
                 "one.textContent.trim().startsWith('lambda')).querySelector('input[type=range]')",
                 "slider.value = 0.3 * Math.sin(k / 20); slider.dispatchEvent(new Event('input', {bubbles: true}))");
    const std::string views = browser.evaluate("return document.querySelectorAll('.tile canvas').length");
    report.results.push_back({fmt::format("workbench{}: lambda dragged, {} views (s a frame)", where, views),
                              "30 frames a second", 1 / drawn, kFrame, 1, 0.5});
}

void measure_workbench(Report& report) {
    if (!find_program("chromedriver")) {
        report.left_out.push_back("the workbench, in Chromium");
        return;
    }
    Browser browser(1280, 900, Browser::Kind::kWhole);  // as users have it
    measure_first_page(report, browser);
    measure_native_dragging(report, browser);
    measure_million(report, browser);
}

}  // namespace dynlab::bench
