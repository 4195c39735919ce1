// `dynlab app` in a browser: every click is a line of the script on disk. Oracle: that script, what it gives when it is
// run by itself, and what the page says.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "support/program.h"
#include "support/workbench.h"

namespace test_workbench {
using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
using testing::Not;

class workbench : public workbench_page {
  protected:
    /// A second-order plant with noise, as a stranger's CSV file.
    void write_record(const std::string& name = "plant.csv") const {
        std::ofstream out(file(name));
        out << "time (s),valve (%),level (cm)\n";
        double x = 0, v = 0;
        for (int k = 0; k < 800; ++k) {
            const double u = (k / 37 + k / 59) % 2 == 0 ? 1 : -1, noise = 0.02 * std::sin(12.9898 * k * k);
            out << 0.1 * k << ',' << 50 + 10 * u << ',' << 20 + 5 * x + noise << '\n';
            for (int i = 0; i < 20; ++i) {
                v += 0.005 * (2 * u - 3 * x - 2 * v);
                x += 0.005 * v;
            }
        }
    }
};

TEST_F(workbench, a_file_that_nobody_has_seen_becomes_a_validated_model_with_its_report) {
    write_record();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(view_comes(browser, "record"));
    EXPECT_THAT(text_of("plant_session.lua"), HasSubstr("iddata("));
    int clicks = 0;
    for (const char* words : {"Divide 60 : 40", "+ Level", "New model"}) {
        ASSERT_TRUE(press(browser, words)) << words;
        ++clicks;
        ASSERT_TRUE(is_ready(browser));
    }
    ASSERT_TRUE(view_comes(browser, "compare"));
    ASSERT_TRUE(view_comes(browser, "bode"));
    ASSERT_TRUE(browser.comes("Number(document.querySelectorAll('.models td.number')[4]?.textContent) > 90"));
    ASSERT_TRUE(press(browser, "Report (PDF)"));
    ++clicks;
    EXPECT_LE(clicks, 12);
    EXPECT_TRUE(browser.comes("!document.getElementById('make-pdf').disabled", 60));
    const std::string script = text_of("plant_session.lua");
    EXPECT_THAT(script, HasSubstr("estimation = prepared:range(1, 480)\nvalidation = prepared:range(481, 800)\n"));
    EXPECT_THAT(script, HasSubstr("prepared = detrend(prepared, \"mean\")\n"));
    EXPECT_THAT(script, HasSubstr("-- %% id=G1\nG1 = tfsrivc(estimation, 2, 0)\n"));
}

/// What the page shows is what the script computes.
TEST_F(workbench, numbers_are_those_of_the_script) {
    write_record();
    const auto program = app("plant.csv");
    Browser browser;
    browser.open(program->address());
    ASSERT_TRUE(press(browser, "New model"));
    ASSERT_TRUE(view_comes(browser, "step"));
    ASSERT_TRUE(is_ready(browser));
    const std::string fit = browser.evaluate(
        "return import('/bench_session.js').then(({session}) => session.views.models.rows[0].estimation.fit)");
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

}  // namespace test_workbench
