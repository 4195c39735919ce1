// A lesson in a browser, with the engine in its worker. Oracles: the files and words of the native program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "support/browser.h"
#include "web/web_engine.h"

namespace dynlab::test {
namespace test_web_lessons {
using nlohmann::json;
namespace fs = std::filesystem;

constexpr char kReady[] = "document.querySelector('#lesson[data-engine]')";
constexpr char kIdle[] = "!document.querySelector('#lesson-bar.running')";

TestSite& site() {
    static TestSite the_one;
    return the_one;
}

std::string editor(const std::string& cell) {
    return "document.querySelector('[data-cell=\"" + cell + "\"] .CodeMirror').CodeMirror";
}

std::string text_of(Browser& browser, const std::string& selector) {
    return json::parse(browser.evaluate("return document.querySelector('" + selector + "')?.textContent ?? ''"));
}

void write_code(Browser& browser, const std::string& cell, const std::string& code) {
    browser.evaluate(editor(cell) + ".setValue(" + json(code).dump() + ")");
}

/// A lesson whose cells can run.
void open_lesson(Browser& browser, const std::string& number = "02") {
    browser.open(site().address("lessons/" + number + "/index.html"));
    ASSERT_TRUE(browser.becomes_true(kReady, 60));
}

TEST(web_lessons, run_a_cell_and_keep_what_was_written) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    write_code(browser, "times", "print(6*7)");
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-cell=times] pre.output')?.textContent === '42'"));
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    open_lesson(browser);
    EXPECT_EQ(json::parse(browser.evaluate("return " + editor("times") + ".getValue()")), "print(6*7)");
}

/// The outputs of three cells after one of them has run.
std::vector<std::string> outputs_after(Browser& browser, const std::vector<std::string>& cells,
                                       const std::string& ran) {
    browser.click("[data-cell=\"" + ran + "\"] .run-cell");
    EXPECT_TRUE(browser.becomes_true(kIdle, 60));
    std::vector<std::string> texts;
    for (const std::string& cell : cells) texts.push_back(text_of(browser, "[data-cell=\"" + cell + "\"] pre.output"));
    return texts;
}

/// Three slow cells count and draw random numbers, the first says at what time. What stands behind an edit begins as in
/// the first run, and the cells before it have not run again. Oracle: a run of the whole script.
TEST(web_lessons, run_an_edited_cell_as_the_first_time_without_those_before_it) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    const std::vector<std::string> cells = json::parse(browser.evaluate(
        "return [...document.querySelectorAll('[data-cell]')].filter((one) => one.querySelector('.CodeMirror'))"
        ".slice(0, 3).map((one) => one.dataset.cell)"));
    ASSERT_EQ(cells.size(), 3u);
    const std::string slow = "for k = 1, 4e6 do other = k end\n";
    write_code(browser, cells[0],
               "tic() " + slow +
                   "count = 1 held = zeros(5e5) print(count, rand())\n"
                   "begun = toc() print(begun)");
    write_code(browser, cells[1], slow + "count = count + 1 held[7] = count print(count, rand(), held[7])");
    write_code(browser, cells[2], slow + "count = count + 1 print(count, rand(), held[7], begun)");
    const std::vector<std::string> first = outputs_after(browser, cells, cells[2]);
    ASSERT_THAT(first, testing::Each(testing::Not("")));
    write_code(browser, cells[2], slow + "count = count + 1 held = nil print(count, rand(), count, begun) -- edited");
    std::vector<std::string> now = outputs_after(browser, cells, cells[2]);
    EXPECT_EQ(now[2].substr(0, now[2].find('\t', 2)), first[2].substr(0, first[2].find('\t', 2)));
    EXPECT_EQ(now[0], first[0]);
    write_code(browser, cells[2], slow + "error(\"on purpose\")");
    outputs_after(browser, cells, cells[2]);
    write_code(browser, cells[2], slow + "count = count + 1 print(count, rand(), held[7], begun)");
    EXPECT_EQ(outputs_after(browser, cells, cells[2]), first);
    write_code(browser, cells[1], slow + "count = count + 10 held[7] = count print(count, rand(), held[7])");
    now = outputs_after(browser, cells, cells[1]);
    EXPECT_EQ(now[0], first[0]);
    EXPECT_THAT(now[1], testing::StartsWith("11\t"));
    write_code(browser, cells[1], slow + "count = count + 1 held[7] = count print(count, rand(), held[7])");
    EXPECT_EQ(outputs_after(browser, cells, cells[2]), first);
}

TEST(web_lessons, say_an_error_at_its_line) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    write_code(browser, "times", "local x = 1\nprint(x + nothing)");
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-cell=times] .failure')"));
    EXPECT_EQ(json::parse(browser.evaluate("return " + editor("times") + ".lineInfo(1).wrapClass ?? ''")), "failed");
}

TEST(web_lessons, stop_an_endless_loop_and_go_on) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    write_code(browser, "times", "while true do end");
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-cell=times][data-state=running]')"));
    browser.click("#lesson-stop");
    EXPECT_TRUE(browser.becomes_true(kIdle, 5));
    write_code(browser, "times", "print(\"again\")");
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(
        browser.becomes_true("document.querySelector('[data-cell=times] pre.output')?.textContent === 'again'"));
}

/// Stop while the engine still loads: the worker that was ended is not begun again in place of the new one.
TEST(web_lessons, begin_one_worker_after_two_stops) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    EXPECT_EQ(
        browser.evaluate(
            "return (async () => { const { engine } = await import('../../page/engine.js'), send = engine.send;"
            "let begun = 0; engine.send = (act, what) => { begun += act === 'begin'; return send.call(engine, act, "
            "what); }; engine.end().catch(() => {}); await engine.end(); await engine.begin(); return begun; })()"),
        "1");
    write_code(browser, "times", "print(\"again\")");
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(
        browser.becomes_true("document.querySelector('[data-cell=times] pre.output')?.textContent === 'again'"));
}

TEST(web_lessons, refuse_more_memory_than_there_is_in_a_sentence) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    write_code(browser, "times", "local x = zeros(2^28)");
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-cell=times] .failure')"));
    EXPECT_THAT(text_of(browser, "[data-cell=times] .failure"), testing::HasSubstr("memory"));
}

/// The archive that the page makes of the current folder, as base64.
std::string pack_of_page(Browser& browser) {
    const std::string made = browser.evaluate(
        "return (async () => { const { session } = await import('../../page/session.js'), store = await "
        "import('../../page/work_store.js');"
        "const lesson = await (await fetch('lesson.json')).json();"
        "const texts = document.querySelector('.other-files'), files = lesson.files.filter(({ name }) => name !== "
        "lesson.file);"
        "const bytes = await session.makePack([{ name: lesson.file, text: window.script }, ...files]);"
        "let letters = ''; for (const byte of bytes) letters += String.fromCharCode(byte); return btoa(letters); })()");
    return json::parse(made);
}

TEST(web_lessons, make_the_pack_of_the_native_program_byte_for_byte) {
    SKIP_WITHOUT_WEB_ENGINE();
    const Workbench bench(Workbench::Memory::kShared);
    ASSERT_EQ(bench.dynlab({"new", "02", "work"}).exit_code, 0);
    const std::string solution = read_text(fs::path(DYNLAB_SOURCE_DIR) / "lessons/02_least_squares/lesson.lua");
    bench.write("work/analysis.lua", solution);
    ASSERT_EQ(bench.dynlab({"pack", "work", "-o", "native.zip"}).exit_code, 0);
    Browser browser;
    open_lesson(browser);
    browser.evaluate("window.script = " + json(solution).dump());
    bench.write("page.base64", pack_of_page(browser));
    ASSERT_EQ(bench.shell("base64 -d page.base64 > page.zip && cmp page.zip native.zip").exit_code, 0);
    ASSERT_EQ(bench.shell("mkdir in && cp page.zip in/group-1.zip").exit_code, 0);
    const ChildResult graded = bench.dynlab({"grade", "in", "--lesson", "02", "--out", "out", "--no-pdf"});
    EXPECT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_THAT(bench.shell("cat out/marks.csv out/*.csv").output, testing::HasSubstr("20"));
}

TEST(web_lessons, give_the_points_of_the_worked_solution) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    const std::string solution = read_text(fs::path(DYNLAB_SOURCE_DIR) / "lessons/02_least_squares/lesson.lua");
    browser.evaluate("const data = new DataTransfer(); data.items.add(new File([" + json(solution).dump() +
                     "], 'analysis.lua')); const chooser = document.querySelector('.work-menu input[type=file]');"
                     "chooser.files = data.files; chooser.dispatchEvent(new Event('change'))");
    ASSERT_TRUE(browser.becomes_true("document.querySelector('[data-name=work]')"));
    browser.click("#lesson-check");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('#lesson-panel .checks')", 120));
    EXPECT_EQ(text_of(browser, "#lesson-panel h2"), "20 of 20 points");
}

TEST(web_lessons, show_another_user_s_script_and_run_it_when_it_is_accepted_only) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    write_code(browser, "times", "print(\"theirs\")");
    const std::string link = json::parse(browser.evaluate(
        "document.querySelector('#work-link').click();"
        "return new Promise((yes) => { const look = () => { const field = document.querySelector('.link-field');"
        "if (field) yes(field.value); else setTimeout(look, 20); };"
        "navigator.clipboard.writeText = () => Promise.reject(new Error()); look(); })"));
    browser.evaluate("window.confirm = () => true; document.querySelector('#work-reset').click()");
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    browser.open("about:blank");
    browser.open(link);
    ASSERT_TRUE(browser.becomes_true(kReady, 60));
    EXPECT_EQ(json::parse(browser.evaluate("return " + editor("times") + ".getValue()")), "print(\"theirs\")");
    EXPECT_EQ(browser.evaluate("return document.querySelector('#lesson-run').disabled"), "true");
    browser.click("#keep-own");
    EXPECT_THAT(json::parse(browser.evaluate("return " + editor("times") + ".getValue()")).get<std::string>(),
                testing::HasSubstr("load"));
    EXPECT_EQ(browser.evaluate("return document.querySelector('#lesson-run').disabled"), "false");
}

TEST(web_lessons, let_one_tab_write) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    browser.evaluate("window.other = window.open(location.href)");
    EXPECT_TRUE(browser.becomes_true("window.other.document.querySelector('#lesson[data-ready]')", 60));
    EXPECT_TRUE(browser.becomes_true("window.other.document.querySelector('[data-name=tab]')"));
    EXPECT_EQ(browser.evaluate("return document.querySelector('[data-name=tab]')"), "null");
    browser.evaluate("window.other.document.querySelector('[data-name=tab] button').click()");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-name=tab]')"));
    browser.evaluate("window.other.close()");
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('[data-name=tab]')"));
}

TEST(web_lessons, work_where_the_browser_keeps_nothing_and_say_so) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    browser.devtools(
        "Page.addScriptToEvaluateOnNewDocument",
        R"({"source": "IDBFactory.prototype.open = () => { throw new DOMException('no', 'SecurityError'); }"})");
    open_lesson(browser);
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-name=kept]')"));
    write_code(browser, "times", "print(1)");
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-cell=times] pre.output')?.textContent === '1'"));
}

TEST(web_lessons, stay_readable_without_exceptions_of_webassembly) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    browser.devtools("Page.addScriptToEvaluateOnNewDocument", R"({"source": "WebAssembly.validate = () => false"})");
    browser.open(site().address("lessons/02/index.html"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('[data-name=engine]')"));
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.CodeMirror, #lesson-run').length"), "0");
    EXPECT_NE(browser.evaluate("return document.querySelectorAll('pre.code').length"), "0");
}

TEST(web_lessons, run_without_a_connection_after_the_first_visit) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    open_lesson(browser);
    ASSERT_TRUE(browser.becomes_true("navigator.serviceWorker.controller", 60));
    browser.devtools("Network.enable", "{}");
    browser.devtools("Network.emulateNetworkConditions",
                     R"({"offline": true, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0})");
    browser.open(site().address("lessons/04/"));
    ASSERT_TRUE(browser.becomes_true(kReady, 60));
    browser.open(site().address("lessons/02/"));
    ASSERT_TRUE(browser.becomes_true(kReady, 60));
    browser.click("[data-cell=times] .run-cell");
    EXPECT_TRUE(
        browser.becomes_true("document.querySelector('[data-cell=times] pre.output')?.textContent.includes('Games')"));
}

TEST(web_lessons, run_examples_of_help) {
    SKIP_WITHOUT_WEB_ENGINE();
    Browser browser;
    browser.open(site().address("functions/step.html"));
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.run-example').length === 2"));
    browser.click(".run-example");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.example-cell pre.output')?.textContent === '1'", 60));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.example-cell .plot canvas')"));
}

}  // namespace test_web_lessons
}  // namespace dynlab::test
