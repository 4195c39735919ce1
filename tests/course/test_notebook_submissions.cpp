// Submitted notebooks are processed as scripts are. Oracles: the same work submitted as a script, and the names that
// must not be passed on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "course/grading_bench.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::test {
namespace test_notebook_submissions {
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAnswers = "--   gain: number\n";
constexpr const char* kChecks =
    "check{id = 'gain', points = 2, test = function(a) return near(a.gain, 2, {rel = 0.01}) end}\n";
constexpr const char* kName = "Ada Lovelace";

/// With a name wherever Jupyter may put one.
std::string notebook_by(const std::string& script) {
    json notebook = json::parse(notebook_of(parse_percent_script(script, "analysis.lua")));
    notebook["metadata"]["authors"] = {{{"name", kName}}};
    notebook["metadata"]["kernelspec"]["path"] = std::string("/home/") + kName;
    json& cell = notebook["cells"].back();
    cell["metadata"]["author"] = kName;
    cell["outputs"] = {{{"output_type", "stream"}, {"name", "stdout"}, {"text", kName}}};
    return notebook.dump();
}

TEST(notebook_submissions, are_graded_compared_and_reported_by_cells) {
    const std::string good = GradingBench::header(kAnswers) + "\n-- %%\nanswer(\"gain\", 2)\n",
                      bad = GradingBench::header(kAnswers) + "\n-- %%\nlocal x = 1\nprint(x + nil)\n";
    GradingBench bench(kAnswers, kChecks, "answer(\"gain\", 2)\n");
    bench.submit_file("script", good);
    bench.bench().write("in/notebook/analysis.ipynb", notebook_by(good));
    bench.bench().write("in/stopped/analysis.ipynb", notebook_by(bad));
    bench.bench().write("in/newer/analysis.lua", bad);
    bench.bench().write("in/newer/analysis.ipynb", notebook_by(good));
    bench.bench().shell("touch -d '2026-01-01 10:00' in/newer/analysis.lua in/both/* 2>/dev/null");
    bench.bench().write("in/both/analysis.lua", bad);
    bench.bench().write("in/both/analysis.ipynb", notebook_by(good));
    bench.bench().shell("touch -d '2026-01-01 10:00' in/both/*");
    bench.bench().write("in/broken/analysis.ipynb", "{\"cells\": [");
    bench.bench().write("in/named/mine.ipynb", notebook_by(good));
    const ChildResult graded = bench.grade();
    EXPECT_EQ(GradingBench::score(bench.result("script")), 2) << graded.error_output;
    EXPECT_EQ(GradingBench::score(bench.result("notebook")), 2);
    EXPECT_EQ(GradingBench::score(bench.result("newer")), 2);
    EXPECT_THAT(bench.result("stopped").dump(),
                AllOf(HasSubstr("analysis.ipynb, cell 2, line 2: "), Not(HasSubstr(".lua:"))));
    EXPECT_THAT(GradingBench::error_reason(bench.result("both")),
                HasSubstr("dynlab cannot determine which file is newer"));
    EXPECT_THAT(GradingBench::error_reason(bench.result("broken")),
                HasSubstr("analysis.ipynb cannot be read: the file is not a Jupyter"));
    EXPECT_THAT(GradingBench::error_reason(bench.result("named")), HasSubstr("under the name analysis.ipynb"));
    EXPECT_EQ(bench.bench().shell(std::string("grep -rl --exclude-dir=files '") + kName + "' out").output, "");
    const ChildResult similar = bench.bench().dynlab({"similar", "in", "--lesson", "99", "--out", "alike"});
    EXPECT_THAT(similar.output + similar.error_output,
                AllOf(HasSubstr("\"broken\""), HasSubstr("\"named\""), Not(HasSubstr("\"notebook\"")),
                      Not(HasSubstr("\"stopped\""))));
}

TEST(notebook_submissions, are_packed_and_checked_as_scripts_without_names) {
    const Workbench bench;
    const std::string script =
        "-- ---\n-- title: T\n-- ---\n\n-- %% [markdown]\n-- # Words\n\n-- %%\nprint(1)\nprint(1 + nil)\n";
    bench.write("w/analysis.ipynb", notebook_by(script));
    bench.write("w/report.md", "---\ntitle: T\n---\n");
    EXPECT_EQ(bench.dynlab({"pack", "w"}).exit_code, 0);
    EXPECT_EQ(bench.shell("unzip -p w.zip analysis.lua").output, script);
    EXPECT_EQ(bench.shell("unzip -l w.zip | grep -c ipynb; unzip -p w.zip | grep -c Lovelace").output, "0\n0\n");
    for (const char* subject : {"w", "w/analysis.ipynb"})
        EXPECT_THAT(bench.dynlab({"check", subject, "--document-only"}).output,
                    AllOf(HasSubstr("analysis.ipynb, cell 3, line 2"), Not(HasSubstr("analysis.lua:"))))
            << subject;
    const std::string french = "-- ---\n-- title: T\n-- language: fr\n-- ---\n\n-- %%\nprint(1)\nprint(1 + nil)\n";
    bench.write("f/analysis.ipynb", notebook_by(french));
    bench.write("f/report.md", "---\ntitle: T\nlang: fr\n---\n");
    EXPECT_THAT(bench.dynlab({"check", "f", "--document-only"}).output,
                HasSubstr("analysis.ipynb, cellule 2, ligne 2"));
    bench.write("w/analysis.ipynb", "[]");
    EXPECT_THAT(bench.dynlab({"check", "w"}).output, HasSubstr("cannot be read: the file is JSON, but not a Jupyter"));
    const ChildResult pack = bench.dynlab({"pack", "w"});
    EXPECT_EQ(pack.exit_code, 1);
    EXPECT_THAT(pack.error_output, HasSubstr("not a Jupyter notebook"));
}

}  // namespace test_notebook_submissions
}  // namespace dynlab::test
