// What a report leaves for the next one: results of long calls, drawn figures, runs. Oracles: the counts of what was
// computed and drawn, and equality of the documents' bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "workflow/make_report.h"
#include "workflow_run.h"

namespace dynlab::test {
namespace test_report_memory {
namespace fs = std::filesystem;
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
    "print(srivcstruc(data, {poles = {1, 4}, zeros = {0, 3}}))\nlocal Td, fig = delayest(data, {TdMax = 0.2})\n";
const std::string kLate = "-- %% id=late\nplot({1, 2}, {3, 4})\nprint('late')\n";

class report_memory : public testing::Test {
  protected:
    void make_data(int seed) {
        ASSERT_FALSE(work_
                         .run("local s = tf('s') local u = prbs(4, 100) rng(" + std::to_string(seed) +
                              ") local y = lsim(2/(s^2 + 4*s + 3), u, 0.01) + 0.2*randn(#u)\n"
                              "save_csv('d.csv', {u = u, y = y})\n")
                         .record.error);
    }
    /// The document of a script of these cells.
    ReportResult weave(const std::string& cells, const std::string& output = "a.html",
                       const std::map<std::string, double>& sliders = {}) {
        ReportRequest request =
            report_of_script(parse_percent_script(kHeader + cells, work_.path("a.lua")), work_.path(output));
        request.slider_values = sliders;
        return make_report(request);
    }
    std::string page() const { return work_.read("a.html"); }

    static void expect_calls(const ReportResult& result, std::size_t computed, std::size_t from_cache) {
        ASSERT_TRUE(result.long_calls) << "the script was run";
        EXPECT_EQ(result.long_calls->made, computed);
        EXPECT_EQ(result.long_calls->from_cache, from_cache);
    }
    static void expect_figures(const ReportResult& result, std::size_t drawn, std::size_t from_cache) {
        ASSERT_TRUE(result.figures);
        EXPECT_EQ(result.figures->made, drawn);
        EXPECT_EQ(result.figures->from_cache, from_cache);
    }

    WorkFolder work_;
};

TEST_F(report_memory, a_changed_late_cell_computes_and_draws_nothing_else) {
    make_data(1);
    const ReportResult first = weave(kStudy + kSearch + kLate);
    expect_calls(first, 3, 0);
    expect_figures(first, 3, 0);
    const std::string changed = kStudy + kSearch + "-- %% id=late\nplot({1, 2}, {3, 5})\nprint('later')\n";
    const ReportResult second = weave(changed);
    expect_calls(second, 0, 3);
    expect_figures(second, 1, 2);
    const std::string from_cache = page();
    fs::remove_all(work_.cache());
    fs::remove(work_.path("a.html"));
    expect_calls(weave(changed), 3, 0);
    EXPECT_TRUE(from_cache == page()) << "a recalled result differs from the computed one";
    // Other data: the study alone does not depend on them.
    make_data(2);
    const ReportResult other = weave(changed);
    expect_calls(other, 2, 1);
    expect_figures(other, 1, 2);
}

TEST_F(report_memory, edited_prose_runs_nothing) {
    weave(kStudy + kLate);
    EXPECT_TRUE(weave(kStudy + kLate).up_to_date);
    const ReportResult edited = weave("-- %% [markdown]\n-- Prose.\n" + kStudy + kLate);
    EXPECT_FALSE(edited.up_to_date);
    EXPECT_FALSE(edited.long_calls) << "the run was recalled";
    EXPECT_THAT(page(), HasSubstr("Prose."));
}

TEST_F(report_memory, corrupt_entries_are_computed_again) {
    weave(kStudy + kLate);
    const std::string complete = page();
    for (const char* kind : {"calls", "figures"})
        for (const auto& entry : fs::directory_iterator(work_.cache() / kind))
            fs::resize_file(entry.path(), fs::file_size(entry.path()) - 1);
    const auto forget_runs = [&] {
        for (const char* kind : {"runs", "reports"}) fs::remove_all(work_.cache() / kind);
    };
    forget_runs();
    const ReportResult again = weave(kStudy + kLate);
    expect_calls(again, 1, 0);
    expect_figures(again, 2, 0);
    EXPECT_TRUE(complete == page());
    forget_runs();
    const ReportResult from_cache = weave(kStudy + kLate);
    expect_calls(from_cache, 0, 1);
    expect_figures(from_cache, 0, 2);
}

TEST_F(report_memory, a_folder_that_cannot_hold_a_cache_changes_no_document) {
    weave(kStudy);
    const std::string expected = page();
    fs::remove(work_.path("a.html"));
    for (const auto& [name, value] : {std::pair("DYNLAB_NO_CACHE", "1"), {"XDG_CACHE_HOME", "/dev/full"}}) {
        const EnvironmentVariable changed(name, value);
        for (int i = 0; i < 2; ++i) expect_calls(weave(kStudy), 1, 0);
        EXPECT_TRUE(expected == page()) << name;
    }
}

// In Markdown: a page holds the other places of the slider, too.
TEST_F(report_memory, a_number_set_for_a_slider_makes_another_document) {
    const std::string cells = "-- %% id=a\nprint(\"k is \" .. slider(\"k\", 3, 1, 10))\n";
    weave(cells, "a.md");
    EXPECT_THAT(work_.read("a.md"), HasSubstr("k is 3"));
    weave(cells, "a.md", {{"k", 4}});
    EXPECT_THAT(work_.read("a.md"), HasSubstr("k is 4"));
    weave(cells, "a.md");
    EXPECT_THAT(work_.read("a.md"), HasSubstr("k is 3"));
    EXPECT_THAT(error_of([&] {
                    weave(cells, "a.md", {{"kk", 5}});
                }),
                HasSubstr("a.lua has no slider \"kk\"; the sliders are k"));
}

/// The data that another place of a slider reads are part of its page.
TEST_F(report_memory, data_of_another_place_of_a_slider_make_another_page) {
    for (const char* name : {"run1.csv", "run2.csv"}) work_.write(name, "t,u,y\n0,1,5\n1,1,6\n");
    const std::string cells =
        "-- %% id=a\nlocal d = load(\"run\" .. slider(\"k\", 1, 1, 2, {step = 1}) .. \".csv\")\nprint(\"first\", "
        "d.y[1])\n";
    weave(cells);
    EXPECT_TRUE(weave(cells).up_to_date);
    work_.write("run2.csv", "t,u,y\n0,1,77\n1,1,6\n");
    weave(cells);
    EXPECT_THAT(page(), HasSubstr("77"));
}

/// Every combination of a cell's sliders goes on from what ran before it, random numbers among that.
TEST_F(report_memory, places_of_sliders_go_on_from_the_same_state) {
    weave(
        "-- %% id=a\nlocal before = rand()\nprint(string.format(\"once %.9f\", before))\n-- %% id=b\nlocal k, l = "
        "slider(\"k\", 1, 1, 2, {step = 1}), slider(\"l\", 10, 10, 30, {step = 10})\n-- %% id=c\n"
        "print(string.format(\"%d times %.9f then %.9f\", k*l, before, rand()))\nbefore = 0\n");
    const auto behind = [text = page()](const std::string& words) {
        const auto at = text.find(words);
        EXPECT_NE(at, text.npos) << words;
        return at == text.npos ? "" : text.substr(at + words.size(), 9);  // its digits
    };
    const std::string once = behind("once 0."), then = behind("10 times 0." + once + " then 0.");
    EXPECT_NE(once, then);
    for (const char* product : {"10", "20", "30", "40", "60"})
        EXPECT_THAT(page(), HasSubstr(product + (" times 0." + once) + " then 0." + then));
}

/// A figure belongs to the place at which it was made, an error to the place where it happens.
TEST_F(report_memory, places_of_sliders_show_what_was_made_there) {
    weave(
        "-- %% id=a\nlocal k = slider(\"k\", 3, 1, 4, {step = 1})\nif k == 2 then error(\"two is too few\") end\n"
        "if k > 2 then report.figure(\"loop\", plot({1, 2}, {k, 70 + k}, \"loop\"), \"The loop\") end\n"
        "print(\"k is \" .. k)\n"
        "-- %% [markdown]\n-- ![The loop.](figure:loop)\n");
    const auto data = page().find("class=\"slider-places\">");
    ASSERT_NE(data, std::string::npos);
    const std::string places = page().substr(data);
    EXPECT_THAT(places, AllOf(HasSubstr("two is too few"), HasSubstr("74")));
    const std::string gap = "?? [loop]";
    EXPECT_NE(places.find(gap, places.find(gap) + 1), places.npos) << "the run's own curve belongs to no other place";
}

TEST_F(report_memory, another_picture_makes_another_document) {
    const auto with_picture = [&](const std::string& words) {
        work_.write("rig.svg",
                    "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'><desc>" + words + "</desc></svg>");
        weave("-- %% [markdown]\n-- ![The rig.](rig.svg)\n");
        return page();
    };
    const std::string first = with_picture("first");
    EXPECT_FALSE(first == with_picture("second"));
    EXPECT_TRUE(first == with_picture("first"));
}

TEST_F(report_memory, a_figure_without_a_caption_is_described_by_its_axes_whether_its_run_is_cached_or_not) {
    const std::string cell = "-- %% id=b\nplot({1, 2}, {3, 4}, {xlabel = 'time (s)', ylabel = 'level (m)'})\n";
    const std::string described = "**Figure\u00A01.** Level (m) over time (s)\n";
    EXPECT_TRUE(weave(cell, "a.md").long_calls);
    EXPECT_THAT(work_.read("a.md"), HasSubstr(described));
    fs::remove(work_.path("a.md"));
    EXPECT_FALSE(weave(cell, "a.md").long_calls) << "recalled";
    EXPECT_THAT(work_.read("a.md"), HasSubstr(described));
    weave(cell + "local k = slider('k', 1, 0, 2)\n" + cell.substr(cell.find('\n') + 1));
    EXPECT_THAT(page(), Not(HasSubstr("From the cell"))) << "at the slider's places, too";
}

TEST_F(report_memory, a_report_is_made_again_when_anything_it_is_made_of_changes) {
    work_.write("mine/values.csv", "y\n1\n2\n");
    work_.write("mine/analysis.lua", "report.value('sum', sum(load('values.csv').y), '%.0f')\n");
    work_.write("mine/report.md", "---\ntitle: A\n---\n\nSum `sum`{.value}.\n");
    const fs::path output = work_.path("mine/report.html");
    const auto up_to_date = [&](std::uint32_t seed = 1) {
        ReportRequest request = report_of(work_.path("mine"), output);
        request.seed = seed;
        return make_report(request).up_to_date;
    };
    EXPECT_FALSE(up_to_date());
    EXPECT_TRUE(up_to_date());
    work_.write("mine/values.csv", "y\n1\n3\n");
    EXPECT_FALSE(up_to_date());
    work_.write("mine/report.md", "---\ntitle: A\n---\n\nThe sum `sum`{.value}.\n");
    EXPECT_FALSE(up_to_date());
    work_.write("mine/analysis.lua", "report.value('sum', 2*sum(load('values.csv').y), '%.0f')\n");
    EXPECT_FALSE(up_to_date());
    EXPECT_FALSE(up_to_date(7));
    write_file_atomically(output, "changed by hand");
    EXPECT_FALSE(up_to_date());
    EXPECT_TRUE(up_to_date());
}

TEST_F(report_memory, a_script_runs_again_only_when_its_code_or_its_data_change) {
    const std::string code = "\n-- %%\nlocal d = load('d.csv')\nprint(sum(d.y))\nplot(d.t, d.y)\n";
    const auto runs_again = [&](const std::string& prose, const std::string& last) {
        return weave("-- %% [markdown]\n-- " + prose + code + last, "a.md").long_calls.has_value();
    };
    work_.write("d.csv", "t,y\n0,1\n1,2\n");
    EXPECT_TRUE(runs_again("Prose.", ""));
    EXPECT_FALSE(runs_again("Other prose,\n-- of two lines.", ""));
    EXPECT_THAT(work_.read("a.md"), AllOf(HasSubstr("of two lines"), HasSubstr("\n3\n"), HasSubstr("a_files/")));
    work_.write("d.csv", "t,y\n0,1\n1,5\n");
    EXPECT_TRUE(runs_again("Prose.", ""));
    EXPECT_THAT(work_.read("a.md"), HasSubstr("\n6\n"));
    work_.write("other.csv", "t,y\n0,1\n1,5\n");  // load might prefer it
    EXPECT_TRUE(runs_again("Prose.", ""));
    EXPECT_TRUE(runs_again("Prose.", "print(7)\n"));
    // A corrupt run log does not stop the work.
    for (const auto& entry : fs::recursive_directory_iterator(work_.cache() / "runs"))
        if (entry.path().filename() == "record") write_file_atomically(entry.path(), "corrupt");
    EXPECT_TRUE(runs_again("Other prose.", "print(7)\n"));
    // Output that names a line of the script is never kept: an edit of the prose moves the line.
    const std::string names_a_line = "print(select(2, pcall(function() error('told') end)))\n";
    EXPECT_TRUE(runs_again("Prose.", names_a_line));
    EXPECT_TRUE(runs_again("Prose\n-- of two lines.", names_a_line));
}

TEST_F(report_memory, timings_name_the_steps_and_the_cells) {
    const ReportResult made = weave(kStudy + kLate);
    std::vector<std::string> steps, cells;
    for (const auto& [step, seconds] : made.timings) steps.push_back(step);
    for (const auto& [cell, seconds] : made.cells) cells.push_back(cell);
    EXPECT_THAT(steps, testing::IsSupersetOf({kRunStep, "pandoc", "figures"}));
    EXPECT_THAT(cells, testing::ElementsAre("study", "late"));
}

}  // namespace test_report_memory
}  // namespace dynlab::test
