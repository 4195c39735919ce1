// `dynlab preview` in a real browser. Oracle: what the files say that the test writes, and what a reader sees: the
// page's own text, places and states.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "support/cut_line.h"
#include "support/preview.h"

namespace test_preview {
using namespace dynlab;
using namespace dynlab::test;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

TEST_F(preview_page, shows_text_code_output_and_figures_and_follows_the_file) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    EXPECT_TRUE(shows(browser, "Words at the beginning."));
    EXPECT_TRUE(shows(browser, "x is 20"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('figure img')?.naturalWidth > 100"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('figure .plot')?.clientWidth > 100"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('head').innerText.includes('A document')"));
    EXPECT_EQ(browser.evaluate("return location.search"), "\"\"");  // no token in the address

    std::string changed = kHead + kFirst + kPlot;
    changed.replace(changed.find("the beginning"), 13, "the start");
    write(changed);
    EXPECT_TRUE(shows(browser, "Words at the start."));
    changed.replace(changed.find("x = 20"), 6, "x = 21");
    write(changed);
    EXPECT_TRUE(shows(browser, "x is 21"));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('document').innerText.includes('x is 20')"));
}

TEST_F(preview_page, figures_can_be_read_off) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.plot')"));
    browser.evaluate(
        "const plot = document.querySelector('.plot').plot; const panel = plot.panels[0]; plot.setCursor({panel, x: "
        "panel.place(2, 4)[0], y: panel.place(2, 4)[1]})");
    EXPECT_TRUE(browser.becomes_true("/\\b2\\b(?!\\.).*\\b4\\b/s.test(document.querySelector('.reading').innerText)"));
}

TEST_F(preview_page, changes_only_what_has_changed) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('figure img')"));
    ASSERT_TRUE(browser.becomes_true(
        "document.getElementById('stop').hidden && document.querySelectorAll('[data-state=done]').length > 0"));
    browser.evaluate("for (const node of document.querySelectorAll('.piece')) node.seen = true");
    std::string changed = kHead + kFirst + kPlot;
    changed.replace(changed.find("at the end"), 10, "at an end");
    write(changed);
    ASSERT_TRUE(shows(browser, "Words at an end."));
    EXPECT_EQ(
        browser.evaluate("return [...document.querySelectorAll('.piece')].filter(n => !n.seen).map(n => n.innerText)"),
        "[\"Words at an end.\"]");
}

/// The content at the top of the window keeps its place when content above or below it grows.
TEST_F(preview_page, does_not_jump) {
    std::string many;
    for (int i = 0; i < 60; ++i)
        many += "-- Paragraph " + std::to_string(i) + " has words that fill a line or two of it.\n--\n";
    const std::string text = "-- %% [markdown]\n" + many + "\n";
    write(kHead + kFirst + text + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true(
        "document.querySelector('figure img')?.complete && document.getElementById('stop').hidden"));
    browser.evaluate(
        "window.held = [...document.querySelectorAll('.piece')].find(n => n.innerText.startsWith('Paragraph 30'));"
        "held.scrollIntoView(); window.before = held.getBoundingClientRect().top");
    std::string longer = kHead + kFirst + text + kPlot;
    longer.replace(longer.find("Words at the beginning."), 23,
                   "Words at the beginning,\n--\n-- and more,\n--\n-- and still more.");
    write(longer);
    ASSERT_TRUE(shows(browser, "and still more."));
    EXPECT_EQ(browser.evaluate("return Math.abs(held.getBoundingClientRect().top - before) < 1"), "true");
    longer.replace(longer.find("Words at the end."), 17, "Other words.");
    write(longer);
    ASSERT_TRUE(shows(browser, "Other words."));
    EXPECT_EQ(browser.evaluate("return Math.abs(held.getBoundingClientRect().top - before) < 1"), "true");
}

TEST_F(preview_page, a_failing_cell_says_why_and_keeps_what_was_below) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('figure img') && document.getElementById('stop').hidden"));
    std::string wrong = kHead + kFirst + kPlot;
    wrong.replace(wrong.find("print("), 6, "pritn(");
    write(wrong);
    EXPECT_TRUE(shows(browser, "did you mean"));
    EXPECT_TRUE(state_is(browser, "one", "failed"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('figure img')"));
    EXPECT_TRUE(browser.becomes_true(
        "document.querySelector('.older figure') && getComputedStyle(document.querySelector('.older "
        "figure')).opacity < 0.6"));
    write(kHead + kFirst + kPlot);
    EXPECT_TRUE(state_is(browser, "one", "done"));
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.older')"));
}

TEST_F(preview_page, reports_what_is_wrong_with_the_text) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    std::string wrong = kHead + kFirst + kPlot;
    wrong.replace(wrong.find("Words at the end"), 5, "See @fig:none. Words");
    write(wrong);
    EXPECT_TRUE(
        browser.becomes_true("document.getElementById('complaints').innerText.includes('@fig:none has no target')"));
    EXPECT_TRUE(shows(browser, "Words at the end"));
    write("-- ---\n-- titel: x\n-- ---\n" + kFirst);
    EXPECT_TRUE(browser.becomes_true("document.getElementById('complaints').innerText.includes('titel')"));
    EXPECT_TRUE(shows(browser, "x is 20"));  // the last good page stays
    write(kHead + kFirst);
    EXPECT_TRUE(browser.becomes_true("document.getElementById('complaints').hidden"));
}

TEST_F(preview_page, an_endless_loop_can_be_stopped_and_fixed) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    write(kHead + kFirst + "-- %% id=loop\nwhile true do end\n");
    ASSERT_TRUE(state_is(browser, "loop", "running"));
    browser.click("#stop");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('stop').hidden"));
    EXPECT_TRUE(state_is(browser, "loop", "waiting"));
    write(kHead + kFirst + "-- %% id=loop\nprint(\"over\")\n");
    EXPECT_TRUE(shows(browser, "over"));
}

/// Markup in what is printed, reported or written is text.
TEST_F(preview_page, nothing_in_a_document_runs_in_the_page) {
    write(kHead +
          "-- %% [markdown]\n-- A `<script>window.bad = 1</script>` and \\<img src=x onerror=\"window.bad = 2\"\\>.\n\n"
          "-- %% id=evil\nprint(\"<img src=x onerror='window.bad = 3'><script>window.bad = 4</script>\")\n"
          "plot({1, 2}, {1, 2}, {title = \"<script>window.bad=5</script>\"})\n");
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(state_is(browser, "evil", "done"));
    EXPECT_TRUE(shows(browser, "<script>window.bad = 4</script>"));
    EXPECT_EQ(browser.evaluate("return [window.bad === undefined, document.querySelectorAll('#document "
                               "script:not([type=\"application/json\"]), #document img[onerror]').length]"),
              "[true,0]");
}

TEST_F(preview_page, an_untrusted_document_is_shown_and_runs_only_after_consent) {
    write(kHead + kFirst + "-- %% id=mark\nsave_csv(\"mark.csv\", {a = {1}})\n");
    Preview preview(file(), false);
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "Words at the beginning."));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('question').hidden"));
    EXPECT_TRUE(browser.becomes_true("document.activeElement.id === 'question'"));
    // Who was typing when the page came has not said yes.
    browser.act(R"([{"type": "key", "id": "keys", "actions": [{"type": "keyDown", "value": " "}, )"
                R"({"type": "keyUp", "value": " "}, {"type": "keyDown", "value": "\uE007"}, )"
                R"({"type": "keyUp", "value": "\uE007"}]}])");
    // The printed document runs it, too; the refusal comes after all that the keys could have asked for.
    browser.evaluate("fetch('document.pdf').then(async r => { window.refused = r.status + await r.text() })");
    EXPECT_TRUE(browser.becomes_true("/^403.*allowed/.test(window.refused)"));
    EXPECT_EQ(browser.evaluate("return document.getElementById('question').hidden"), "false");
    EXPECT_EQ(browser.evaluate("return document.getElementById('document').innerText.includes('x is 20')"), "false");
    EXPECT_FALSE(fs::exists(file("mark.csv")));
    browser.click("#allow");
    EXPECT_TRUE(shows(browser, "x is 20"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('question').hidden"));
}

TEST_F(preview_page, tabs_come_and_go_and_the_end_is_reported) {
    write(kHead + kFirst);
    Preview preview(file());
    Browser browser(1280, 900, Browser::Kind::kWhole);  // reports to a tab that it is hidden
    for (int i = 0; i < 10; ++i) {
        if (i > 0) browser.new_tab();
        browser.open(preview.address());
        ASSERT_TRUE(shows(browser, "x is 20")) << "tab " << i;
    }
    preview.end();
    EXPECT_TRUE(browser.becomes_true("/has exited|no response/.test(document.getElementById('state').innerText)"));
    EXPECT_TRUE(shows(browser, "x is 20"));
}

TEST_F(preview_page, gives_the_pdf) {
    write(kHead + kFirst);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    browser.evaluate(
        "fetch('document.pdf').then(r => r.arrayBuffer()).then(b => { window.pdf = new "
        "TextDecoder('latin1').decode(b.slice(0, 5)) })");
    EXPECT_TRUE(browser.becomes_true("window.pdf === '%PDF-'", 60));
}

/// Light words on dark paper where the desktop is dark, in the document, the bar and the editor.
TEST_F(preview_page, is_dark_where_the_desktop_is) {
    write(kHead + kFirst);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.prefer_dark();
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.CodeMirror')"));
    const std::string brightness =
        "(node, what) => getComputedStyle(node)[what].match(/[0-9]+/g).slice(0, 3).reduce((sum, c) => sum + Number(c), "
        "0)";
    for (const char* part : {"body", "#bar", ".CodeMirror", "#document pre"})
        EXPECT_EQ(browser.evaluate("const b = " + brightness + "; const n = document.querySelector('" + part +
                                   "'); return [b(n, 'backgroundColor') < 150, b(n, 'color') > 450]"),
                  "[true,true]")
            << part;
}

TEST_F(preview_page, takes_up_a_stream_that_was_cut_and_has_lost_nothing) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    CutLine line(preview.address());
    Browser browser;
    browser.open(line.address(preview.address()));
    ASSERT_TRUE(shows(browser, "x is 20"));
    line.cut();
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').innerText.includes('no response')"));
    std::string changed = kHead + kFirst + kPlot;
    changed.replace(changed.find("x = 20"), 6, "x = 21");
    write(changed);
    EXPECT_FALSE(browser.becomes_true("document.getElementById('document').innerText.includes('x is 21')", 0.5));
    line.restore();
    EXPECT_TRUE(shows(browser, "x is 21"));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('state').innerText.includes('no response')"));
}

/// A closed laptop lid: the program is suspended, files change, and the program resumes.
TEST_F(preview_page, wakes_up_with_the_newest_document) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    ASSERT_EQ(::kill(preview.process(), SIGSTOP), 0);
    for (const char* value : {"x = 21", "x = 22"}) {
        std::string changed = kHead + kFirst + kPlot;
        changed.replace(changed.find("x = 20"), 6, value);
        write(changed);
    }
    ASSERT_EQ(::kill(preview.process(), SIGCONT), 0);
    EXPECT_TRUE(shows(browser, "x is 22"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('stop').hidden"));
}

/// A line of /proc/PID/status, "VmRSS: 1234 kB"; 0 where it is not there.
long status_of(pid_t process, const std::string& name) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name + ":")) return std::stol(line.substr(name.size() + 1));
    return 0;
}

/// A process and all that it started, those that ended left out.
std::vector<pid_t> family_of(pid_t first) {
    std::map<pid_t, pid_t> parents;
    for (const auto& entry : fs::directory_iterator("/proc"))
        if (const pid_t process = std::atoi(entry.path().filename().c_str()); process > 0)
            parents[process] = static_cast<pid_t>(status_of(process, "PPid"));
    std::vector<pid_t> family;
    for (const auto& [process, parent] : parents) {
        pid_t at = process;
        while (at != first && at > 1 && parents.contains(at)) at = parents[at];
        if (at == first && status_of(process, "VmRSS") > 0) family.push_back(process);
    }
    return family;
}

/// Resident memory of a process, in kB, and how many there are of it and what it started.
std::pair<long, std::size_t> memory_of_family(pid_t first) {
    return {status_of(first, "VmRSS"), family_of(first).size()};
}

/// Processor time of a process and of all that it started, in clock ticks.
long ticks_of_family(pid_t first) {
    long ticks = 0;
    for (const pid_t process : family_of(first)) {
        std::ifstream file("/proc/" + std::to_string(process) + "/stat");
        std::string words;
        std::getline(file, words, ')');
        long user = 0, system = 0;
        for (int i = 0; i < 11; ++i) file >> words;
        file >> user >> system;
        ticks += user + system;
    }
    return ticks;
}

TEST_F(preview_page, takes_no_processor_time_while_nothing_changes) {
    write(kHead + kFirst + kPlot);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(
        browser.becomes_true("document.getElementById('view').classList.contains('ready')", 30));  // the PDF, the last
    long before = ticks_of_family(preview.process());
    ASSERT_GT(before, 0);
    bool at_rest = false;  // a Pandoc for the next time still starts
    for (int i = 0; i < 10 && !at_rest; ++i) {
        std::this_thread::sleep_for(2s);
        at_rest = ticks_of_family(preview.process()) == before;
        before = ticks_of_family(preview.process());
    }
    EXPECT_TRUE(at_rest);
}

/// As many saves of text and code as an hour of work has: memory and processes stay what they were.
TEST_F(preview_page, does_not_grow_with_the_edits) {
    const auto save = [&](int number) {
        write(kHead + "-- %% [markdown]\n-- Save number " + std::to_string(number) + ".\n\n" + kFirst +
              "-- %% id=two\nlocal s = 0 for i = 1, 1e5 do s = s + i end\nprint(\"save\", " +
              std::to_string(number / 3) + ")\n\n" + kPlot);
    };
    save(0);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "Save number 0."));
    const auto save_up_to = [&](int first, int last) {
        for (int i = first; i <= last; ++i) {
            save(i);
            ASSERT_TRUE(shows(browser, "Save number " + std::to_string(i) + "."));
        }
        ASSERT_TRUE(browser.becomes_true("document.getElementById('stop').hidden"));
    };
    save_up_to(1, 30);
    const auto [before, processes] = memory_of_family(preview.process());
    save_up_to(31, 130);
    const auto [after, processes_after] = memory_of_family(preview.process());
    EXPECT_LT(static_cast<double>(after), 1.1 * static_cast<double>(before));
    EXPECT_LE(processes_after, processes + 2);  // a Pandoc that waits for the next time, a gnuplot
}

}  // namespace test_preview
