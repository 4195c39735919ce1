// The editor beside the page of `dynlab preview --edit`: its completions and messages while the user types, and when
// code runs. Oracles: the function catalog, the values that the lines of the script give, and the files afterwards.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "platform/atomic_file.h"
#include "scripting/interpreter/catalog.h"
#include "support/page_client.h"
#include "support/preview.h"

namespace test_preview_editor {
using namespace dynlab;
using namespace dynlab::test;
using nlohmann::json;
using testing::HasSubstr;

const std::string kScript =
    "-- %% [markdown]\n-- # A heading\n--\n-- **Question 1.** Why is $x^2$ so?\n\n"
    "-- %% id=first\nlocal G = tf({2}, {1, 3})\nlocal long_vector = linspace(0, 1, 500)\nprint(\"first ran\")\n\n"
    "-- %% id=second\nprint(\"second ran\")\n\n"
    "-- %% id=third\nprint(\"third ran\")\n";

class preview_editor : public preview_page {
  protected:
    void open(Browser& browser, const Preview& preview, const std::string& ran = "third ran") {
        browser.open(preview.address());
        ASSERT_TRUE(browser.becomes_true("document.querySelector('.editing .CodeMirror')"));
        ASSERT_TRUE(shows(browser, ran));
        ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.text-cell').length > 0"));
    }
    /// Puts the cursor behind the last letter of the line that begins so.
    static void go_to(Browser& browser, const std::string& line) {
        browser.evaluate(
            "window.cm = document.querySelector('.CodeMirror').CodeMirror; cm.focus();"
            "for (let i = 0; i < cm.lineCount(); ++i) if (cm.getLine(i).startsWith('" +
            line + "')) { cm.setCursor(i, cm.getLine(i).length); return; } throw new Error('no such line')");
    }
    static void press(Browser& browser, const std::vector<std::string>& held, const std::string& key) {
        json keys = json::array();
        for (const std::string& one : held) keys.push_back({{"type", "keyDown"}, {"value", one}});
        keys.push_back({{"type", "keyDown"}, {"value", key}});
        keys.push_back({{"type", "keyUp"}, {"value", key}});
        for (const std::string& one : held) keys.push_back({{"type", "keyUp"}, {"value", one}});
        browser.act(json::array({{{"type", "key"}, {"id", "keys"}, {"actions", keys}}}).dump());
    }
    static void type(Browser& browser, const std::string& text) {
        for (const char letter : text) press(browser, {}, std::string(1, letter));
    }
    static std::string line_of_cursor(Browser& browser) {
        return json::parse(browser.evaluate("return cm.getLine(cm.getCursor().line)")).get<std::string>();
    }
    static constexpr const char *kShift = "\uE008", *kEnter = "\uE007", *kTab = "\uE004", *kEscape = "\uE00C";
};

TEST_F(preview_editor, functions_options_and_fields_of_variables_are_completed) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    const auto offers = [&](const std::string& name) {
        return browser.becomes_true(
            "[...document.querySelectorAll('.CodeMirror-hint b')].some(b => b.innerText.trim() === '" + name + "')");
    };
    go_to(browser, "print(\"third");
    press(browser, {}, kEnter);
    type(browser, "lss");
    EXPECT_TRUE(offers("lssvf"));
    const std::string signature = signature_text(*find_function("lssvf"));
    EXPECT_EQ(json::parse(browser.evaluate("return document.querySelector('.CodeMirror-hint .note').innerText")),
              signature);
    press(browser, {}, kTab);
    EXPECT_EQ(line_of_cursor(browser), "lssvf");
    press(browser, {}, kEnter);
    type(browser, "lsim(G, u, 1, {ho");
    EXPECT_TRUE(offers("hold ="));
    press(browser, {}, kEscape);
    press(browser, {}, kEnter);
    type(browser, "long");  // a variable of the script that has run
    EXPECT_TRUE(offers("long_vector"));
    press(browser, {}, kEscape);
    type(browser, " G.");
    EXPECT_TRUE(offers("den")) << browser.evaluate("return document.querySelector('.CodeMirror-hints')?.innerText");
}

TEST_F(preview_editor, the_call_around_the_cursor_shows_its_signature_and_the_argument) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    go_to(browser, "print(\"third");
    press(browser, {}, kEnter);
    type(browser, "lsim(G, max(1, 2), ");
    const std::string shown = "document.getElementById('signature')";
    EXPECT_TRUE(browser.becomes_true("!" + shown + ".hidden && " + shown +
                                     ".querySelector('b').innerText.trim() === 't_or_Ts'"))
        << browser.evaluate("return " + shown + ".innerText");
    EXPECT_THAT(browser.evaluate("return " + shown + ".innerText"), HasSubstr(find_function("lsim")->summary));
    type(browser, "1)");
    EXPECT_TRUE(browser.becomes_true(shown + ".hidden"));
}

TEST_F(preview_editor, a_mistake_is_marked_while_it_is_typed_and_an_error_where_the_run_stopped) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    go_to(browser, "print(\"third");
    press(browser, {}, kEnter);
    type(browser, "print(nothing)");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.mistake')?.innerText === 'nothing'"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('mistake').innerText.includes(\"'nothing'\")"));
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.failed').length"), "0");
    press(browser, {"\uE009"}, "s");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.failure')?.innerText.includes(\"'nothing'\")"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.failed')?.innerText.includes('print(nothing)')"));
    browser.evaluate("cm.undo(); cm.setValue(cm.getValue().replace('print(nothing)', ''))");
    press(browser, {"\uE009"}, "s");
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.failed, .failure, .mistake')"));
}

TEST_F(preview_editor, shift_enter_saves_runs_the_cell_and_goes_to_the_next) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    go_to(browser, "print(\"first");
    type(browser, " print(6*7)");
    press(browser, {kShift}, kEnter);
    EXPECT_TRUE(shows(browser, "42"));
    EXPECT_EQ(line_of_cursor(browser), "print(\"second ran\")");
    EXPECT_THAT(read_text(file()), HasSubstr("print(\"first ran\") print(6*7)\n"));
    // A cell that has not changed runs again: its own output comes from a new run.
    write(kHead +
          "-- %% [markdown]\n-- Text.\n\n-- %% id=first\nprint(\"first ran\")\n\n-- %% id=drawn\nprint(clock() > 0)\n");
    EXPECT_TRUE(state_is(browser, "drawn", "done"));
    go_to(browser, "print(\"first ran\")");
    press(browser, {kShift}, kEnter);
    EXPECT_TRUE(state_is(browser, "drawn", "done"));
}

/// Oracle: how many cells the page says were run.
TEST_F(preview_editor, the_cells_above_run_alone) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    go_to(browser, "print(\"first");
    type(browser, " x = 1");
    go_to(browser, "print(\"third");
    browser.click("#run-above");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').innerText === 'stopped: 2 of 3 cells were run'"))
        << browser.evaluate("return document.getElementById('state').innerText");
    browser.click("#run-all");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').innerText.startsWith('3 cells')"));
}

TEST_F(preview_editor, text_cells_look_like_text_until_they_are_edited) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    EXPECT_EQ(json::parse(browser.evaluate("return document.querySelector('.text-cell :is(h1, h2, h3)').innerText")),
              "A heading");
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.text-cell math').length"), "1");
    const json place =
        json::parse(browser.evaluate("const box = document.querySelector('.text-cell strong').getBoundingClientRect();"
                                     "return [Math.round(box.x + box.width / 2), Math.round(box.y + box.height / 2)]"));
    browser.act(json::array({{{"type", "pointer"},
                              {"id", "hand"},
                              {"actions",
                               {{{"type", "pointerMove"}, {"x", place[0]}, {"y", place[1]}},
                                {{"type", "pointerDown"}, {"button", 0}},
                                {{"type", "pointerUp"}, {"button", 0}}}}}})
                    .dump());
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.text-cell')"));
    browser.evaluate("window.cm = document.querySelector('.CodeMirror').CodeMirror");
    EXPECT_THAT(line_of_cursor(browser), HasSubstr("Question 1"));
    go_to(browser, "-- **Question 1");
    type(browser, " Really?");
    press(browser, {kShift}, kEnter);
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.text-cell')?.innerText.includes('so? Really?')"));
    EXPECT_THAT(read_text(file()), HasSubstr("-- **Question 1.** Why is $x^2$ so? Really?\n"));
    // The outline leads to it.
    EXPECT_EQ(json::parse(browser.evaluate("return [...document.querySelectorAll('#outline option')].slice(1).map(o => "
                                           "o.innerText.trim())")),
              json::parse(R"(["A heading", "Question 1: Why is x^2 so? Really?"])"));
}

/// Oracles: the signs of a text cell, and which of its lines are headings.
TEST_F(preview_editor, the_next_line_of_a_text_cell_is_text_and_headings_alone_look_like_them) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    go_to(browser, "-- # A heading");
    press(browser, {}, kEnter);
    type(browser, "A second paragraph.");
    EXPECT_EQ(line_of_cursor(browser), "-- A second paragraph.");
    press(browser, {}, kEnter);
    type(browser, "- one");
    EXPECT_EQ(line_of_cursor(browser), "-- - one");
    press(browser, {"\uE009"}, "s");
    EXPECT_TRUE(browser.becomes_true("document.getElementById('save').disabled"));
    EXPECT_THAT(read_text(file()), HasSubstr("-- # A heading\n-- A second paragraph.\n-- - one\n--\n"));
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.failure')"));
    go_to(browser, "-- **Question 1");
    const auto headings = [&] {
        return json::parse(
            browser.evaluate("return [...new Set([...document.querySelectorAll('.cm-header')].map(h => "
                             "h.closest('.CodeMirror-line').innerText.trim()))]"));
    };
    EXPECT_EQ(headings(), json::parse(R"(["-- # A heading"])"));
}

/// A list that is open takes no line from the user.
TEST_F(preview_editor, enter_ends_a_complete_line_while_names_are_offered) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    go_to(browser, "print(\"third");
    press(browser, {}, kEnter);
    type(browser, "lss");
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.CodeMirror-hint')"));
    const int line = std::stoi(browser.evaluate("return cm.getCursor().line"));
    press(browser, {}, kEnter);
    EXPECT_EQ(browser.evaluate("return cm.getCursor().line"), std::to_string(line + 1));
    EXPECT_EQ(line_of_cursor(browser), "");
}

TEST_F(preview_editor, the_variables_of_the_script_are_listed_and_what_was_typed_is_undone_after_a_new_start) {
    write(kHead + kScript);
    const std::filesystem::path state = folder.path() / "state";
    ::setenv("XDG_STATE_HOME", state.c_str(), 1);
    {
        const Preview preview(file(), true, {"--edit"});
        Browser browser;
        open(browser, preview);
        const std::string rows =
            "[...document.querySelectorAll('#variable-rows tr')].map(r => r.innerText.split('\\t').map(t "
            "=> t.trim()))";
        EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('#variable-rows tr').length === 2"))
            << browser.evaluate("return " + rows);
        const json listed = json::parse(browser.evaluate("return " + rows));
        EXPECT_EQ(listed[0][0], "G");
        EXPECT_EQ(listed[1][0], "long_vector");
        EXPECT_EQ(listed[1][1], "500 × 1");
        EXPECT_EQ(browser.evaluate(
                      "return document.querySelectorAll('#variable-rows tr')[1].querySelectorAll('polyline').length"),
                  "1");
        go_to(browser, "print(\"third");
        type(browser, " y = 5");
        press(browser, {"\uE009"}, "s");
        EXPECT_TRUE(browser.becomes_true("document.getElementById('save').disabled"));
        browser.open("about:blank");
    }
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    open(browser, preview);
    browser.evaluate(
        "window.cm = document.querySelector('.CodeMirror').CodeMirror; for (let i = 0; i < 20; ++i) cm.undo()");
    EXPECT_EQ(json::parse(browser.evaluate("return cm.getValue()")), kHead + kScript);
    ::unsetenv("XDG_STATE_HOME");
}

/// The code that is copied of a figure draws it again. Oracle: the first figure's samples.
TEST_F(preview_editor, the_code_of_a_figure_draws_the_same_figure) {
    const std::string figure =
        "-- %% id=drawn\nlocal t = linspace(0, 4, 41)\nsubplot(2, 1, {plot(t, exp(-t), \"fast\", t, exp(-t/2), "
        "\"slow\", "
        "{ylabel = \"level (V)\"}), plot({1, 2, 4}, {3, 1, 2}, {style = \"points\", xlabel = \"time (s)\"})})\n";
    write(kHead + figure);
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelector('div.plot')"));
    const std::string code =
        json::parse(browser.evaluate("return dynlabCopies.lua(document.querySelector('div.plot').plot)"));
    write(kHead + figure + "\n-- %% id=again\n" + code);
    EXPECT_TRUE(browser.becomes_true("document.querySelectorAll('div.plot').length === 2"))
        << code << browser.evaluate("return document.getElementById('document').innerText");
    EXPECT_EQ(
        browser.evaluate(
            "const data = [...document.querySelectorAll('div.plot')].map(b => JSON.stringify(b.plot.panels.map(p => "
            "[p.x.label, p.y.label, p.curves.map(c => [c.label, c.style, c.x.map(v => +v.toPrecision(6)), c.y.map(v => "
            "+v.toPrecision(6))])]))); return data[0] === data[1] || data"),
        "true");
}

/// Every new request is refused for other sites, and without the cookie.
TEST_F(preview_editor, only_the_page_itself_may_ask) {
    write(kHead + kScript);
    const Preview preview(file(), true, {"--edit"});
    const PageClient page(preview.address());
    for (const char* const path : {"/complete", "/help", "/variables", "/lint", "/run"}) {
        const auto status = [&](const httplib::Headers& headers) {
            const auto reply = page.client().Post(path, headers, "{}", "application/json");
            return reply ? reply->status : 0;
        };
        EXPECT_EQ(status(page.known()), 403) << path << " without the field of the page";
        httplib::Headers foreign = page.of_page();
        foreign.erase("Origin");
        foreign.emplace("Origin", "http://example.org");
        EXPECT_EQ(status(foreign), 403) << path << " from another site";
        httplib::Headers without_cookie = page.of_page();
        without_cookie.erase("Cookie");
        EXPECT_EQ(status(without_cookie), 403) << path << " without the cookie";
        EXPECT_EQ(page.get(path)->status, 404) << path << " by GET";
    }
    // Until the user allows runs, the variables of the script are unknown, and no order runs the script.
    write("-- %% id=a\nsecret = 1\nprint(\"it ran\")\n", "other.lua");
    const Preview other(file("other.lua"), false, {"--edit"});
    const PageClient asked(other.address());
    EXPECT_EQ(asked.post("/run", R"({"place": {"file": "other.lua", "line": 2, "again": true}})")->status, 200);
    EXPECT_EQ(json::parse(asked.post("/variables", "")->body), json::array());
}

}  // namespace test_preview_editor
