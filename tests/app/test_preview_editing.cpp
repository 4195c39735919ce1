// What a reader does on the page of `dynlab preview`: moves sliders, edits, reads what is found and the PDF. Oracle:
// the files afterwards, and what the page says.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "platform/atomic_file.h"
#include "support/page_client.h"
#include "support/preview.h"

namespace test_preview_editing {
using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
namespace fs = std::filesystem;
using namespace std::chrono_literals;

class preview_editing : public preview_page {
  protected:
    std::string text_of(const std::string& name = "analysis.lua") const { return read_text(file(name)); }
    /// Appends text to the content of the editor.
    static void type(Browser& browser, const std::string& text) {
        browser.evaluate("const m = document.querySelector('.CodeMirror').CodeMirror; m.setValue(m.getValue() + `" +
                         text + "`)");
    }
    static bool editor_has(Browser& browser, const std::string& text) {
        return browser.becomes_true("document.querySelector('.CodeMirror')?.CodeMirror.getValue().includes(`" + text +
                                    "`)");
    }
};

const std::string kSlider =
    "-- %% id=before\nlocal s = 0 for i = 1, 1e6 do s = s + i end\nlocal once = rand()\n\n"
    "-- %% id=choose\nlocal k = slider(\"k\", 3, 1, 10, {step = 0.5, unit = \"V\", label = \"gain\"})\n\n"
    "-- %% id=shown\nprint(\"k is \" .. k .. \", once \" .. once)\n";

const std::string kMoveTo8 =
    "const s = document.getElementById('slider-k'); s.value = 14; s.dispatchEvent(new Event('input'))";

/// Moving a slider takes the later long calls that do not depend on it from the cache. Oracle: the call cache.
TEST_F(preview_editing, a_slider_leaves_long_calls_that_do_not_depend_on_it) {
    write(
        kHead +
        "-- %% id=one\nlocal x = slider(\"x\", 3, 1, 5)\n\n-- %% id=long\nlocal M = montecarlo{system = tf({2}, "
        "{1, 4, 3}), input = prbs(7, 20), Ts = 0.01, sigma = 0.2, runs = 6000, estimators = {{\"srivc\", {1, 2, 0}}}}\n"
        "print(\"last \" .. x)\n");
    const fs::path cache = folder.path() / "cache";
    const auto kept = [&] {
        std::ptrdiff_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(cache))
            count += entry.is_regular_file() && entry.path().parent_path().filename() == "calls";
        return count;
    };
    const Preview preview(file(), true, {}, cache);
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "last 3"));
    ASSERT_EQ(kept(), 1);
    browser.evaluate(
        "const s = document.querySelector('input[type=range]'); s.value = 40; s.dispatchEvent(new Event('input', "
        "{bubbles: true})); s.dispatchEvent(new Event('change', {bubbles: true}))");
    ASSERT_TRUE(browser.becomes_true("/last 1[.]/.test(document.getElementById('document').innerText)"));
    EXPECT_EQ(kept(), 1);
}

TEST_F(preview_editing, a_slider_runs_what_follows_it) {
    write(kHead + kSlider);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "k is 3"));
    const std::string once =
        browser.evaluate("return /once (.*)/.exec(document.getElementById('document').innerText)[1]");
    EXPECT_EQ(browser.evaluate("return document.querySelector('.slider').innerText.replace(/\\s+/g, ' ').trim()"),
              "\"gain 3 V\"");
    browser.evaluate(kMoveTo8);
    EXPECT_TRUE(shows(browser, "k is 8"));
    EXPECT_EQ(browser.evaluate("return /once (.*)/.exec(document.getElementById('document').innerText)[1]"), once);
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.slider output').innerText.startsWith('8')"));
    // The place behind its cell, and the choice, outlast a change of the text above.
    std::string changed = kHead + "-- %% [markdown]\n-- More words.\n\n" + kSlider;
    write(changed);
    EXPECT_TRUE(shows(browser, "More words."));
    EXPECT_TRUE(shows(browser, "k is 8"));
    EXPECT_EQ(browser.evaluate("return document.querySelector('.slider').previousElementSibling.dataset.cell"),
              "\"choose\"");
    browser.click(".slider button");
    EXPECT_TRUE(shows(browser, "k is 3"));
    write(kHead + kFirst);
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.slider')"));
}

const std::string kHandle =
    "-- %% id=choose\nlocal T = slider(\"T\", 2, 1, 9, {step = 1})\nlocal K = slider(\"K\", 1, 0.5, 4, {step = "
    "0.5})\n\n"
    "-- %% id=shown\nprint(\"T \" .. T .. \" K \" .. K)\n"
    "plot({0, 10}, {K, K}, {x_range = {0, 10}, y_range = {0, 5}}):handle{x = function(T) return T end, x_slider = "
    "\"T\", y = function(K) return K end, y_slider = \"K\", text = \"end\"}\n";

/// A drag of a handle continues while runs replace the figure below the pointer.
TEST_F(preview_editing, a_handle_moves_its_sliders_while_it_is_held) {
    write(kHead + kHandle);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "T 2 K 1"));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.handle')"));
    const auto drag = [&](double T, double K) {
        const nlohmann::json place = nlohmann::json::parse(browser.evaluate(
            "const plot = document.querySelector('div.plot').plot, panel = plot.panels[0], box = "
            "plot.box.getBoundingClientRect(), at = ([x, y]) => [box.left + x * plot.unit, box.top + (plot.size[1] - "
            "y) * "
            "plot.unit]; const [mark] = panel.handles; return [at(panel.place(mark.x, mark.y)), at(panel.place(" +
            std::to_string(T) + ", " + std::to_string(K) + "))]"));
        nlohmann::json actions = nlohmann::json::array();
        const auto move = [&](double part, int duration) {
            const auto between = [&](int i) {
                const double from = place[0][i], to = place[1][i];
                return static_cast<int>(std::lround(from + part * (to - from)));
            };
            actions.push_back({{"type", "pointerMove"}, {"duration", duration}, {"x", between(0)}, {"y", between(1)}});
        };
        move(0, 0);
        actions.push_back({{"type", "pointerDown"}, {"button", 0}});
        for (int i = 1; i <= 10; ++i) move(0.1 * i, 60);
        actions.push_back({{"type", "pointerUp"}, {"button", 0}});
        browser.act(nlohmann::json::array({{{"type", "pointer"}, {"id", "mouse"}, {"actions", actions}}}).dump());
    };
    drag(7, 3);
    EXPECT_TRUE(shows(browser, "T 7 K 3"));
    const std::string place = browser.evaluate("return document.getElementById('slider-T').value");
    EXPECT_EQ(place, "\"6\"");
    EXPECT_TRUE(
        browser.becomes_true("Math.abs(document.querySelector('div.plot').plot.panels[0].handles[0].y - 3) < 0.1"));
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.held').length"), "0");
    drag(1, 0.5);
    EXPECT_TRUE(shows(browser, "T 1 K 0.5"));
}

/// The last place of a slider that is dragged counts, however many there were.
TEST_F(preview_editing, a_dragged_slider_ends_where_it_was_left) {
    write(kHead + kSlider);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "k is 3"));
    browser.evaluate(
        "const s = document.getElementById('slider-k');"
        "for (let i = 0; i <= 60; ++i) setTimeout(() => { s.value = i % 19; s.dispatchEvent(new Event('input')); "
        "window.moves = i }, 10 * i)");
    ASSERT_TRUE(browser.becomes_true("window.moves === 60"));
    EXPECT_TRUE(shows(browser, "k is 2.5"));  // 60 % 19 = 3 steps of 0.5 above 1
}

TEST_F(preview_editing, what_is_saved_on_the_page_is_the_file_and_the_page_follows) {
    write(kHead + kFirst);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(editor_has(browser, "local x = 20"));
    type(browser, "\\n-- %% [markdown]\\n-- Typed: é and λ.\\n");
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('save').disabled"));
    EXPECT_THAT(text_of(), testing::Not(HasSubstr("Typed")));
    browser.click("#save");
    EXPECT_TRUE(shows(browser, "Typed: é and λ."));
    EXPECT_THAT(text_of(), HasSubstr("Typed: é and λ."));
    EXPECT_TRUE(
        browser.becomes_true("document.getElementById('save').disabled && document.getElementById('conflict').hidden"));
}

/// Neither text is lost when the file changes on disk while the page has another.
TEST_F(preview_editing, an_edit_on_both_sides_shows_both) {
    write(kHead + kFirst);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(editor_has(browser, "local x = 20"));
    type(browser, "\\n-- mine\\n");
    write(kHead + kFirst + "-- theirs\n");
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('conflict').hidden"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('theirs').innerText.includes('theirs')"));
    EXPECT_TRUE(editor_has(browser, "-- mine"));
    EXPECT_THAT(text_of(), HasSubstr("-- theirs"));
    browser.click("#keep-mine");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('conflict').hidden"));
    for (int i = 0; i < 200 && text_of().find("-- mine") == std::string::npos; ++i) std::this_thread::sleep_for(20ms);
    EXPECT_THAT(text_of(), HasSubstr("-- mine"));

    type(browser, "\\n-- mine again\\n");
    write(kHead + kFirst + "-- theirs again\n");
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('conflict').hidden"));
    browser.click("#take-theirs");
    EXPECT_TRUE(editor_has(browser, "-- theirs again"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('save').disabled"));
    // What is the same between two changes is not shown as another.
    std::string far;
    for (int i = 1; i <= 20; ++i) far += "-- line " + std::to_string(i) + "\n";
    write(kHead + kFirst + far);
    ASSERT_TRUE(editor_has(browser, "-- line 20"));
    type(browser, "\n-- mine\n");
    far.replace(far.find("line 2\n"), 6, "another");
    far.replace(far.find("line 18"), 7, "yet another");
    write(kHead + kFirst + far);
    ASSERT_TRUE(browser.becomes_true("document.getElementById('theirs').innerText.includes('yet another')"));
    const std::string theirs = browser.evaluate("return document.getElementById('theirs').innerText");
    EXPECT_THAT(theirs, testing::ContainsRegex("› [0-9]+  -- another"));
    EXPECT_THAT(theirs, testing::ContainsRegex("› [0-9]+  -- yet another"));
    EXPECT_THAT(theirs, HasSubstr("-- line 17"));
    EXPECT_THAT(theirs, testing::Not(HasSubstr("line 10")));
    browser.click("#take-theirs");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('save').disabled"));
    // A file that changes while nothing was typed is just shown.
    write(kHead + kFirst + "-- new\n");
    EXPECT_TRUE(editor_has(browser, "-- new"));
    EXPECT_EQ(browser.evaluate("return document.getElementById('conflict').hidden"), "true");
}

/// A disk that rejects writes (here: the folder is missing) loses no text: the page reports the error and keeps the
/// text.
TEST_F(preview_editing, what_cannot_be_saved_stays_on_the_page) {
    fs::create_directory(folder.path() / "work");
    write(kHead + kFirst, "work/analysis.lua");
    const Preview preview(file("work/analysis.lua"), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(editor_has(browser, "local x = 20"));
    type(browser, "\\n-- typed\\n");
    fs::rename(folder.path() / "work", folder.path() / "away");
    browser.click("#save");
    EXPECT_TRUE(browser.becomes_true("document.body.innerText.includes('not saved')"));
    EXPECT_TRUE(editor_has(browser, "-- typed"));
    fs::rename(folder.path() / "away", folder.path() / "work");
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('save').disabled"));
    browser.click("#save");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('save').disabled"));
    EXPECT_THAT(text_of("work/analysis.lua"), HasSubstr("-- typed"));
}

/// A save that was made from an older text than the file has now is refused even when the page has not heard of it.
TEST_F(preview_editing, a_late_save_writes_nothing) {
    write(kHead + kFirst);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(editor_has(browser, "local x = 20"));
    const auto saves = [&](const std::string& json) {
        browser.evaluate(
            "window.reply = null; fetch('save', {method: 'POST', headers: {'X-Dynlab': '1'}, body: JSON.stringify(" +
            json + ")}).then(async r => { window.reply = r.status + ' ' + await r.text() })");
        browser.becomes_true("window.reply");
        return browser.evaluate("return window.reply");
    };
    EXPECT_THAT(saves("{number: 0, name: 'x', text: 'bad', digest: 'old'}"), HasSubstr("409"));
    EXPECT_THAT(saves("{number: 7, name: 'x', text: 'bad', digest: ''}"),
                HasSubstr("the document has no file with the number 7"));
    EXPECT_THAT(saves("{number: -1, name: '../../x', text: 'bad', digest: ''}"), HasSubstr("500"));
    EXPECT_THAT(saves("{text: 'bad'}"), HasSubstr("500"));
    EXPECT_EQ(text_of(), kHead + kFirst);
}

/// Line ends of other systems are the file's own, and no change.
TEST_F(preview_editing, line_ends_stay_as_they_are) {
    write("-- %% id=one\r\nlocal x = 20\r\nprint(\"x is \" .. x)\r\n");
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(editor_has(browser, "local x = 20"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('save').disabled"));
    write("-- %% id=one\r\nlocal x = 21\r\nprint(\"x is \" .. x)\r\n");
    EXPECT_TRUE(editor_has(browser, "local x = 21"));
    EXPECT_EQ(browser.evaluate("return document.getElementById('conflict').hidden"), "true");
    type(browser, "print(\\\"more\\\")\\n");
    browser.click("#save");
    EXPECT_TRUE(shows(browser, "more"));
    EXPECT_THAT(text_of(), testing::EndsWith(" .. x)\r\nprint(\"more\")\r\n"));
}

/// Saves in quick succession run in order. No save mistakes an earlier save for a change by another program.
TEST_F(preview_editing, saves_do_not_meet_each_other) {
    write(kHead + kFirst);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(editor_has(browser, "local x = 20"));
    for (int i = 0; i < 20; ++i) {
        type(browser, "-- line " + std::to_string(i) + "\\n");
        browser.evaluate("document.getElementById('save').click(); document.getElementById('save').click()");
    }
    EXPECT_TRUE(browser.becomes_true("document.getElementById('save').disabled"));
    EXPECT_EQ(browser.evaluate("return document.getElementById('conflict').hidden"), "true");
    EXPECT_THAT(text_of(), testing::EndsWith("-- line 19\n"));
}

/// A choice that the script no longer allows becomes the nearest allowed one. A choice for a removed slider is removed.
TEST_F(preview_editing, choices_follow_the_script) {
    write(kHead + kSlider);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "k is 3"));
    browser.evaluate(kMoveTo8);
    ASSERT_TRUE(shows(browser, "k is 8"));
    std::string other = kHead + kSlider;
    other.replace(other.find("3, 1, 10"), 8, "50, 40, 60");
    write(other);
    EXPECT_TRUE(shows(browser, "k is 40"));
    other.replace(other.find("\"k\", 50, 40, 60"), 15, "\"q\", 50, 40, 60");
    write(other);
    EXPECT_TRUE(shows(browser, "k is 50"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('view').classList.contains('ready')", 60));
    browser.evaluate("fetch('document.pdf').then(r => { window.pdf = r.status })");
    EXPECT_TRUE(browser.becomes_true("window.pdf === 200", 60));
}

TEST_F(preview_editing, nothing_is_written_without_the_option) {
    write(kHead + kFirst);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    browser.evaluate(
        "fetch('save', {method: 'POST', headers: {'X-Dynlab': '1'}, body: JSON.stringify({number: 0, name: 'x', text: "
        "'bad', digest: ''})})"
        ".then(r => { window.reply = r.status })");
    EXPECT_TRUE(browser.becomes_true("window.reply === 500"));
    EXPECT_EQ(browser.evaluate("return document.body.classList.contains('editing')"), "false");
    EXPECT_EQ(text_of(), kHead + kFirst);
}

TEST_F(preview_editing, source_and_page_lead_to_each_other) {
    std::string many;
    for (int i = 0; i < 60; ++i) many += "-- Paragraph " + std::to_string(i) + ".\n--\n";
    write(kHead + "-- %% [markdown]\n" + many + "\n" + kFirst);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "x is 20"));
    ASSERT_TRUE(editor_has(browser, "local x = 20"));
    browser.evaluate(
        "const m = document.querySelector('.CodeMirror').CodeMirror; m.focus();"
        "m.setCursor(m.getValue().split('\\n').findIndex(line => line.includes('Paragraph 55')), 0)");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.chosen')?.innerText === 'Paragraph 55.'"));
    EXPECT_TRUE(
        browser.becomes_true("document.querySelector('.chosen').getBoundingClientRect().bottom <= innerHeight"));
    browser.evaluate(
        "[...document.querySelectorAll('.piece')].find(n => n.innerText === 'Paragraph "
        "3.').querySelector('p').click()");
    EXPECT_TRUE(
        browser.becomes_true("(m => m.getLine(m.getCursor().line).includes('Paragraph "
                             "3.'))(document.querySelector('.CodeMirror').CodeMirror)"));
}

TEST_F(preview_editing, findings_open_answers_and_the_pdf_come_by_themselves) {
    write("-- ---\n-- template: lab_report\n-- answers:\n--   gain: number\n-- ---\n\n" + kFirst);
    write("---\ntitle: My report\n---\n\n# Introduction\n\n<!-- What is it about? -->\n\n# Results\n\nSee.\n",
          "report.md");
    const Preview preview(folder.path());
    Browser browser;
    browser.open(preview.address());
    EXPECT_TRUE(
        browser.becomes_true("document.getElementById('show-findings').innerText.includes('1 answer missing')"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('view').classList.contains('ready')", 120));
    EXPECT_TRUE(
        browser.becomes_true("/rules? violated/.test(document.getElementById('show-findings').innerText)", 120));
    browser.click("#show-findings");
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('#findings li.rule').length > 0"));
    browser.click("#view");
    EXPECT_TRUE(browser.becomes_true(
        "document.querySelector('#page\\\\:pdf iframe') && document.getElementById('document').hidden"));
    browser.click("#view");
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('document').hidden"));
    // What is changed is created again.
    write(kFirst);
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('view').classList.contains('ready')"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('view').classList.contains('ready')", 120));
}

TEST_F(preview_editing, a_second_preview_leads_to_the_first) {
    write(kHead + kFirst);
    const Preview first(file());
    ASSERT_FALSE(first.address().empty());
    const fs::path reported = folder.path() / "told";
    const auto second = [&] {
        return std::system(("XDG_CACHE_HOME='" + first.out.path().string() + "' '" + DYNLAB_PROGRAM + "' preview '" +
                            file().string() + "' --no-browser > '" + reported.string() + "'")
                               .c_str());
    };
    EXPECT_EQ(second(), 0);
    const std::string words = read_text(reported), address = words.substr(0, words.find('\n'));
    EXPECT_EQ(words, address + "\n(the document is already open)\n");
    EXPECT_NE(address, first.address()) << "an address works once";
    EXPECT_EQ(PageClient(address).host(), PageClient(first.address()).host());
}

}  // namespace test_preview_editing
