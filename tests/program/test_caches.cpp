// The caches as users of the program meet them: between its programs, at the same time, on a terminal. Oracles: the
// counts that --timings prints, and equality of the documents' bytes. What is cached:
// tests/unit/workflow/test_report_memory.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/terminal.h"

namespace dynlab::test {
namespace test_caches {
using testing::HasSubstr;

const std::string kHeader = "-- ---\n-- title: A\n-- ---\n";
const std::string kStudy =
    "-- %% id=study\nlocal s = tf('s')\n"
    "local M = montecarlo{system = 2/(s^2 + 4*s + 3), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 300,\n"
    "                     estimators = {srivc = {{1, 2, 0}}}}\nprint(M)\nM:histograms()\n";
const std::string kLate = "-- %% id=late\nplot({1, 2}, {3, 4})\nprint('late')\n";

class caches : public testing::Test {
  protected:
    /// Weaves a script of these cells and returns the timings.
    std::string weave(const std::string& cells, const std::string& output = "a.html") {
        bench_.write("a.lua", kHeader + cells);
        const ChildResult made = bench_.dynlab({"weave", "a.lua", "-o", output, "--timings"});
        EXPECT_EQ(made.exit_code, 0) << made.error_output;
        return made.output;
    }
    Workbench bench_;
};

std::string calls(int computed, int from_cache) {
    return " " + std::to_string(computed) + "  long calls computed, " + std::to_string(from_cache) +
           " from the cache\n";
}
TEST_F(caches, what_one_of_dynlabs_programs_computed_the_others_recall) {
    bench_.write("a.lua", kHeader + kStudy);
    const auto weave_by = [&](const std::string& program) {
        return bench_.shell(program + " weave a.lua -o a.html --timings").output;
    };
    EXPECT_THAT(weave_by("$DYNLAB"), HasSubstr("run the script"));
    EXPECT_THAT(weave_by("$DYNLAB-course"), HasSubstr("a.html (up to date)"));
}

// In a portable build, the loader selects the library for this processor. Another library makes another program. Here,
// any library with the same file name serves as the other one.
TEST_F(caches, another_variant_of_the_programs_library_has_no_cache_hits) {
    bench_.write("a.lua", kHeader + kStudy);
    const auto weave_with = [&](const std::string& environment) {
        return bench_.shell(environment + " $DYNLAB weave a.lua -o a.md --timings").output;
    };
    EXPECT_THAT(weave_with(""), HasSubstr(calls(1, 0)));
    ASSERT_EQ(
        bench_.shell("rm a.md; cp $(ldconfig -p | sed -n 's/.*libz.so.1 .*=> //p' | head -n 1) libdynlab_numerics.so")
            .exit_code,
        0);
    EXPECT_THAT(weave_with("LD_PRELOAD=$PWD/libdynlab_numerics.so"), HasSubstr(calls(1, 0)));
    ASSERT_EQ(bench_.shell("rm a.md").exit_code, 0);
    EXPECT_THAT(weave_with("LD_PRELOAD=$PWD/libdynlab_numerics.so"), HasSubstr("recall the run"));
}

TEST_F(caches, two_runs_at_once_give_the_same_document) {
    bench_.write("a.lua", kHeader + kStudy + kLate);
    const ChildResult both = bench_.shell(
        "\"$DYNLAB\" weave a.lua -o 1.html & one=$!; \"$DYNLAB\" weave a.lua -o 2.html & other=$!; "
        "wait $one && wait $other && cmp 1.html 2.html");
    EXPECT_EQ(both.exit_code, 0) << both.output << both.error_output;
    EXPECT_THAT(weave(kStudy + kLate + "print(1)\n"), HasSubstr(calls(0, 1)));
}

TEST_F(caches, serve_run_too) {
    const std::string code = "print(plant('crane', {seed = 7}).estimation.x[100])";
    const std::string first = bench_.dynlab({"run", "-e", code}).output;
    EXPECT_EQ(bench_.shell("ls ../cache/dynlab/calls | wc -l").output, "1\n");
    EXPECT_EQ(bench_.dynlab({"run", "-e", code}).output, first);
    EXPECT_EQ(bench_.shell("ls ../cache/dynlab/calls | wc -l").output, "1\n");
}

// ---- where a run is

TEST_F(caches, timings_distinguish_cells_figures_and_documents) {
    const std::string reported = weave(kStudy + kLate, "a.pdf");
    for (const char* step : {" ms  run the script\n", " ms    cell study\n", " ms  pandoc\n", " ms  figures\n",
                             " ms  latex pass 1\n", " ms  in total\n"})
        EXPECT_THAT(reported, HasSubstr(step));
}

TEST_F(caches, a_terminal_shows_a_cell_that_takes_long_and_its_bar) {
    std::string study = kStudy;
    study.replace(study.find("300"), 3, "1000000");
    bench_.write("a.lua", kHeader + "-- %%\nprint(1)\n" + study);
    for (const auto& [arguments, times] :
         {std::pair(std::vector<std::string>{"weave", "a.lua", "-o", "a.html"}, 2), {{"run", "a.lua"}, 1}}) {
        Terminal terminal(bench_, arguments);
        int last = 0;
        for (int time = 1; time <= times; ++time) {  // a busy machine shows the bar later than in the first second
            int second = 0;
            while (second <= last) {
                const std::string shown = terminal.until(" s  Monte Carlo  [");
                const std::size_t line = shown.rfind("cell 2 of 2, study  ");
                ASSERT_NE(line, std::string::npos) << shown;
                second = std::stoi(shown.substr(line + 20));
            }
            last = second;
        }
        terminal.type(kControlC);
        EXPECT_THAT(terminal.until("interrupted"), HasSubstr("\r\x1b[Kdynlab: "));
        EXPECT_EQ(terminal.wait_for_end(), 130);
    }
    EXPECT_EQ(bench_.shell("ls ../cache/dynlab/calls | wc -l").output, "0\n") << "half a result was kept";
}

TEST_F(caches, a_loop_of_the_script_shows_its_cell_too) {
    bench_.write("a.lua", kHeader + "-- %% [markdown]\n-- # The loop\n-- %%\nwhile true do end\n-- %%\nprint(1)\n");
    Terminal terminal(bench_, {"weave", "a.lua", "-o", "a.html"});
    terminal.until("running the script ...");
    terminal.until("cell 1 of 2, The loop  1 s");
    terminal.type(kControlC);
    EXPECT_EQ(terminal.wait_for_end(), 130);
}

}  // namespace test_caches
}  // namespace dynlab::test
