// Documents that follow the pen, as a reader at the browser meets them: the clock runs from the moment before a file is
// saved (a program started, a page opened) to the frame in which Chromium has painted what changed.
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "bench/bench.h"
#include "bench/program_work.h"
#include "platform/atomic_file.h"
#include "platform/program_lookup.h"
#include "support/browser.h"
#include "support/cut_line.h"
#include "support/preview_program.h"

namespace dynlab::bench {
namespace {

namespace fs = std::filesystem;
using test::Browser;
using test::CutLine;
using test::Preview;
using test::Workbench;

constexpr int kEdits = 11, kOpenings = 5;
/// Done, and everything of the lesson there.
const std::string kComplete =
    "document.getElementById('stop')?.hidden && "
    "document.querySelectorAll('.piece[data-state=done], .piece[data-state=recalled]').length > 5 && "
    "document.querySelectorAll('.piece figure').length > 5";

double now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// From now on the page notes when the expression has become true and what it speaks of is painted.
std::string watch(const std::string& expression) {
    return "window.painted = 0; window.watching?.disconnect(); const note = async () => { await Promise.all("
           "[...document.querySelectorAll('[data-cell=last] img')].map(picture => picture.decode().catch(() => 0)));"
           "requestAnimationFrame(() => setTimeout(() => { window.painted = Date.now() / 1000; }, 0)); };"
           "window.watching = new MutationObserver(() => { if (!window.painted && (" +
           expression +
           ")) { window.painted = 1; note(); } });"
           "window.watching.observe(document, {childList: true, subtree: true, attributes: true, characterData: "
           "true});";
}

double painted(Browser& browser) {
    if (!browser.becomes_true("window.painted > 1")) throw std::runtime_error("the page does not show what was saved");
    return std::stod(browser.evaluate("return window.painted"));
}

/// Saves what `edit` writes and waits for the page.
double edit_seconds(Browser& browser, const std::string& expression, const std::function<void()>& edit) {
    browser.evaluate(watch(expression));
    const double saved = now();
    edit();
    const double seconds = painted(browser) - saved;
    if (!browser.becomes_true(kComplete)) throw std::runtime_error("the page does not come to rest");
    return seconds;
}

/// Seconds from the start of the program until the page is complete, for a document whose calls are all cached.
double opening_seconds(Browser& browser, const fs::path& file, const fs::path& cache) {
    const double started = now();
    const Preview preview(file, true, {}, cache);
    browser.open(preview.address());
    return painted(browser) - started;
}

/// From opening a file until the first picture of its page.
double first_paint(Browser& browser, const fs::path& file) {
    browser.open("file://" + file.string());
    if (!browser.becomes_true("performance.getEntriesByName('first-contentful-paint').length > 0"))
        throw std::runtime_error("the page of lesson 4 is never painted");
    return std::stod(browser.evaluate("return performance.getEntriesByName('first-contentful-paint')[0].startTime")) /
           1000;
}

/// Presses a key, with Shift if so wanted, and returns the seconds from the key until a frame in which the expression
/// is true.
double key_seconds(Browser& browser, const std::string& key, bool shift, const std::string& expression) {
    browser.evaluate(
        "window.took = 0; const pressed = (event) => { if (event.key === 'Shift') return;"
        "removeEventListener('keydown', pressed, true); const look = () => { if (" +
        expression +
        ") window.took = performance.now() - event.timeStamp; else requestAnimationFrame(look); };"
        "requestAnimationFrame(look); }; addEventListener('keydown', pressed, true)");
    nlohmann::json keys = nlohmann::json::array();
    if (shift) keys.push_back({{"type", "keyDown"}, {"value", "\uE008"}});
    for (const char* type : {"keyDown", "keyUp"}) keys.push_back({{"type", type}, {"value", key}});
    if (shift) keys.push_back({{"type", "keyUp"}, {"value", "\uE008"}});
    browser.act(nlohmann::json::array({{{"type", "key"}, {"id", "keys"}, {"actions", keys}}}).dump());
    if (!browser.becomes_true("window.took > 0")) throw std::runtime_error("never true after a key: " + expression);
    return std::stod(browser.evaluate("return window.took")) / 1000;
}

/// The editor beside the page of lesson 4, in a short cell behind all others.
void measure_editor(Report& report, const fs::path& file, const fs::path& cache) {
    const Preview preview(file, true, {"--edit"}, cache);
    Browser browser(1280, 900, Browser::Kind::kWhole);
    browser.open(preview.address());
    if (!browser.becomes_true(kComplete, 60) || !browser.becomes_true("document.querySelector('.editing .CodeMirror')"))
        throw std::runtime_error("lesson 4 is never complete beside its editor");
    browser.evaluate("window.cm = document.querySelector('.CodeMirror').CodeMirror");
    const auto write_line = [&](const std::string& text) {  // instead of the last one
        browser.evaluate(
            "cm.closeHint?.(); cm.focus(); const line = cm.lastLine(); cm.replaceRange(" + nlohmann::json(text).dump() +
            ", {line, ch: 0}, {line, ch: cm.getLine(line).length}); cm.setCursor(line, cm.getLine(line).length)");
    };
    std::vector<double> lists, signatures, runs;
    for (int i = 1; i <= kEdits; ++i) {
        write_line("ls");
        lists.push_back(key_seconds(browser, "s", false, "document.querySelector('.CodeMirror-hint')"));
        write_line("srivc");
        signatures.push_back(key_seconds(browser, "(", false,
                                         "!document.getElementById('signature').hidden && document."
                                         "getElementById('signature').textContent.includes('srivc')"));
        write_line(fmt::format("print(77000 + {})", i));
        runs.push_back(key_seconds(
            browser, "\uE007", true,
            fmt::format("[...document.querySelectorAll('pre')].some(node => node.textContent.includes('{}'))",
                        77000 + i)));
    }
    report.results.push_back({"live: completion list after a key (s)", "0.05 s", median(lists), 0.050, 1, 0.4});
    report.results.push_back({"live: signature after a parenthesis (s)", "0.05 s", median(signatures), 0.050, 1, 0.4});
    report.results.push_back(
        {"live: Shift-Enter in lesson 4's last cell to its output (s)", "0.3 s", median(runs), 0.300, 1, 0.5});
}

}  // namespace

void measure_live(Report& report) {
    if (!find_program("chromedriver")) {
        report.left_out.push_back("documents that follow the pen, in Chromium");
        return;
    }
    const Workbench bench;
    fs::copy(fs::path(DYNLAB_SOURCE_DIR) / "lessons/04_estimators", bench.path("lesson"), fs::copy_options::recursive);
    const fs::path file = bench.path("lesson/lesson.lua");
    const std::string text = read_file(file);
    const std::size_t words = text.find("-- Three methods estimate");
    if (words == std::string::npos) throw std::runtime_error("lesson 4 begins with other words");
    const auto save = [&](int edit) {
        std::string edited = text;
        edited.insert(words, edit == 0 ? "" : fmt::format("-- Edit number {}.\n--\n", edit));
        std::ofstream(file) << edited << "\n-- %% id=last\nplot({1, 2, 3}, {1, 4, 9}, {title = \"The last cell\"})\n";
    };
    const auto save_last = [&](int edit) {
        std::ofstream(file) << text << "\n-- %% id=last\nplot({1, 2, 3}, {1, 4, " << 9 + edit
                            << "}, {title = \"The last cell\"})\n";
    };

    save(0);
    Browser browser(1280, 900, Browser::Kind::kWhole);  // as users have it
    {
        const Preview preview(file, true, {}, bench.path("cache"));
        browser.open(preview.address());
        if (!browser.becomes_true(kComplete, 60)) throw std::runtime_error("lesson 4 is never complete");
        std::vector<double> prose, last, kilobytes;
        for (int i = 1; i <= kEdits; ++i) {
            const std::string shown = fmt::format("document.body.textContent.includes('Edit number {}.')", i);
            prose.push_back(edit_seconds(browser, shown, [&] { save(i); }));
        }
        const CutLine line(preview.address());
        Browser distant;
        distant.open(line.address(preview.next_address()));
        if (!distant.becomes_true(kComplete, 60)) throw std::runtime_error("lesson 4 is never complete");
        for (int i = kEdits + 1; i <= 2 * kEdits; ++i) {
            const std::size_t before = line.bytes_from_server();
            save(i);
            const std::string shown = fmt::format("document.body.textContent.includes('Edit number {}.')", i);
            if (!distant.becomes_true(shown)) throw std::runtime_error("the page does not show what was saved");
            std::this_thread::sleep_for(std::chrono::milliseconds(500));
            kilobytes.push_back(static_cast<double>(line.bytes_from_server() - before) / 1000);
        }
        edit_seconds(browser, "true", [&] { save_last(0); });
        browser.evaluate("window.drawing = () => document.querySelector('[data-cell=last] figure img')?.src");
        for (int i = 1; i <= kEdits; ++i) {
            browser.evaluate("window.before = drawing()");
            const auto change = [&] { save_last(i); };
            last.push_back(edit_seconds(browser, "drawing() && drawing() !== window.before", change));
        }
        report.results.push_back({"live: an edit of prose (s)", "0.15 s", median(prose), 0.150, 1, 0.080 / 0.150});
        report.results.push_back({"live: sent for an edit of prose (kB)", "20 kB", median(kilobytes), 20, 1, 0});
        report.results.push_back(
            {"live: an edit of the last cell, a plot (s)", "0.3 s", median(last), 0.300, 1, 0.150 / 0.300});
    }
    save(0);
    {
        const Preview preview(file, true, {}, bench.path("cache"));
        browser.open(preview.address());
        if (!browser.becomes_true(kComplete, 60)) throw std::runtime_error("lesson 4 is never complete");
        std::this_thread::sleep_for(std::chrono::seconds(3));  // the page is cached meanwhile
    }
    browser.devtools("Page.addScriptToEvaluateOnNewDocument", "{\"source\": \"" + watch(kComplete) + "\"}");
    std::vector<double> openings, paints;
    for (int i = 0; i < kOpenings; ++i) openings.push_back(opening_seconds(browser, file, bench.path("cache")));
    report.results.push_back({"live: lesson 4 opened, all recalled (s)", "0.6 s", median(openings), 0.600, 1, 0});

    must_succeed(bench.dynlab({"report", "04", "-o", "alone.html"}));
    for (int i = 0; i < kOpenings; ++i) paints.push_back(first_paint(browser, bench.path("alone.html")));
    report.results.push_back({"lesson 4 as HTML, first paint (s)", "0.5 s", median(paints), 0.500, 1, 0});
    report.results.push_back({"lesson 4 as HTML, size (MB)", "3 MB",
                              static_cast<double>(fs::file_size(bench.path("alone.html"))) / 1e6, 3, 1, 0});

    std::ofstream(file) << text << "\n-- %% id=last\nprint(77000)";
    measure_editor(report, file, bench.path("cache"));
}

}  // namespace dynlab::bench
