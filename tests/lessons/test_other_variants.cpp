// Lesson 1 on the data sets of groups. Oracles: the parameters of each plant variant, and the statements of the
// lesson's text about its figures and tables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "figures/figure.h"
#include "figures/gnuplot_renderer.h"
#include "numerics/plants/plant_variant.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/runtime.h"
#include "support/lesson_list.h"

namespace dynlab::test {
namespace test_other_variants {

constexpr const char* kLesson = "01_process_models";

/// The lesson on data of another exchanger and another suspension. Its two hundred repetitions use the common
/// exchanger; two of them are enough.
PercentScript on_variant(int number) {
    static const std::regex loaded(R"re(\bload\("(heat_exchanger|suspension)"\))re"), repeated("\nlocal runs = 200\n");
    const std::filesystem::path file = lesson_folder(kLesson) / "lesson.lua";
    const std::string seed = std::to_string(number);
    std::string script = read_file(file);
    EXPECT_TRUE(std::regex_search(script, loaded) && std::regex_search(script, repeated));
    script = std::regex_replace(script, loaded, "plant(\"$1\", {variant = " + seed + ", seed = " + seed + "})");
    return parse_percent_script(std::regex_replace(script, repeated, "\nlocal runs = 2\n"), file);
}

/// The numbers of a table's row behind its name, without their errors.
std::vector<double> numbers_of(const RunRecord& run, const std::string& table, std::size_t row) {
    std::vector<double> numbers;
    const std::vector<std::string>& cells = run.tables.at(table).rows.at(row);
    for (std::size_t i = 1; i < cells.size(); ++i) numbers.push_back(std::stod(cells[i]));
    return numbers;
}

/// But for noise below a level of zero, where a paper begins.
void expect_on_paper(const RunRecord& run, const std::string& name, double noise) {
    const Panel& paper = run.figures.at(name).figure->panels.at(0);
    ASSERT_TRUE(paper.y_range) << name;
    const auto& samples = paper.curves.at(0).y;
    const auto [lowest, highest] = std::minmax_element(samples.begin(), samples.end());
    EXPECT_GE(*lowest, paper.y_range->first - noise) << name;
    EXPECT_LE(*highest, paper.y_range->second) << name;
}

TEST(other_variants, carry_lesson_1_to_its_end_and_keep_its_words_true) {
    const TemporaryFolder out;
    GnuplotRenderer renderer;
    for (int number = 1; number <= 60; ++number) {
        SCOPED_TRACE("variant " + std::to_string(number));
        RunOptions options;
        options.script_folder = lesson_folder(kLesson);
        options.out_folder = out.path();
        Runtime runtime(options, renderer);
        const RunRecord run = runtime.run(on_variant(number));
        ASSERT_FALSE(run.error) << run.error->text();
        EXPECT_EQ(run.answers.size(), 6u);
        const auto exchanger = heat_exchanger_truth(heat_exchanger_variant(static_cast<std::uint32_t>(number)));
        const auto found = numbers_of(run, "exchanger", 1);
        EXPECT_NEAR(found[0], exchanger.gain, 0.02 * exchanger.gain);
        EXPECT_NEAR(found[1], exchanger.time_constant, 0.03 * exchanger.time_constant);
        const auto balance = numbers_of(run, "half_flow", 1), read = numbers_of(run, "half_flow", 2),
                   estimated = numbers_of(run, "half_flow", 3);
        EXPECT_LT(read[0], balance[0]) << "its gain and its time constant are too small";
        EXPECT_LT(read[1], 0.95 * balance[1]);
        EXPECT_NEAR(estimated[0], balance[0], 0.02 * balance[0]);
        EXPECT_NEAR(estimated[1], balance[1], 0.03 * balance[1]);
        expect_on_paper(run, "exchanger_paper", 0);
        expect_on_paper(run, "suspension_paper", 0.25);
    }
}

}  // namespace test_other_variants
}  // namespace dynlab::test
