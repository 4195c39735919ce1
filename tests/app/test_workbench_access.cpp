// The workbench without a mouse, without sight and in words: keys, names for screen readers, help, refusals. Oracle:
// the script on disk, Chromium's own accessibility tree, and the texts of the help pages.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/program.h"
#include "support/workbench.h"

namespace test_workbench_access {
using namespace dynlab;
using namespace dynlab::test;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kTab = "\\uE004", kEnter = "\\uE007", kSpace = " ", kUp = "\\uE013", kDown = "\\uE015";

class workbench_access : public workbench_page {
  protected:
    static void key(Browser& browser, const std::string& name) {
        browser.act(R"([{"type": "key", "id": "k", "actions": [{"type": "keyDown", "value": ")" + name +
                    R"("}, {"type": "keyUp", "value": ")" + name + R"("}]}])");
    }
    /// Presses Tab until the focused control has this name or text; false after a whole round.
    static bool tab_to(Browser& browser, const std::string& name) {
        for (int i = 0; i < 250; ++i) {
            key(browser, kTab);
            if (browser.evaluate("const one = document.activeElement; return [one.ariaLabel, one.textContent.trim(), "
                                 "one.closest('label')?.textContent.trim()].includes(`" +
                                 name + "`)") == "true")
                return true;
        }
        return false;
    }
    static void wait(Browser& browser) {
        browser.becomes_true("document.getElementById('state').textContent === 'computing'", 0.3);
        ASSERT_TRUE(is_ready(browser));
    }
    std::string script() const { return text_of("plant_session.lua"); }
};

TEST_F(workbench_access, keys_alone_lead_from_a_file_to_a_model_and_its_figure_in_the_report) {
    write_data_set("zz.csv");
    const auto program = app("");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('#steps select option').length > 1"));
    ASSERT_TRUE(tab_to(browser, "course data sets, and files in this folder"));
    key(browser, "z");  // the only name that begins so
    ASSERT_TRUE(says(browser, "Use these data"));
    ASSERT_TRUE(tab_to(browser, "Use these data"));
    key(browser, kEnter);
    ASSERT_TRUE(view_appears(browser, "record"));
    wait(browser);
    ASSERT_TRUE(tab_to(browser, "Split 60 : 40"));
    key(browser, kSpace);
    ASSERT_TRUE(script_has(browser, "prepared:range(1, 480)"));
    wait(browser);
    EXPECT_TRUE(browser.becomes_true("document.activeElement.textContent === 'Split 60 : 40'")) << "focus stays";
    ASSERT_TRUE(tab_to(browser, "New model"));
    key(browser, kEnter);
    ASSERT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, 2, 0)"));
    wait(browser);
    ASSERT_TRUE(tab_to(browser, "nz"));
    key(browser, kUp);
    ASSERT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, 2, 1)"));
    wait(browser);
    key(browser, kDown);
    ASSERT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, 2, 0)")) << "the field is still under the keys";
    wait(browser);
    ASSERT_TRUE(tab_to(browser, "+ report: Bode"));
    key(browser, kEnter);
    ASSERT_TRUE(script_has(browser, "bode(G1)"));
    EXPECT_THAT(text_of("session.lua"), HasSubstr("-- %% id=bode echo=false\nreport.figure(\"bode\", bode(G1), "));
    ASSERT_TRUE(tab_to(browser, "Close: Bode"));
    key(browser, kEnter);
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.tile[data-view=bode]')"));
    EXPECT_TRUE(browser.becomes_true("document.activeElement.closest('#views')")) << "not at the page's beginning";
    ASSERT_TRUE(tab_to(browser, "Undo"));
    for (int i = 0; i < 20 && browser.evaluate("return document.getElementById('undo').disabled") == "false"; ++i) {
        key(browser, kEnter);
        wait(browser);
    }
    EXPECT_EQ(browser.evaluate("return document.activeElement.id"), "\"redo\"") << "when there is nothing to undo";
}

TEST_F(workbench_access, every_control_has_a_name) {
    write("step.lua",
          "local u = zeros(400)\nfor k = 21, 400 do u[k] = 1 end\n"
          "local y = lsim(tf({2}, {3, 1}), u, 0.1)\nfor k = 1, #y do y[k] = y[k] + 0.01*randn() end\n"
          "data = iddata(y, u, 0.1)\n\n-- %% id=preparation\nprepared = data\nprepared = detrend(prepared, \"start\")\n"
          "prepared = resample(prepared, 1, 2)\n\n-- %% id=parts\nestimation = prepared\nvalidation = prepared\n\n"
          "-- %% id=G1\nG1 = tfsrivc(estimation, 1, 0, {IODelay = 0.1})\n\n-- %% id=G2\nG2 = srivc(estimation, {1, "
          "1, 0}, {lambda = 3})\n\n-- %% id=orders1\norders1 = srivcstruc(estimation, {poles = {1, 2}, zeros = {0, "
          "1}})\n\n"
          "-- %% id=study1\ns = tf(\"s\")\nsystem1 = 2/(s + 1)\ninput1 = prbs(5, 4)\nstudy1 = montecarlo{system = "
          "system1, "
          "input = input1, Ts = 0.1, sigma = 0.1, runs = 20,\n  estimators = {srivc = {{1, 1, 0}, {lambda = 3}}}}\n\n"
          "-- %% id=reading1\nreading1 = {kind = \"first\", start = 2, rest = 0, change = 1, K = 2, T = "
          "3}\nreading1_model = "
          "tf({reading1.K}, {reading1.T, 1})\n");
    const auto program = app("step.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(is_ready(browser));
    for (const char* view : {"record", "bode", "study", "reading"}) ASSERT_TRUE(view_appears(browser, view)) << view;
    ASSERT_TRUE(browser.becomes_true("document.querySelector('button.order')"));
    browser.evaluate("document.querySelectorAll('details').forEach((one) => { one.open = true; })");
    std::set<std::string> kinds;
    for (const std::string chosen : {"G1", "G2"}) {
        browser.evaluate("[...document.querySelectorAll('.models td button')].find((one) => one.textContent === '" +
                         chosen +
                         "').click(); document.querySelectorAll('details').forEach((one) => { one.open = true; })");
        const json tree = json::parse(browser.devtools("Accessibility.getFullAXTree", "{}"));
        for (const json& node : tree["nodes"]) {
            const std::string role = node.value("role", json::object()).value("value", "");
            static const std::set<std::string> kControls = {"button",  "textbox",  "spinbutton",
                                                            "slider",  "checkbox", "combobox",
                                                            "listbox", "menuitem", "application"};
            const bool hidden = node.value("ignored", false);
            if (hidden || !kControls.contains(role)) continue;
            kinds.insert(role);
            EXPECT_NE(node.value("name", json::object()).value("value", ""), "") << node.dump().substr(0, 600);
        }
    }
    EXPECT_GE(kinds.size(), 6u) << "these are all looked at";
    EXPECT_EQ(
        browser.evaluate("const names = [...document.querySelectorAll('#steps select')].map((one) => one.ariaLabel)"
                         ".filter((one) => one?.startsWith('Method')); return [names.length, new Set(names).size]"),
        "[2,2]");
    EXPECT_THAT(browser.evaluate("return document.querySelector('.brush .edge').getAttribute('aria-valuetext')"),
                HasSubstr(" s"));
}

TEST_F(workbench_access, a_name_that_cannot_be_is_refused_in_words) {
    Browser browser;
    const auto program = open(browser);
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(view_appears(browser, "bode"));
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(script_has(browser, "G2 ="));
    wait(browser);
    const auto rename = [&](const std::string& name) {
        browser.evaluate(
            "const box = document.getElementById('new-name'); if (!box.closest('dialog').open) "
            "document.querySelector('.actions button:nth-of-type(2)').click(); box.value = '" +
            name + "'; box.form.requestSubmit()");
    };
    const std::string before = script();
    for (const auto& [name, words] :
         {std::pair("best model", "letters, digits"), std::pair("end", "Lua keyword"),
          std::pair("G1", "is already used in the script"), std::pair("bode", "the name of a function")}) {
        rename(name);
        EXPECT_TRUE(browser.becomes_true("document.getElementById('name-trouble').textContent.includes('" +
                                         std::string(words) + "')"))
            << name;
    }
    EXPECT_EQ(script(), before);
    rename("best");
    ASSERT_TRUE(script_has(browser, "best = tfsrivc(estimation, 2, 0)"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.chosen h3').textContent === 'best'"));
}

TEST_F(workbench_access, help_is_formatted_and_its_text_is_no_markup) {
    Browser browser;
    const auto program = open(browser);
    for (const char* name : {"srivc", "advice", "sign"}) {
        browser.evaluate("return import('./bench_help.js').then(({help}) => help('" + std::string(name) + "'))");
        EXPECT_EQ(browser.evaluate("return /`|^#|\\n- |\\*\\*/.test([...document.querySelectorAll('#help-text > "
                                   ":not(pre)')].map((one) => one.textContent).join('\\n'))"),
                  "false")
            << name;
        EXPECT_EQ(
            browser.evaluate("return ['h3', 'p', 'table'].map((kind) => document.querySelectorAll('#help-text ' + "
                             "kind).length > 0)"),
            name == std::string("sign") ? "[true,true,false]" : "[true,true,true]");
        browser.evaluate("document.getElementById('page-of-help').close()");
    }
    EXPECT_EQ(browser.evaluate(
                  "return import('./bench_help.js').then(({formatted}) => { const box = "
                  "document.createElement('div'); box.append(...formatted('- a `<b>` *b*\\n  and\\n- [x](y)\\n\\n"
                  "| a | b |\\n|---|---|\\n| 1 | `2` |\\n\\n<img src=x>\\nend')); return box.innerHTML; })"),
              "\"<ul><li>a <code>&lt;b&gt;</code> *b* and</li><li><span>x</span></li></ul><table><thead><tr><th>a</th>"
              "<th>b</th></tr></thead><tbody><tr><td>1</td><td><code>2</code></td></tr></tbody></table><p>&lt;img "
              "src=x&gt; end</p>\"");
}

// oracle: the summaries that dynlab help prints
TEST_F(workbench_access, every_why_opens_a_short_text_and_the_page_it_comes_from) {
    Browser browser;
    const auto program = open(browser);
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(view_appears(browser, "bode"));
    wait(browser);
    browser.evaluate("document.querySelectorAll('details').forEach((one) => { one.open = true; })");
    const json names =
        json::parse(browser.evaluate("return [...document.querySelectorAll('button.why')].filter((one) => "
                                     "one.offsetParent).map((one) => one.title)"));
    ASSERT_GT(names.size(), 8u);
    for (std::size_t i = 0; i < names.size(); ++i) {
        browser.evaluate("[...document.querySelectorAll('button.why')].filter((one) => one.offsetParent)[" +
                         std::to_string(i) + "].click()");
        ASSERT_TRUE(browser.becomes_true("document.getElementById('page-of-help').open")) << names[i];
        const json shown = json::parse(
            browser.evaluate("const text = document.getElementById('help-text'), rest = text.querySelector('details'); "
                             "return {title: document.getElementById('help-title').textContent, rest: Boolean(rest), "
                             "short: [...text.children].filter((one) => one !== rest).map((one) => "
                             "one.textContent).join(' ')}"));
        const std::string title = shown["title"], function = title.substr(title.rfind(' ') + 1);
        const std::string page = Workbench().dynlab({"help", function}).output;
        const std::size_t summary_at = page.find("\n\n") + 2;  // behind the underlined name
        const std::string summary = page.substr(summary_at, page.find('\n', summary_at) - summary_at);
        const std::string begin = shown["short"];
        ASSERT_GT(summary.size(), 10u) << title;
        EXPECT_TRUE(shown["rest"]) << title;
        EXPECT_GT(begin.size(), 20u) << title;
        EXPECT_LT(begin.size(), 700u) << title;
        EXPECT_THAT(begin, HasSubstr(summary)) << title;
        browser.evaluate("document.getElementById('page-of-help').close()");
    }
}

TEST_F(workbench_access, options_and_columns_say_what_they_are) {
    Browser browser;
    const auto program = open(browser);
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(view_appears(browser, "bode"));
    EXPECT_EQ(browser.evaluate("return [...document.querySelectorAll('.option small')].filter((one) => "
                               "one.textContent.length < 8).length"),
              "0");
    EXPECT_GE(std::stoi(browser.evaluate("return document.querySelectorAll('.option small').length")), 10);
    EXPECT_EQ(browser.evaluate("return [...document.querySelectorAll('.models th, .models th button')].filter((one) => "
                               "one.tagName === 'BUTTON' && (one.title === '' || one.title.endsWith('About'))).length"),
              "0");
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.models dt').length === "
                               "document.querySelectorAll('.models th button').length"),
              "true");
}

TEST_F(workbench_access, the_report_comes_as_a_file_of_the_session_s_name) {
    Browser browser;
    const auto program = open(browser);
    browser.evaluate(
        "HTMLAnchorElement.prototype.click = function () { window.given = this.download; }; window.open = () "
        "=> { window.opened = true; }");
    ASSERT_TRUE(press(browser, "Report (PDF)"));
    EXPECT_TRUE(browser.becomes_true("window.given", 60));
    EXPECT_EQ(browser.evaluate("return [window.given, window.opened ?? false]"), R"(["plant_session.pdf",false])");
}

TEST_F(workbench_access, after_the_end_nothing_can_be_pressed_and_nothing_fails) {
    Browser browser;
    const auto program = open(browser);
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(view_appears(browser, "bode"));
    program->end();
    ASSERT_TRUE(browser.becomes_true("document.getElementById('state').textContent.startsWith('dynlab has exited')"));
    EXPECT_EQ(
        browser.evaluate("return [...document.querySelectorAll('#bench-bar button:enabled')].map((one) => one.id)"),
        R"(["show-script"])");
    browser.evaluate("[...document.querySelectorAll('#steps button, .actions button')].forEach((one) => one.click())");
    EXPECT_FALSE(browser.becomes_true("document.body.innerText.includes('Failed to fetch')", 1));
}

TEST_F(workbench_access, files_that_come_and_go_beside_the_session_end_nothing) {
    Browser browser;
    const auto program = open(browser);
    for (int k = 0; k < 20000; ++k) {
        write("passing.csv", "");
        std::filesystem::remove(file("passing.csv"));
    }
    ASSERT_TRUE(press(browser, "+ Level"));
    EXPECT_TRUE(script_has(browser, "detrend(prepared"));
    EXPECT_THAT(script(), HasSubstr("detrend(prepared, \"mean\")"));
}

TEST_F(workbench_access, more_models_than_a_picture_takes_are_reported) {
    std::string text = "data = iddata(lsim(tf({2}, {1, 3}), prbs(6, 4), 0.1), prbs(6, 4), 0.1)\n";
    for (int k = 1; k <= 10; ++k) text += "G" + std::to_string(k) + " = tf({1}, {1, " + std::to_string(k) + "})\n";
    write("many.lua", text);
    const auto program = app("many.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    EXPECT_TRUE(says(browser, "the last 8 of 10 selected models"));
    ASSERT_TRUE(is_ready(browser));
    browser.evaluate(
        "for (let k = 0; k < 2; ++k) document.querySelectorAll('.models input[type=checkbox]')[k].click()");
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.models .warning')"));
}

TEST_F(workbench_access, a_record_that_begins_in_a_movement_is_answered_by_an_option_of_the_model) {
    std::string text = "# Ts: 0.1\nu,y\n";
    double x = 4;
    for (int k = 0; k < 400; ++k) {
        const double u = (k / 40) % 2 == 0 ? 1 : -1;
        text += std::to_string(u) + "," + std::to_string(x + 0.005 * std::sin(12.9898 * k * k)) + "\n";
        x += 0.05 * (u - x);
    }
    write("moving.csv", text);
    const auto program = app("moving.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(says(browser, "during a transient"));
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(press(browser, "G1: InitialState = \"estimate\""));
    EXPECT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, 2, 0, {InitialState = \"estimate\"})"));
    EXPECT_TRUE(
        browser.becomes_true("![...document.querySelectorAll('button')].some((one) => one.textContent.startsWith('G1: "
                             "InitialState'))"));
}

TEST_F(workbench_access, a_file_without_a_sampling_time_is_answered_for_who_asks) {
    std::string text = "a,u,y\n";
    for (int k = 0; k < 50; ++k)
        text += std::to_string(k * k % 11) + "," + std::to_string(k % 7) + "," + std::to_string(k % 5) + "\n";
    write("plain.csv", text);
    const auto program = app("plain.csv");
    Browser browser;
    browser.open(program->address());
    EXPECT_TRUE(says(browser, "enter the sampling time below"));
    EXPECT_FALSE(browser.becomes_true("document.body.innerText.includes('--Ts')", 0.1));
    ASSERT_TRUE(press(browser, "Use these data"));
    EXPECT_TRUE(says(browser, "enter the sampling time below"));
    const Workbench shell;
    shell.write("plain.csv", text);
    const ChildResult reported =
        shell.dynlab({"identify", "plain.csv", "--input", "u", "--output", "y", "--poles", "2"});
    EXPECT_THAT(reported.error_output, HasSubstr("give --Ts SECONDS or --time NAME"));
}

}  // namespace test_workbench_access
