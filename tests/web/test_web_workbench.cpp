// The workbench of a site, with its session in the engine of the page. Oracles: the native program on the script and
// the files that the page makes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/browser.h"
#include "support/workbench.h"
#include "web/web_engine.h"

namespace dynlab::test {
namespace test_web_workbench {
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Collects what the page would save as files: {name, text}.
constexpr char kCatchFiles[] =
    "window.saved = []; const url = URL.createObjectURL, click = HTMLAnchorElement.prototype.click; let blob;"
    "URL.createObjectURL = (what) => url.call(URL, blob = what);"
    "HTMLAnchorElement.prototype.click = function () { if (!this.download) return click.call(this); const name = "
    "this.download; blob.text().then((text) => window.saved.push({ name, text })); };";

class web_workbench : public workbench_page {
  protected:
    static TestSite& site() {
        static TestSite the_one;
        return the_one;
    }
    void SetUp() override {
        SKIP_WITHOUT_WEB_ENGINE();
        browser = std::make_unique<Browser>();
        open_page();
    }
    void open_page() {
        browser->open(site().address("workbench/index.html"));
        ASSERT_TRUE(browser->becomes_true("document.querySelector('.CodeMirror')"));
        ASSERT_TRUE(is_ready(*browser));
    }
    /// The data of write_data_set(), as if its file was dropped on the page.
    void drop_data() {
        write_data_set();
        browser->evaluate(
            "const data = new DataTransfer(); data.items.add(new File([" + json(text_of("plant.csv")).dump() +
            "], 'plant.csv')); document.body.dispatchEvent(new DragEvent('drop', {dataTransfer: data, bubbles: true, "
            "cancelable: true}))");
        ASSERT_TRUE(press(*browser, "Use these data"));
        ASSERT_TRUE(view_appears(*browser, "record"));
        ASSERT_TRUE(is_ready(*browser));
    }
    std::string script() {
        return json::parse(browser->evaluate("return document.querySelector('.CodeMirror').CodeMirror.getValue()"));
    }
    void append(const std::string& text) {
        browser->evaluate("const mirror = document.querySelector('.CodeMirror').CodeMirror; mirror.replaceRange(" +
                          json(text).dump() + ", { line: mirror.lineCount(), ch: 0 })");
    }
    json saved_file() {
        EXPECT_TRUE(browser->becomes_true("window.saved.length"));
        return json::parse(browser->evaluate("return window.saved[0] ?? {}"));
    }
    std::unique_ptr<Browser> browser;
};

TEST_F(web_workbench, dropped_data_become_a_model_that_the_native_program_confirms) {
    drop_data();
    ASSERT_TRUE(press(*browser, "New model"));
    ASSERT_TRUE(script_has(*browser, "\nG1 = "));
    ASSERT_TRUE(is_ready(*browser));
    ASSERT_TRUE(view_appears(*browser, "step"));
    const std::string shown =
        json::parse(browser->evaluate("return [...document.querySelectorAll('table tr')].find((row) => "
                                      "row.textContent.includes('tfsrivc')).innerText"));
    write("session.lua", script() + "\n-- %% id=seen\nprint(string.format(\"native: %.1f\", fit(validation, G1)))\n");
    const ChildResult native = site().bench().shell("cd " + folder.path().string() + " && $DYNLAB run session.lua");
    ASSERT_EQ(native.exit_code, 0) << native.error_output;
    const std::size_t line = native.output.find("native: ");
    ASSERT_NE(line, std::string::npos) << native.output;
    const std::string fit = native.output.substr(line + 8, 4);
    EXPECT_THAT(shown, HasSubstr(fit));
}

TEST_F(web_workbench, script_data_and_history_are_there_after_a_reload) {
    drop_data();
    const std::string before = script();
    ASSERT_TRUE(press(*browser, "New model"));
    ASSERT_TRUE(script_has(*browser, "\nG1 = "));
    ASSERT_TRUE(is_ready(*browser));
    open_page();
    ASSERT_TRUE(view_appears(*browser, "step"));
    EXPECT_THAT(script(), HasSubstr("\nG1 = "));
    ASSERT_TRUE(press(*browser, "Undo"));
    EXPECT_TRUE(browser->becomes_true("document.querySelector('.CodeMirror').CodeMirror.getValue() === " +
                                      json(before).dump()));
}

TEST_F(web_workbench, stop_ends_an_endless_cell_and_the_work_goes_on) {
    drop_data();
    const std::string before = script();
    append("\n-- %% id=loop\nwhile true do end\n");
    ASSERT_TRUE(browser->becomes_true("!document.getElementById('stop').hidden"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    browser->click("#stop");
    EXPECT_TRUE(says(*browser, "stopped; the results before the stop are shown"));
    EXPECT_TRUE(view_appears(*browser, "record"));
    EXPECT_THAT(script(), HasSubstr("while true")) << "nothing that was typed is lost";
    ASSERT_TRUE(press(*browser, "Undo"));
    ASSERT_TRUE(is_ready(*browser));
    EXPECT_EQ(script(), before);
    ASSERT_TRUE(press(*browser, "New model"));
    ASSERT_TRUE(script_has(*browser, "\nG1 = "));
    EXPECT_TRUE(view_appears(*browser, "step"));
}

TEST_F(web_workbench, report_button_saves_a_script_that_makes_the_report) {
    drop_data();
    ASSERT_TRUE(press(*browser, "New model"));
    ASSERT_TRUE(script_has(*browser, "\nG1 = "));
    ASSERT_TRUE(is_ready(*browser));
    browser->evaluate(kCatchFiles);
    ASSERT_TRUE(press(*browser, "Report (script)"));
    const json file = saved_file();
    EXPECT_EQ(file.value("name", ""), "session.lua");
    write("session.lua", file.value("text", ""));
    const ChildResult made =
        site().bench().shell("cd " + folder.path().string() + " && $DYNLAB report session.lua -o session.html");
    EXPECT_EQ(made.exit_code, 0) << made.error_output;
    EXPECT_THAT(text_of("session.html"), HasSubstr("Models"));
}

TEST_F(web_workbench, file_that_is_no_data_is_refused_in_a_sentence) {
    browser->evaluate(
        "const data = new DataTransfer(); data.items.add(new File(['no numbers'], 'notes.csv')); document.body"
        ".dispatchEvent(new DragEvent('drop', {dataTransfer: data, bubbles: true, cancelable: true}))");
    EXPECT_TRUE(says(*browser, "notes.csv"));
    EXPECT_THAT(script(), Not(HasSubstr("notes")));
}

TEST_F(web_workbench, new_session_deletes_the_old_one) {
    drop_data();
    browser->evaluate("window.confirm = () => true");
    ASSERT_TRUE(press(*browser, "New session"));
    ASSERT_TRUE(
        browser->becomes_true("document.querySelector('.CodeMirror') && !document.querySelector('.tile canvas')"));
    ASSERT_TRUE(is_ready(*browser));
    EXPECT_THAT(script(), Not(HasSubstr("plant")));
    EXPECT_EQ(browser->evaluate("return import('./work_store.js').then(async ({ storedWork }) => (await "
                                "storedWork('workbench plant.csv')) === undefined)"),
              "true");
}

}  // namespace test_web_workbench
}  // namespace dynlab::test
