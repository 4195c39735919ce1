// `dynlab app` in a browser: every click is a line of the script on disk. Oracles: that script, its results when
// `dynlab run` runs it, and the text of the page.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <thread>

#include "support/program.h"
#include "support/workbench.h"

namespace test_workbench {
using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
using testing::Not;

class workbench : public workbench_page {};

TEST_F(workbench, a_file_that_no_one_has_seen_becomes_a_validated_model_with_its_report) {
    write_data_set();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    EXPECT_THAT(text_of("plant_session.lua"), HasSubstr("iddata("));
    int clicks = 0;
    for (const char* words : {"Split 60 : 40", "+ Level", "New model"}) {
        ASSERT_TRUE(press(browser, words)) << words;
        ++clicks;
        ASSERT_TRUE(is_ready(browser));
    }
    ASSERT_TRUE(view_appears(browser, "compare"));
    ASSERT_TRUE(view_appears(browser, "bode"));
    ASSERT_TRUE(browser.becomes_true("Number(document.querySelectorAll('.models td.number')[4]?.textContent) > 90"));
    ASSERT_TRUE(press(browser, "Report (PDF)"));
    ++clicks;
    EXPECT_LE(clicks, 12);
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('make-pdf').disabled", 60));
    const std::string script = text_of("plant_session.lua");
    EXPECT_THAT(script, HasSubstr("estimation = prepared:range(1, 480)\nvalidation = prepared:range(481, 800)\n"));
    EXPECT_THAT(script, HasSubstr("prepared = detrend(prepared, \"mean\")\n"));
    EXPECT_THAT(script, HasSubstr("-- %% id=G1\nG1 = tfsrivc(estimation, 2, 0)\n"));
}

/// What the page shows is what the script computes.
TEST_F(workbench, numbers_are_those_of_the_script) {
    write_data_set();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(view_appears(browser, "step"));
    ASSERT_TRUE(is_ready(browser));
    const std::string fit = browser.evaluate(
        "return import('./bench_session.js').then(({session}) => session.views.models.rows[0].estimation.fit)");
    write("fit.lua", text_of("plant_session.lua") + "print(string.format(\"fit=%.17g\", fit(estimation, G1)))\n");
    const Workbench shell;
    std::filesystem::copy(file("plant.csv"), shell.path("plant.csv"));
    shell.write("fit.lua", text_of("fit.lua"));
    const ChildResult run = shell.dynlab({"run", "fit.lua"});
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    const std::size_t at = run.output.find("fit=");
    ASSERT_NE(at, std::string::npos) << run.output;
    EXPECT_EQ(std::stod(fit), std::stod(run.output.substr(at + 4)));
}

/// The number in the control of this name; NaN where there is none.
double control(Browser& browser, const std::string& name) {
    return std::stod(
        browser.evaluate("const found = [...document.querySelectorAll('#steps label')].find((one) => "
                         "one.textContent.trim().startsWith('" +
                         name +
                         "'))?.querySelector('input'); "
                         "return found ? Number(found.value) : 'NaN'"));
}
/// Drags the slider of this name to some places and releases it.
void drag(Browser& browser, const std::string& name, const std::string& places) {
    browser.evaluate("return (async () => { for (const at of [" + places +
                     "]) { const slider = [...document.querySelectorAll('#steps label')].find((one) => "
                     "one.textContent.trim().startsWith('" +
                     name +
                     "')).querySelector('input[type=range]'); slider.value = at; "
                     "slider.dispatchEvent(new Event('input')); await new Promise((yes) => setTimeout(yes, 60)); "
                     "window.lastSlider = slider; } "
                     "window.lastSlider.dispatchEvent(new Event('change')); })()");
}

const std::string kSession =
    "-- ---\n-- title: By hand\n-- ---\n\n-- %% id=record\nlocal u = prbs(7, 8)\nlocal y = lsim(tf({2}, {1, 4, 3}), u, "
    "0.05)\n"
    "for k = 1, #y do y[k] = y[k] + 0.02*randn() end  -- a loop is left alone\ndata = iddata(y, u, 0.05)\n\n"
    "-- %% id=G1\nG1 = srivc(data, {1, 2, 0}, {lambda = 3}) -- a remark\n";

TEST_F(workbench, a_script_written_by_hand_is_shown_and_the_rest_of_it_left_alone) {
    write("mine.lua", kSession);
    const auto program = app("mine.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "compare"));
    ASSERT_TRUE(is_ready(browser));
    EXPECT_EQ(control(browser, "lambda"), 3);
    EXPECT_EQ(text_of("mine.lua"), kSession) << "opening changes nothing";
    drag(browser, "lambda", "0.1, 0.2, 0.3");
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('undo').disabled"));
    ASSERT_TRUE(script_has(browser, "{lambda = 8.32})"));
    ASSERT_TRUE(is_ready(browser));
    std::string expected = kSession;
    expected.replace(expected.find("G1 = srivc"),
                     std::string("G1 = srivc(data, {1, 2, 0}, {lambda = 3}) -- a remark").size(),
                     "G1 = srivc(data, {1, 2, 0}, {lambda = 8.32}) -- a remark");
    for (int i = 0; i < 500 && text_of("mine.lua") == kSession; ++i)  // the file changes after the release
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(text_of("mine.lua"), expected);
    ASSERT_TRUE(press(browser, "Undo"));
    ASSERT_TRUE(script_has(browser, "{lambda = 3})"));
    EXPECT_EQ(text_of("mine.lua"), kSession) << "a drag is one step of the history";
    ASSERT_TRUE(press(browser, "Redo"));
    ASSERT_TRUE(script_has(browser, "{lambda = 8.32})"));
}

TEST_F(workbench, what_is_typed_moves_the_controls_and_nonsense_keeps_the_last_views) {
    write("mine.lua", kSession);
    const auto program = app("mine.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "compare"));
    browser.evaluate(
        "const m = document.querySelector('.CodeMirror').CodeMirror; m.setValue(m.getValue().replace('lambda = 3', "
        "'lambda = 7'))");
    ASSERT_TRUE(browser.becomes_true(
        "[...document.querySelectorAll('#steps label')].some((one) => "
        "one.textContent.trim().startsWith('lambda') && one.querySelector('input').value === '7')"));
    EXPECT_THAT(text_of("mine.lua"), HasSubstr("lambda = 7"));
    browser.evaluate(
        "const m = document.querySelector('.CodeMirror').CodeMirror; m.setValue(m.getValue().replace('G1 = srivc(', "
        "'G1 = srivc(('))");
    ASSERT_TRUE(browser.becomes_true("document.getElementById('state').textContent === 'stopped at an error'"));
    EXPECT_TRUE(browser.becomes_true("document.getElementById('trouble').textContent.includes('mine.lua:')"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.tile[data-view=record] canvas')"));
    browser.evaluate(
        "const m = document.querySelector('.CodeMirror').CodeMirror; m.setValue(m.getValue().replace('G1 = srivc((', "
        "'G1 = srivc('))");
    EXPECT_TRUE(browser.becomes_true(
        "document.getElementById('state').textContent === 'up to date' && document.getElementById('trouble').hidden"));
}

TEST_F(workbench, an_editor_elsewhere_and_a_second_tab_see_the_same_session) {
    write("mine.lua", kSession);
    const auto program = app("mine.lua", {"--run"});
    Browser browser, other;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "compare"));
    other.open(program->next_address());
    ASSERT_TRUE(view_appears(other, "compare"));
    drag(browser, "lambda", "0.3");
    EXPECT_TRUE(script_has(other, "{lambda = 8.32})"));
    write("mine.lua", kSession + "\n-- %% id=G2\nG2 = srivc(data, {1, 3, 0})\n");
    EXPECT_TRUE(script_has(browser, "G2 = srivc"));
    EXPECT_TRUE(
        browser.becomes_true("[...document.querySelectorAll('.models td')].some((one) => one.textContent === 'G2')"));
    EXPECT_TRUE(
        other.becomes_true("[...document.querySelectorAll('.models td')].some((one) => one.textContent === 'G2')"));
}

TEST_F(workbench, an_untrusted_script_is_shown_and_not_run_before_consent) {
    write("mine.lua", kSession);
    const auto program = app("mine.lua");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(script_has(browser, "srivc"));
    EXPECT_TRUE(says(browser, "Run it?"));
    EXPECT_EQ(browser.evaluate("return document.querySelectorAll('.tile canvas').length"), "0");
    ASSERT_TRUE(press(browser, "Run it"));
    EXPECT_TRUE(view_appears(browser, "compare"));
}

TEST_F(workbench, the_script_is_on_disk_when_the_program_is_killed) {
    write_data_set();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    ASSERT_TRUE(press(browser, "+ Trend"));
    ASSERT_TRUE(script_has(browser, "detrend(prepared, \"linear\")"));
    ::kill(program->process(), SIGKILL);
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').textContent.startsWith('no response')"));
    EXPECT_THAT(text_of("plant_session.lua"), HasSubstr("prepared = detrend(prepared, \"linear\")\n"));
    const auto again = app("plant_session.lua");
    browser.open(again->address());
    EXPECT_TRUE(script_has(browser, "detrend(prepared, \"linear\")"));
}

TEST_F(workbench, steps_of_preparation_are_switched_off_moved_and_removed) {
    write_data_set();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(press(browser, "+ Level"));
    ASSERT_TRUE(script_has(browser, "\"mean\""));
    ASSERT_TRUE(press(browser, "+ Resample"));
    ASSERT_TRUE(script_has(browser, "prepared = detrend(prepared, \"mean\")\nprepared = resample(prepared, 1, 2)\n"));
    ASSERT_TRUE(is_ready(browser));
    ASSERT_TRUE(press(browser, "↑"));
    ASSERT_TRUE(script_has(browser, "prepared = resample(prepared, 1, 2)\nprepared = detrend(prepared, \"mean\")\n"));
    ASSERT_TRUE(is_ready(browser));
    browser.evaluate("document.querySelector('.preparing input[type=checkbox]').click()");
    ASSERT_TRUE(script_has(browser, "-- off: prepared = resample(prepared, 1, 2)\n"));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.preparing li.off')"));
    ASSERT_TRUE(is_ready(browser));
    browser.evaluate(
        "[...document.querySelectorAll('.preparing li.off button')].find((one) => one.textContent === '×').click()");
    EXPECT_TRUE(
        browser.becomes_true("!document.querySelector('.CodeMirror').CodeMirror.getValue().includes('resample')"));
}

TEST_F(workbench, the_map_of_orders_estimates_what_is_clicked) {
    write_data_set();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(press(browser, "+ Level"));
    ASSERT_TRUE(script_has(browser, "\"mean\""));
    ASSERT_TRUE(press(browser, "Search orders"));
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('button.order').length >= 9"));
    browser.evaluate(
        "[...document.querySelectorAll('button.order')].find((one) => one.textContent.includes('★')).click()");
    EXPECT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, ")) << text_of("plant_session.lua");
    EXPECT_TRUE(script_has(browser, ", {TdMax = 0})"));
    EXPECT_TRUE(view_appears(browser, "bode"));
}

TEST_F(workbench, a_step_response_is_read_by_hand_and_estimated_from_there) {
    const auto program = app("heat_exchanger");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "record"));
    browser.evaluate("document.querySelectorAll('#steps details').forEach((one) => { one.open = true; })");
    ASSERT_TRUE(press(browser, "First order"));
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.tile[data-view=reading] .handle').length === 2"));
    const auto gain = [&] {
        const std::string script = text_of("heat_exchanger_session.lua");
        return std::stod(script.substr(script.find(" K = ") + 5));
    };
    const double before = gain();
    EXPECT_NEAR(before, 0.5, 0.05) << "10 degrees for 20 %";
    browser.evaluate(
        "document.querySelector('.tile[data-view=reading] .handle').dispatchEvent(new KeyboardEvent('keydown', {key: "
        "'ArrowUp', bubbles: true}))");
    EXPECT_TRUE(browser.becomes_true("!document.querySelector('.CodeMirror').CodeMirror.getValue().includes('K = " +
                                     std::to_string(before).substr(0, 6) + "')"));
    ASSERT_TRUE(is_ready(browser));
    EXPECT_NEAR(gain(), 1.02 * before, 1e-3 * before);
    ASSERT_TRUE(press(browser, "Estimate from here"));
    EXPECT_TRUE(script_has(browser, "G1 = tfsrivc(estimation, reading1_model, {TdMax = 0})"));
    EXPECT_TRUE(view_appears(browser, "step"));
}

TEST_F(workbench, a_known_system_is_studied_and_the_cloud_has_all_runs_in_the_end) {
    const auto program = app("");
    Browser browser;
    browser.open(program->address());
    browser.evaluate("document.querySelectorAll('#steps details').forEach((one) => { one.open = true; })");
    ASSERT_TRUE(press(browser, "Start study"));
    ASSERT_TRUE(view_appears(browser, "study"));
    ASSERT_TRUE(is_ready(browser));
    const std::string truth = "document.querySelector('.tile[data-view=study] td.number')?.textContent === '4'";
    EXPECT_TRUE(browser.becomes_true(truth)) << "a1 of s^2 + 4 s + 3";
    drag(browser, "noise", "0.1, 0.2");
    EXPECT_TRUE(script_has(browser, "runs = 200"));
    EXPECT_TRUE(
        browser.becomes_true("document.querySelector('.CodeMirror').CodeMirror.getValue().includes('sigma = 0.197')"));
    EXPECT_TRUE(
        browser.becomes_true("document.querySelector('.CodeMirror').CodeMirror.getValue().includes('runs = 200')"));
    ASSERT_TRUE(is_ready(browser));
    EXPECT_THAT(text_of("session.lua"), HasSubstr("runs = 200"));
}

TEST_F(workbench, figures_models_and_data_are_saved) {
    write("mine.lua", kSession);
    const auto program = app("mine.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "compare"));
    const auto saved = [&](const std::string& order, const std::string& beginning) {
        const std::string sent = browser.evaluate(
            "window.given = null; const old = URL.createObjectURL; URL.createObjectURL = (blob) => { window.given = "
            "blob; return old(blob); };"
            "return import('./bench_views.js').then(({save}) => { save(" +
            order +
            "); return new Promise((yes) => { const look = () => "
            "window.given ? window.given.slice(0, 40).text().then(yes) : setTimeout(look, 20); look(); }); })");
        EXPECT_THAT(sent, HasSubstr(beginning)) << order;
    };
    saved("{what: 'figure', view: 'step', format: 'pdf'}", "%PDF-");
    saved("{what: 'figure', view: 'bode', format: 'svg'}", "<?xml");
    saved("{what: 'models', format: 'mat'}", "MATLAB 5.0");
    saved("{what: 'models', format: 'csv'}", "model");
    saved("{what: 'data', name: 'data', format: 'csv'}", "#");
}

TEST_F(workbench, a_file_from_the_desk_and_a_second_record_for_validation) {
    const auto program = app("");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(says(browser, "Drop a data file"));
    const auto drop = [&](const std::string& name) {
        browser.evaluate(
            "let text = 'force (N),speed (m/s)\\n'; let x = 0; for (let k = 0; k < 300; ++k) { const u = k % 40 < 20 ? "
            "1 : -1; x += 0.1*(u - x); text += `${u},${x + 0.01*Math.sin(k*k)}\\n`; }"
            "const data = new DataTransfer(); data.items.add(new File([text], '" +
            name + "')); document.dispatchEvent(new DragEvent('drop', {dataTransfer: data, bubbles: true}))");
    };
    drop("desk.csv");
    ASSERT_TRUE(says(browser, "force"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.role .chip b').textContent === 'force'"))
        << "it sounds like an input";
    ASSERT_TRUE(press(browser, "Use these data"));
    EXPECT_TRUE(says(browser, "sampling time")) << "the file states none, which is told";
    browser.evaluate(
        "const box = document.querySelector('#steps input[type=number]'); box.value = '0.1'; box.dispatchEvent(new "
        "Event('input'))");
    ASSERT_TRUE(press(browser, "Use these data"));
    ASSERT_TRUE(view_appears(browser, "record"));
    drop("second.csv");
    ASSERT_TRUE(says(browser, "second.csv"));
    browser.evaluate(
        "const box = document.querySelector('#steps input[type=number]'); box.value = '0.1'; box.dispatchEvent(new "
        "Event('input'))");
    ASSERT_TRUE(press(browser, "Use for validation only"));
    EXPECT_TRUE(script_has(browser, "validation = second1"));
    ASSERT_TRUE(is_ready(browser));
    EXPECT_THAT(text_of("session.lua"), HasSubstr("load(\"second.csv\")"));
}

TEST_F(workbench, files_that_are_no_records_are_reported_and_the_page_stays) {
    struct Bad {
        const char *name, *text, *says;
    };
    const Bad all[] = {{"words.csv", "a,b\nx,y\nz,w\n", "must contain at least two signals"},
                       {"one.csv", "y\n1\n2\n3\n4\n", "must contain at least two signals"},
                       {"back.csv", "t,u,y\n0,1,2\n1,1,3\n0.5,0,4\n2,0,5\n", "must increase"},
                       {"flat.csv", "# Ts: 0.1\nu,y\n1,2\n1,2\n1,2\n1,2\n", "constant"},
                       {"two.csv", "# Ts: 0.1\nu,y\n1,2\n0,3\n", "advice (2)"}};
    for (const Bad& bad : all) {
        write(bad.name, bad.text);
        const auto program = app(bad.name);
        Browser browser;
        browser.open(program->address());
        EXPECT_TRUE(browser.becomes_true("document.getElementById('name').textContent !== ''")) << bad.name;
        EXPECT_TRUE(browser.becomes_true("!['', 'computing'].includes(document.getElementById('state').textContent)"))
            << bad.name;
        EXPECT_TRUE(
            browser.becomes_true("document.body.innerText.toLowerCase().includes('" + std::string(bad.says) + "')", 5))
            << bad.name << ": "
            << browser.evaluate(
                   "return document.getElementById('trouble').textContent + ' | ' + "
                   "document.getElementById('steps').innerText.slice(0, 600)");
    }
    write("empty.csv", "");
    const auto refused = app("empty.csv");
    EXPECT_EQ(refused->address(), "");
    std::string wide = "# Ts: 0.1\n";
    for (int k = 0; k < 50; ++k) wide += (k ? ",c" : "c") + std::to_string(k);
    wide += "\n";
    for (int i = 0; i < 60; ++i) {
        for (int k = 0; k < 50; ++k) wide += (k ? "," : "") + std::to_string((i * (k + 3)) % 7);
        wide += "\n";
    }
    write("wide.csv", wide);
    const auto program = app("wide.csv");
    Browser browser;
    browser.open(program->address());
    EXPECT_TRUE(view_appears(browser, "record")) << "the first and the last of 50 columns";
}

TEST_F(workbench, speaks_french_where_the_script_does) {
    std::string french = kSession;
    french.replace(0, 6, "-- ---\n-- language: fr");
    write("mine.lua", french);
    const auto program = app("mine.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_appears(browser, "compare"));
    EXPECT_TRUE(says(browser, "Estimation et validation"));
    EXPECT_TRUE(
        browser.becomes_true("/^\\d+,\\d+$/.test(document.querySelectorAll('.models td.number')[4]?.textContent)"));
    EXPECT_EQ(browser.evaluate("return document.documentElement.lang"), "\"fr\"");
    const std::string reported =
        "[...document.querySelectorAll('.told, .advice p, .chosen p')].map((one) => one.textContent).join(' ')";
    for (const char* words : {"adéquation de", "L'erreur de sortie", "est assez riche pour des modèles à",
                              "SRIVC a convergé en", "blanc en sortie"})
        EXPECT_TRUE(browser.becomes_true(reported + ".includes(`" + words + "`)"))
            << words << "\n"
            << browser.evaluate("return " + reported);
    const std::string said = browser.evaluate("return " + reported);
    EXPECT_FALSE(std::regex_search(said, std::regex("\\b(the|is|of|error|with|samples|fit)\\b"))) << said;
    write("mine.lua", french + "\nprint(yy)\n");
    EXPECT_TRUE(says(browser, "fonction ou variable inconnue"));
}

TEST_F(workbench, a_long_call_is_stopped_and_the_session_goes_on) {
    write("mine.lua", kSession + "\n-- %% id=long\nlocal n = 0\nwhile true do n = n + 1 end\n");
    const auto program = app("mine.lua", {"--run"});
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(press(browser, "Stop"));
    ASSERT_TRUE(browser.becomes_true("document.getElementById('state').textContent.startsWith('stopped;')"));
    EXPECT_TRUE(view_appears(browser, "compare")) << "what was computed before is looked at";
    ASSERT_TRUE(press(browser, "Run again"));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('stop').hidden"));
    write("mine.lua", kSession);
    EXPECT_TRUE(browser.becomes_true("document.getElementById('state').textContent === 'up to date'"));
}

}  // namespace test_workbench
