// The workbench page loses no action of the user: quick clicks, typing between them, other clients of the same script.
// Oracle: the script on disk, which must contain every action.
#include <gmock/gmock.h>

#include "support/program.h"
#include "support/workbench.h"

namespace test_workbench_hands {
using namespace dynlab;
using namespace dynlab::test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// In a page: a button by its words, the editor, and an edit as another tab orders it.
const std::string kPageHelpers = R"(
const named = (words) => [...document.querySelectorAll('button')].find((one) => one.textContent.trim() === words && one.offsetParent);
const mirror = document.querySelector('.CodeMirror').CodeMirror, plain = window.fetch;
const atEnd = (text) => mirror.replaceRange(text, { line: mirror.lineCount(), ch: 0 });
const pause = (ms) => new Promise((yes) => setTimeout(yes, ms));
const order = (revision, first, last, text) => plain('script', { method: 'POST', headers: { 'X-Dynlab': '1' },
  body: JSON.stringify({ revision, edits: [{ first, last, text }], whole: false, text: '', goes_on: false, unsaved: false }) });
)";

class workbench_hands : public workbench_page {
  protected:
    void SetUp() override {
        write_data_set();
        program = app("plant.csv");
        browser.open(program->address());
        ASSERT_TRUE(view_appears(browser, "record"));
        ASSERT_TRUE(browser.becomes_true("document.querySelector('.CodeMirror')"));
        ASSERT_TRUE(is_ready(browser));
    }
    std::string evaluate(const std::string& script) {
        return browser.evaluate("return (async () => {" + kPageHelpers + script + "})()");
    }
    /// Undoes one step.
    void undo() {
        const std::string before = script();
        ASSERT_TRUE(press(browser, "Undo"));
        for (int i = 0; i < 500 && script() == before; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        EXPECT_NE(script(), before);
    }
    /// Whether the file on disk comes to hold all of these texts.
    bool file_contains(const std::vector<std::string>& texts) const {
        for (int i = 0; i < 500; ++i) {
            const std::string now = script();
            if (std::all_of(texts.begin(), texts.end(),
                            [&](const std::string& text) { return now.find(text) != std::string::npos; }))
                return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    std::string script() const { return text_of("plant_session.lua"); }
    Browser browser;
    std::unique_ptr<PageProgram> program;
};

// Clicks.

TEST_F(workbench_hands, four_clicks_at_once_are_four_steps) {
    const std::string before = script();
    evaluate("for (const words of ['+ Level', '+ Trend', '+ Outliers', '+ Resample']) named(words).click()");
    EXPECT_TRUE(file_contains({"\"mean\"", "\"linear\"", "filloutliers(", "resample("})) << script();
    ASSERT_TRUE(is_ready(browser));
    for (int i = 0; i < 4; ++i) undo();
    EXPECT_EQ(script(), before) << "each is a step of the history";
}

TEST_F(workbench_hands, a_click_that_meets_the_edit_of_another_tab_is_done_behind_it) {
    evaluate(
        "window.fetch = async (path, how) => { if (path !== 'script') return plain(path, how); window.fetch = plain; "
        "await order(JSON.parse(how.body).revision, 1, 0, '-- theirs'); return plain(path, how); }; "
        "named('New model').click();");
    EXPECT_TRUE(file_contains({"-- theirs\n", "\nG1 = tfsrivc("})) << script();
}

TEST_F(workbench_hands, a_click_that_never_gets_through_is_reported) {
    evaluate(
        "window.fetch = async (path, how) => (path === 'script' ? new Response('', { status: 409 }) : plain(path, "
        "how)); named('New model').click();");
    EXPECT_TRUE(says(browser, "Not applied, because another program keeps changing the script"));
}

TEST_F(workbench_hands, a_drag_is_one_step_of_the_history_even_where_its_first_move_is_overtaken) {
    evaluate(
        "mirror.replaceRange('\\n\\n-- %% id=G1\\nG1 = tfsrivc(data, 2, 0, {IODelay = 0.1})\\n', {line: 1e9, ch: 0})");
    const std::string slider =
        "[...document.querySelectorAll('.chosen label')].find((one) => one.textContent.startsWith('IODelay'))"
        "?.querySelector('input[type=range]')";
    ASSERT_TRUE(browser.becomes_true(slider));
    ASSERT_TRUE(is_ready(browser));
    evaluate("const slider = " + slider +
             "; named('+ Level').click(); for (const at of [0.1, 0.2, 0.3]) { slider.value = at; "
             "slider.dispatchEvent(new Event('input')); } slider.dispatchEvent(new Event('change'));");
    ASSERT_TRUE(file_contains({"\"mean\"", "{IODelay = 0.277}"})) << script();
    ASSERT_TRUE(is_ready(browser));
    undo();
    EXPECT_THAT(script(), AllOf(HasSubstr("\"mean\""), HasSubstr("{IODelay = 0.1}"))) << "the click stays";
}

// Typing.

TEST_F(workbench_hands, what_is_typed_is_saved_before_a_click_behind_it) {
    evaluate("atEnd('-- typed\\n'); await pause(100); named('New model').click();");
    EXPECT_TRUE(file_contains({"-- typed\n", "\nG1 = tfsrivc("})) << script();
    ASSERT_TRUE(is_ready(browser));
    undo();
    EXPECT_THAT(script(), AllOf(HasSubstr("-- typed\n"), Not(HasSubstr("G1"))));
    undo();
    EXPECT_THAT(script(), Not(HasSubstr("typed")));
}

TEST_F(workbench_hands, what_is_typed_in_one_go_is_one_step_of_the_history) {
    const std::string before = script();
    evaluate("for (const letter of '-- typed') { atEnd(letter); await pause(500); }");
    ASSERT_TRUE(file_contains({"-- typed"})) << script();
    ASSERT_TRUE(is_ready(browser));
    undo();
    EXPECT_EQ(script(), before);
}

/// A field is created again with each of its keys.
TEST_F(workbench_hands, what_is_typed_into_a_field_is_one_step_until_something_else_is_done) {
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(script_has(browser, "tfsrivc(estimation, 2, 0)")) << "the page, too, whose field is typed into";
    ASSERT_TRUE(is_ready(browser));
    const auto type = [&](const std::string& name, const std::string& value) {
        evaluate(
            "const box = [...document.querySelectorAll('#steps label')].find((one) => one.firstChild.textContent "
            "=== '" +
            name + "').querySelector('input'); box.focus(); box.value = '" + value +
            "'; box.dispatchEvent(new Event('input', {bubbles: true}));");
        ASSERT_TRUE(is_ready(browser));
    };
    type("np", "1");
    type("np", "3");
    type("nz", "1");
    type("np", "4");
    ASSERT_TRUE(file_contains({"tfsrivc(estimation, 4, 1)"})) << script();
    undo();
    EXPECT_THAT(script(), HasSubstr("tfsrivc(estimation, 3, 1)")) << "another field had the focus between";
    type("np", "2");
    ASSERT_TRUE(file_contains({"tfsrivc(estimation, 2, 1)"})) << script();
    undo();
    EXPECT_THAT(script(), HasSubstr("tfsrivc(estimation, 3, 1)")) << "it was undone between";
    undo();
    EXPECT_THAT(script(), HasSubstr("tfsrivc(estimation, 3, 0)"));
    undo();
    EXPECT_THAT(script(), HasSubstr("tfsrivc(estimation, 2, 0)")) << "1 and 3 were typed in one go";
}

TEST_F(workbench_hands, undo_behind_typing_undoes_what_was_typed) {
    const std::string before = script();
    evaluate("named('+ Level').click();");
    ASSERT_TRUE(file_contains({"\"mean\""}));
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('undo').disabled"))
        << "the page hears of it after the file";
    ASSERT_TRUE(is_ready(browser));
    evaluate("atEnd('-- typed\\n'); document.getElementById('undo').click();");
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('redo').disabled"));
    EXPECT_THAT(script(), AllOf(HasSubstr("\"mean\""), Not(HasSubstr("typed"))));
    EXPECT_FALSE(
        browser.becomes_true("document.querySelector('.CodeMirror').CodeMirror.getValue().includes('typed')", 1));
    undo();
    EXPECT_EQ(script(), before);
}

TEST_F(workbench_hands, typing_and_the_edits_of_others_are_put_together) {
    evaluate(
        "const { session } = await import('./bench_session.js'); atEnd('-- typed\\n'); "
        "await order(session.revision, 1, 0, '-- theirs');");
    EXPECT_TRUE(file_contains({"-- theirs\n", "-- typed\n"})) << script();
    EXPECT_TRUE(script_has(browser, "-- theirs")) << "and in the editor";
    write("plant_session.lua", "-- a program\n" + script());  // another editor writes
    evaluate("atEnd('-- more\\n');");
    EXPECT_TRUE(file_contains({"-- a program\n", "-- theirs\n", "-- typed\n", "-- more\n"})) << script();
}

TEST_F(workbench_hands, lines_that_others_change_while_they_are_typed_are_reported_and_can_be_had_again) {
    evaluate(
        "const { session } = await import('./bench_session.js'); mirror.replaceRange('-- mine\\n', {line: 0, ch: 0}, "
        "{line: 1, ch: 0}); "
        "await order(session.revision, 1, 1, '-- theirs');");
    EXPECT_TRUE(says(browser, "edited. Your lines"));
    EXPECT_THAT(script(), AllOf(HasSubstr("-- mine\n"), Not(HasSubstr("-- theirs"))));
    undo();
    EXPECT_THAT(script(), AllOf(HasSubstr("-- theirs\n"), Not(HasSubstr("-- mine"))));
}

TEST_F(workbench_hands, keys_that_come_while_text_is_sent_follow_it) {
    evaluate(
        "window.fetch = async (path, how) => { if (path === 'script') await pause(700); return plain(path, how); }; "
        "for (const letter of 'abcdefghij') { atEnd(letter); await pause(150); } await pause(600); atEnd('klm');");
    EXPECT_TRUE(file_contains({"abcdefghijklm"})) << script();
    EXPECT_TRUE(script_has(browser, "abcdefghijklm"));
}

TEST_F(workbench_hands, what_is_typed_before_the_page_is_left_is_there) {
    evaluate("atEnd('-- typed\\n');");
    browser.open("about:blank");
    EXPECT_TRUE(file_contains({"-- typed\n"})) << script();
}

TEST_F(workbench_hands, ten_tabs_are_heard_and_each_hears) {
    Browser whole(1280, 900, Browser::Kind::kWhole);  // reports to a tab that it is hidden
    const std::string address = program->next_address();
    for (int i = 0; i < 10; ++i) {
        if (i > 0) whole.new_tab();
        whole.open(address);
        ASSERT_TRUE(whole.becomes_true("document.querySelector('.CodeMirror')", 10)) << "tab " << i;
        ASSERT_TRUE(press(whole, "+ Level")) << "tab " << i;
        ASSERT_TRUE(
            whole.becomes_true("document.querySelectorAll('.preparing li').length === " + std::to_string(i + 1), 10));
    }
}

TEST_F(workbench_hands, what_is_typed_in_a_tab_that_is_hidden_then_is_there) {
    Browser whole(1280, 900, Browser::Kind::kWhole);
    whole.open(program->next_address());
    ASSERT_TRUE(whole.becomes_true("document.querySelector('.CodeMirror')"));
    whole.evaluate("document.querySelector('.CodeMirror').CodeMirror.replaceRange('-- typed\\n', {line: 1e9, ch: 0})");
    whole.new_tab();
    EXPECT_TRUE(file_contains({"-- typed\n"})) << script();
}

// What is written into a script that has the like already.

TEST_F(workbench_hands, parts_find_an_id_beside_cells_that_are_called_so) {
    evaluate(
        "mirror.setValue(mirror.getValue().replace('estimation = prepared\\nvalidation = prepared\\n', "
        "'x = 1\\n\\n-- %% id=estimation\\nx = 2\\n'));");
    ASSERT_TRUE(file_contains({"id=estimation"}));
    ASSERT_TRUE(is_ready(browser));
    ASSERT_TRUE(press(browser, "Split 60 : 40"));
    EXPECT_TRUE(file_contains({"-- %% id=parts1\nestimation = prepared:range(1, 480)\n"})) << script();
    EXPECT_TRUE(says(browser, "(480)")) << "its samples, once it has run";
    EXPECT_TRUE(is_ready(browser));
    undo();
    ASSERT_TRUE(is_ready(browser));
    evaluate(
        "const edge = document.querySelectorAll('.brush.estimation .edge')[1]; edge.dispatchEvent(new "
        "KeyboardEvent('keydown', {key: "
        "'PageDown', bubbles: true}));");
    EXPECT_TRUE(file_contains({"-- %% id=estimation1\nestimation = prepared:range(1, "})) << script();
}

TEST_F(workbench_hands, a_step_over_two_lines_that_is_switched_off_is_one_remark) {
    evaluate(
        "mirror.setValue(mirror.getValue().replace('prepared = data\\n', 'prepared = data\\nprepared = "
        "idfilt(prepared, {0,\\n  12})\\n'));");
    const std::string box = "document.querySelector('.preparing input[type=checkbox]')";
    ASSERT_TRUE(browser.becomes_true(box));
    ASSERT_TRUE(is_ready(browser));
    evaluate(box + ".click();");
    EXPECT_TRUE(file_contains({"= data\n-- off: prepared = idfilt(prepared, {0, 12})\n"})) << script();
    ASSERT_TRUE(browser.becomes_true("!" + box + ".checked"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').textContent === 'up to date'"));
    evaluate(box + ".click();");
    EXPECT_TRUE(file_contains({"= data\nprepared = idfilt(prepared, {0, 12})\n"})) << script();
}

// The runs of a study increase during changes.

TEST_F(workbench_hands, a_study_comes_to_all_its_runs_however_often_it_is_altered_or_to_those_that_are_said) {
    evaluate("document.querySelectorAll('#steps details').forEach((one) => { one.open = true; });");
    ASSERT_TRUE(press(browser, "Start study"));
    const std::string field =
        "const field = (name) => [...document.querySelectorAll('#steps label')].find((one) => "
        "one.textContent.startsWith(name))"
        ".querySelector('input'); const put = (name, value) => { const box = field(name); box.value = value; "
        "box.dispatchEvent(new Event('change')); };";
    ASSERT_TRUE(browser.becomes_true(
        "[...document.querySelectorAll('#steps label')].some((one) => one.textContent.startsWith('noise'))"));
    evaluate(field + "put('noise', 0.2); await pause(100); put('noise', 0.3); await pause(1500);");
    EXPECT_TRUE(file_contains({"sigma = 0.3", "runs = 200"})) << script();
    evaluate(field + "put('noise', 0.4); await pause(100); put('runs', 60); await pause(1500);");
    EXPECT_TRUE(file_contains({"sigma = 0.4", "runs = 60"})) << script();
}

// The system takes the pointer away during a drag.

TEST_F(workbench_hands, a_part_stays_where_it_was_when_the_system_takes_the_pointer) {
    const std::string hand =
        "const bar = document.querySelector('.brush.estimation'), box = bar.getBoundingClientRect(), edge = "
        "bar.querySelectorAll('.edge')[1];"
        "const at = (name, share, pointerId = 7) => (name === 'pointerdown' ? edge : document).dispatchEvent(new "
        "PointerEvent(name, { pointerId, bubbles: true, "
        "button: 0, clientX: box.left + share * box.width, clientY: box.top + 2 }));";
    evaluate(hand + "at('pointerdown', 1); at('pointermove', 0.7, 8); at('pointermove', 0.5); at('pointercancel', 0);");
    ASSERT_TRUE(file_contains({"estimation = prepared:range(1, 40"})) << script();
    ASSERT_TRUE(is_ready(browser));
    const std::string before = script();
    evaluate(hand + "at('pointermove', 0.2); at('pointerup', 0.2); await pause(500);");
    EXPECT_EQ(script(), before);
    undo();
    EXPECT_THAT(script(), Not(HasSubstr("range("))) << "one step of the history";
}

}  // namespace test_workbench_hands
