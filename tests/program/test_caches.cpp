// What a run leaves for the next one: results of long calls and drawn figures. Oracles: the counts of what was computed
// and drawn, and equality of the documents' bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/terminal.h"

namespace dynlab::test {
namespace test_caches {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kHeader = "-- ---\n-- title: A\n-- ---\n";
const std::string kStudy =
    "-- %% id=study\nlocal s = tf('s')\n"
    "local M = montecarlo{system = 2/(s^2 + 4*s + 3), input = prbs(4, 100), Ts = 0.01, sigma = 0.2, runs = 300,\n"
    "                     estimators = {srivc = {{1, 2, 0}}}}\nprint(M)\nM:histograms()\n";
const std::string kSearch =
    "-- %% id=search\nlocal r = load('d.csv')\nlocal data = iddata(r.y, r.u, 0.01)\n"
    "print(srivcstruc(data, {poles = {1, 4}, zeros = {0, 3}}))\nlocal Td, fig = delayest(data)\n";
const std::string kLate = "-- %% id=late\nplot({1, 2}, {3, 4})\nprint('late')\n";

class caches : public testing::Test {
  protected:
    caches() { make_data(1); }
    void make_data(int seed) {
        bench_.write("make.lua", "local s = tf('s') local u = prbs(4, 100) rng(" + std::to_string(seed) +
                                     ") local y = lsim(2/(s^2 + 4*s + 3), u, 0.01) + 0.2*randn(#u)\n"
                                     "save_csv('d.csv', {u = u, y = y})\n");
        const ChildResult made = bench_.dynlab({"run", "make.lua"});
        ASSERT_EQ(made.exit_code, 0) << made.error_output;
    }
    /// Weaves a script of these cells and returns the timings.
    std::string weave(const std::string& cells, const std::string& output = "a.html") {
        bench_.write("a.lua", kHeader + cells);
        const ChildResult made = bench_.dynlab({"weave", "a.lua", "-o", output, "--timings"});
        EXPECT_EQ(made.exit_code, 0) << made.error_output;
        return made.output;
    }
    Workbench bench_;
};

std::string calls(int computed, int recalled) {
    return " " + std::to_string(computed) + "  long calls computed, " + std::to_string(recalled) + " recalled\n";
}
std::string figures(int drawn, int recalled) {
    return " " + std::to_string(drawn) + "  figures drawn, " + std::to_string(recalled) + " recalled\n";
}

TEST_F(caches, what_one_of_dynlabs_programs_computed_the_others_recall) {
    bench_.write("a.lua", kHeader + kStudy);
    const auto weave_by = [&](const std::string& program) {
        return bench_.shell(program + " weave a.lua -o a.html --timings").output;
    };
    EXPECT_THAT(weave_by("$DYNLAB"), HasSubstr("run the script"));
    EXPECT_THAT(weave_by("$DYNLAB-pages"), HasSubstr("a.html (up to date)"));
}

// Of a portable build, the loader takes the library for this processor; another one is another program. Any library
// under its name stands for that here.
TEST_F(caches, another_variant_of_the_programs_library_recalls_nothing) {
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

TEST_F(caches, a_changed_late_cell_computes_and_draws_nothing_else) {
    EXPECT_THAT(weave(kStudy + kSearch + kLate), AllOf(HasSubstr(calls(3, 0)), HasSubstr(figures(3, 0))));
    const std::string changed = kStudy + kSearch + "-- %% id=late\nplot({1, 2}, {3, 5})\nprint('later')\n";
    EXPECT_THAT(weave(changed), AllOf(HasSubstr(calls(0, 3)), HasSubstr(figures(1, 2))));
    const std::string recalled = bench_.read("a.html");
    ASSERT_EQ(bench_.shell("rm -r ../cache/dynlab a.html").exit_code, 0);
    EXPECT_THAT(weave(changed), AllOf(HasSubstr(calls(3, 0)), HasSubstr(figures(3, 0))));
    EXPECT_TRUE(recalled == bench_.read("a.html")) << "a recalled result is not the computed one";
}

TEST_F(caches, a_changed_data_file_computes_and_draws_what_depends_on_it) {
    weave(kStudy + kSearch + kLate);
    make_data(2);
    EXPECT_THAT(weave(kStudy + kSearch + kLate), AllOf(HasSubstr(calls(2, 1)), HasSubstr(figures(1, 2))));
}

/// A number set for a slider is part of what a document was made from.
TEST_F(caches, a_slider_that_is_set_makes_another_document) {
    bench_.write("a.lua", kHeader + "-- %% id=a\nprint(\"k is \" .. slider(\"k\", 3, 1, 10))\n");
    const auto weave_with = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words = {"weave", "a.lua", "-o", "a.html"};
        words.insert(words.end(), options.begin(), options.end());
        const ChildResult made = bench_.dynlab(words);
        EXPECT_EQ(made.exit_code, 0) << made.error_output;
        return bench_.read("a.html");
    };
    EXPECT_THAT(weave_with({}), HasSubstr("k is 3"));
    EXPECT_THAT(weave_with({"--set", "k=4"}), HasSubstr("k is 4"));
    EXPECT_THAT(weave_with({}), HasSubstr("k is 3"));
    EXPECT_THAT(bench_.dynlab({"run", "a.lua", "--set", "k=5"}).output, HasSubstr("k is 5"));
    const ChildResult wrong = bench_.dynlab({"run", "a.lua", "--set", "kk=5"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.error_output, HasSubstr("a.lua has no slider \"kk\"; it has k"));
    EXPECT_EQ(bench_.dynlab({"run", "a.lua", "--set", "k=much"}).exit_code, 2);
}

/// What another place of a slider reads is part of what its page was made from.
TEST_F(caches, data_of_another_place_of_a_slider_make_another_page) {
    for (const char* name : {"run1.csv", "run2.csv"}) bench_.write(name, "t,u,y\n0,1,5\n1,1,6\n");
    const std::string cells =
        "-- %% id=a\nlocal d = load(\"run\" .. slider(\"k\", 1, 1, 2, {step = 1}) .. \".csv\")\nprint(\"first\", "
        "d.y[1])\n";
    weave(cells);
    const std::string before = bench_.read("a.html");
    weave(cells);
    EXPECT_TRUE(before == bench_.read("a.html"));
    bench_.write("run2.csv", "t,u,y\n0,1,77\n1,1,6\n");
    weave(cells);
    EXPECT_THAT(bench_.read("a.html"), HasSubstr("77"));
}

/// Every combination of a cell's sliders goes on from what ran before it, random numbers among that.
TEST_F(caches, places_of_sliders_go_on_from_the_same_state) {
    weave(
        "-- %% id=a\nlocal before = rand()\nprint(string.format(\"once %.9f\", before))\n-- %% id=b\nlocal k, l = "
        "slider(\"k\", 1, 1, 2, {step = 1}), slider(\"l\", 10, 10, 30, {step = 10})\n-- %% id=c\n"
        "print(string.format(\"%d times %.9f then %.9f\", k*l, before, rand()))\nbefore = 0\n");
    const std::string page = bench_.read("a.html");
    const auto behind = [&](const std::string& words) {
        const auto at = page.find(words);
        EXPECT_NE(at, page.npos) << words;
        return at == page.npos ? "" : page.substr(at + words.size(), 9);  // its digits
    };
    const std::string once = behind("once 0."), then = behind("10 times 0." + once + " then 0.");
    EXPECT_NE(once, then);
    for (const char* product : {"10", "20", "30", "40", "60"})
        EXPECT_THAT(page, HasSubstr(product + (" times 0." + once) + " then 0." + then));
}

/// A figure belongs to the place at which it was made, an error to the place where it happens.
TEST_F(caches, places_of_sliders_show_what_was_made_there) {
    weave(
        "-- %% id=a\nlocal k = slider(\"k\", 3, 1, 4, {step = 1})\nif k == 2 then error(\"two is too few\") end\n"
        "if k > 2 then report.figure(\"loop\", plot({1, 2}, {k, 70 + k}, \"loop\"), \"The loop\") end\n"
        "print(\"k is \" .. k)\n"
        "-- %% [markdown]\n-- ![The loop.](figure:loop)\n");
    const std::string page = bench_.read("a.html");
    const auto data = page.find("class=\"slider-places\">");
    ASSERT_NE(data, page.npos);
    const std::string places = page.substr(data);
    EXPECT_THAT(places, AllOf(HasSubstr("two is too few"), HasSubstr("74")));
    const std::string gap = "?? [loop]";
    EXPECT_NE(places.find(gap, places.find(gap) + 1), places.npos) << "the run's own curve belongs to no other place";
}

/// A picture of the text is part of what its page was made from.
TEST_F(caches, another_picture_makes_another_document) {
    const auto with_picture = [&](const std::string& words) {
        bench_.write("rig.svg",
                     "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'><desc>" + words + "</desc></svg>");
        weave("-- %% [markdown]\n-- ![The rig.](rig.svg)\n");
        return bench_.read("a.html");
    };
    const std::string first = with_picture("first");
    EXPECT_FALSE(first == with_picture("second"));
    EXPECT_TRUE(first == with_picture("first"));
}

TEST_F(caches, edited_prose_runs_nothing) {
    weave(kStudy + kLate);
    EXPECT_THAT(weave("-- %% [markdown]\n-- Prose.\n" + kStudy + kLate),
                AllOf(Not(HasSubstr("run the script")), Not(HasSubstr("long calls"))));
}

TEST_F(caches, a_figure_without_a_caption_is_told_by_its_axes_whether_its_run_is_recalled_or_not) {
    const std::string cell = "-- %% id=b\nplot({1, 2}, {3, 4}, {xlabel = 'time (s)', ylabel = 'level (m)'})\n";
    const std::string told = "**Figure\u00A01.** Level (m) over time (s)\n";
    EXPECT_THAT(weave(cell, "a.md"), HasSubstr("run the script"));
    EXPECT_THAT(bench_.read("a.md"), HasSubstr(told));
    ASSERT_EQ(bench_.shell("rm a.md").exit_code, 0);
    EXPECT_THAT(weave(cell, "a.md"), HasSubstr("recall"));
    EXPECT_THAT(bench_.read("a.md"), HasSubstr(told));
    const std::string slider = "local k = slider('k', 1, 0, 2)\n";
    weave(cell + slider + cell.substr(cell.find('\n') + 1), "a.html");
    EXPECT_THAT(bench_.read("a.html"), Not(HasSubstr("From the cell"))) << "at the slider's places, too";
}

TEST_F(caches, spoilt_entries_are_made_anew) {
    weave(kStudy + kLate);
    const std::string whole = bench_.read("a.html");
    ASSERT_EQ(bench_
                  .shell("for f in ../cache/dynlab/{calls,figures}/*; do truncate -s -1 \"$f\"; done; rm -r "
                         "../cache/dynlab/{runs,reports}")
                  .exit_code,
              0);
    EXPECT_THAT(weave(kStudy + kLate), AllOf(HasSubstr(calls(1, 0)), HasSubstr(figures(2, 0))));
    EXPECT_TRUE(whole == bench_.read("a.html"));
    ASSERT_EQ(bench_.shell("rm -r ../cache/dynlab/{runs,reports}").exit_code, 0);
    EXPECT_THAT(weave(kStudy + kLate), AllOf(HasSubstr(calls(0, 1)), HasSubstr(figures(0, 2))));
}

TEST_F(caches, two_runs_at_once_give_the_same_document) {
    bench_.write("a.lua", kHeader + kStudy + kSearch + kLate);
    const ChildResult both = bench_.shell(
        "\"$DYNLAB\" weave a.lua -o 1.html & one=$!; \"$DYNLAB\" weave a.lua -o 2.html & other=$!; "
        "wait $one && wait $other && cmp 1.html 2.html");
    EXPECT_EQ(both.exit_code, 0) << both.output << both.error_output;
    EXPECT_THAT(weave(kStudy + kSearch + kLate + "print(1)\n"), HasSubstr(calls(0, 3)));
}

TEST_F(caches, can_be_switched_off_and_need_no_folder) {
    bench_.write("a.lua", kHeader + kStudy);
    for (const char* where : {"DYNLAB_NO_CACHE=1", "XDG_CACHE_HOME=/proc/none", "XDG_CACHE_HOME=/dev/full"})
        for (int i = 0; i < 2; ++i) {
            const ChildResult made =
                bench_.shell(std::string("env ") + where + " \"$DYNLAB\" weave a.lua -o a.html --timings");
            EXPECT_EQ(made.exit_code, 0) << where << made.error_output;
            EXPECT_THAT(made.output, HasSubstr(calls(1, 0))) << where;
        }
}

TEST_F(caches, serve_run_too) {
    const std::string code = "print(rig('crane', {seed = 7}).estimation.x[100])";
    const std::string first = bench_.dynlab({"run", "-e", code}).output;
    EXPECT_EQ(bench_.shell("ls ../cache/dynlab/calls | wc -l").output, "1\n");
    EXPECT_EQ(bench_.dynlab({"run", "-e", code}).output, first);
    EXPECT_EQ(bench_.shell("ls ../cache/dynlab/calls | wc -l").output, "1\n");
}

// ---- where a run is

TEST_F(caches, timings_tell_cells_figures_and_documents_apart) {
    const std::string told = weave(kStudy + kLate, "a.pdf");
    for (const char* step : {" ms  run the script\n", " ms    cell study\n", " ms  pandoc\n", " ms  figures\n",
                             " ms  latex pass 1\n", " ms  in total\n"})
        EXPECT_THAT(told, HasSubstr(step));
}

TEST_F(caches, a_terminal_is_told_of_a_cell_that_takes_long_and_of_its_bar) {
    std::string study = kStudy;
    study.replace(study.find("300"), 3, "1000000");
    bench_.write("a.lua", kHeader + "-- %%\nprint(1)\n" + study);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"weave", "a.lua", "-o", "a.html"}, std::vector<std::string>{"run", "a.lua"}}) {
        Terminal terminal(bench_, arguments);
        terminal.until("cell 2 of 2, study  1 s  Monte Carlo  [");
        terminal.until("cell 2 of 2, study  2 s  Monte Carlo  [");
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
