// Every lesson, as a student and an instructor meet it. Oracles: the lesson's own structure, textbook formulas applied
// to the data files by this test, and poppler's reading of the PDFs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>
#include <set>
#include <sstream>

#include "data_io/csv_file.h"
#include "documents/document_rules.h"
#include "documents/solutions.h"
#include "documents/text_lines.h"
#include "lesson_record.h"
#include "line_ends.h"
#include "numerics/plants/crane.h"
#include "numerics/plants/thruster.h"
#include "page_ends.h"
#include "platform/atomic_file.h"
#include "support/lesson_list.h"
#include "support/program.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::test {
namespace test_lessons {
using testing::HasSubstr;
using testing::Not;

class lessons : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(all, lessons, testing::ValuesIn(lesson_slugs()),
                         [](const auto& lesson) { return lesson.param; });

std::string text_of_pdf(const Workbench& bench, const std::string& file) {
    const ChildResult text = bench.shell("pdftotext -layout '" + file + "' -");
    EXPECT_EQ(text.exit_code, 0) << text.error_output;
    return text.output;
}

/// A lesson's report as a PDF, in a language. Made once for all tests.
std::string shared_report(const std::string& lesson, const std::string& language = "en") {
    std::vector<std::string> command{"report", lesson};
    if (language != "en") command.insert(command.end(), {"--lang", language});
    return shared_document(command, lesson + "." + language + ".pdf");
}

TEST_P(lessons, report_is_whole) {
    const Workbench bench;
    const std::string report = shared_report(GetParam());
    const std::string text = text_of_pdf(bench, report);
    EXPECT_THAT(text, Not(HasSubstr("??")));
    EXPECT_THAT(text, Not(HasSubstr("SOLUTION")));
    const std::string own_report = DYNLAB_SOURCE_DIR "/lessons/" + GetParam() + "/report.en.md";
    const bool has_own_report = std::filesystem::exists(own_report);
    const bool slides = has_own_report && document_rules(read_template(own_report)).slides;
    EXPECT_TRUE(slides || text.find("Figure 1") != std::string::npos);
    EXPECT_THAT(text, HasSubstr(has_own_report ? "Conclusion" : "What you have learned"));
    const std::string source = has_own_report ? own_report : DYNLAB_SOURCE_DIR "/lessons/" + GetParam() + "/lesson.lua";
    EXPECT_THAT(read_file(page_of_lesson(GetParam())), HasSubstr("</html>"));
    std::vector<std::string> sections = section_titles(read_file(source));
    sections.insert(sections.end(), {"Five questions to check yourself", "Answers to the questions"});
    if (!slides) expect_full_pages(bench, report, sections);
    expect_whole_quantities(bench, report);
}

/// Of a lesson in the language of its sheet.
std::vector<std::string> sheet_titles(const std::string& slug, const std::string& language) {
    const std::string folder = DYNLAB_SOURCE_DIR "/lessons/" + slug;
    std::vector<std::string> titles =
        section_titles(read_file(folder + (language == "en" ? "/lesson.lua" : "/tasks." + language + ".lua")));
    titles.insert(titles.end(), {"Five questions to check yourself", "Answers to the questions",
                                 "Cinq questions pour se vérifier", "Réponses aux questions"});
    for (std::string& title : titles) title = replaced(title, "'", "’");
    return titles;
}

TEST_P(lessons, sheets_fill_their_pages) {
    const Workbench bench;
    for (const std::string language : {"en", "fr"}) {
        if (language == "fr" && !std::filesystem::exists(DYNLAB_SOURCE_DIR "/lessons/" + GetParam() + "/tasks.fr.lua"))
            continue;
        const std::string sheet = shared_sheet(GetParam(), language);
        SCOPED_TRACE(language);
        expect_full_pages(bench, sheet, sheet_titles(GetParam(), language));
        expect_whole_quantities(bench, sheet);
    }
}

TEST_P(lessons, equations_have_the_same_numbers_with_and_without_the_solutions) {
    bool in_solution = false;
    for (const std::string& line : lines_of(read_file(DYNLAB_SOURCE_DIR "/lessons/" + GetParam() + "/lesson.lua"))) {
        if (line.find("BEGIN SOLUTION") != std::string::npos) in_solution = true;
        if (line.find("END SOLUTION") != std::string::npos) in_solution = false;
        const std::size_t label = line.find("{#eq:");
        if (label == std::string::npos) continue;
        EXPECT_EQ(line.substr(label).starts_with("{#eq:solution-"), in_solution) << line;
    }
}

// That the command finds faults is seen in tests/course/test_own_course.cpp.
TEST_P(lessons, texts_documents_and_copies_are_in_order) {
    const Workbench bench(Workbench::Memory::kShared);
    for (const char* part : {"texts", "documents"}) {
        const ChildResult tested = bench.dynlab({"test-lesson", GetParam(), "--part", part});
        EXPECT_EQ(tested.exit_code, 0) << tested.output << tested.error_output;
    }
}

TEST(lesson_02, line_residuals_and_forecast_follow_the_textbook_formulas) {
    const nlohmann::json record = record_of_lesson("02_least_squares");

    const CsvTable games = read_csv_file(DYNLAB_SOURCE_DIR "/data/winning_times/winning_times.csv");
    const auto column = [&games](const std::string& name) -> const Vector& {
        return games.columns[std::find(games.names.begin(), games.names.end(), name) - games.names.begin()];
    };
    const Vector year = column("year").head(29), time = column("time").head(29);
    const double n = 29, mean_year = year.mean();
    const Vector x = year.array() - mean_year;
    const double slope = x.dot(time) / x.squaredNorm();
    const Vector residuals = time - slope * x - Vector::Constant(29, time.mean());
    const double s = std::sqrt(residuals.squaredNorm() / (n - 2));
    const double x0 = 2024 - mean_year;
    const double forecast = time.mean() + slope * x0;
    const double t975_27 = 2.0518305165;  // Student's t table, 27 degrees of freedom
    const double half_width = t975_27 * s * std::sqrt(1 + 1 / n + x0 * x0 / x.squaredNorm());

    EXPECT_NEAR(number(record, "a"), slope, 1e-10);
    EXPECT_NEAR(number(record, "b"), time.mean(), 1e-10);
    EXPECT_NEAR(number(record, "a_std"), s / x.norm(), 1e-10);
    EXPECT_NEAR(number(record, "rmse"), std::sqrt(residuals.squaredNorm() / n), 1e-10);
    EXPECT_NEAR(number(record, "paris"), forecast, 1e-9);
    EXPECT_NEAR(number(record, "paris_low"), forecast - half_width, 1e-8);
    EXPECT_NEAR(number(record, "paris_high"), forecast + half_width, 1e-8);
    EXPECT_EQ(number(record, "actual"), 9.79);
}

// Oracles: the simulators' parameters as SOURCE.md states them, within four standard errors, the standard deviation of
// the noise, and an independent program's estimates and fits for the hair dryer.
TEST(lesson_03_workflow, models_agree_with_the_simulators_and_with_an_independent_program) {
    const nlohmann::json record = record_of_lesson("03_workflow");
    const auto expect_near = [&record](const std::string& name, double truth) {
        EXPECT_NEAR(number(record, name), truth, 4 * number(record, name + "_std")) << name;
    };

    EXPECT_EQ(number(record, "linear_poles"), 3);
    EXPECT_EQ(number(record, "linear_zeros"), 1);
    EXPECT_EQ(number(record, "linear_fit_poles"), 5) << "the largest structure has the best fit to its own record";
    EXPECT_EQ(number(record, "linear_fit_zeros"), 3);
    for (const auto& [name, truth] :
         {std::pair("a1", 3.05), {"a2", 11.25}, {"a3", 11.25}, {"b0", 5.625}, {"b1", 22.5}, {"td", 0.0}})
        expect_near(std::string("linear_") + name, truth);
    const double relative_spread = 1 / std::sqrt(2.0 * 1016);  // of a standard deviation from 1016 samples
    EXPECT_NEAR(number(record, "linear_noise"), 0.2, 4 * 0.2 * relative_spread);
    EXPECT_GE(number(record, "agreed_recommended"), 27) << "of 30 repetitions";

    expect_near("heat_gain", 1 / 1.5);  // the heat that is carried away with the air, 1.5 W/K
    expect_near("heat_slow", 64.6);
    expect_near("heat_small", 4.5 + 3 + 2.06);

    EXPECT_NEAR(number(record, "dryer_a1"), 11.8728, 5e-5);
    EXPECT_NEAR(number(record, "dryer_a2"), 30.5013, 5e-5);
    EXPECT_NEAR(number(record, "dryer_b0"), 28.2254, 5e-5);
    EXPECT_NEAR(number(record, "dryer_fit"), 89.01, 5e-3);
    EXPECT_NEAR(number(record, "dryer_rt2"), 0.98794, 5e-6);
    EXPECT_NEAR(number(record, "dryer1_a1"), 2.8200, 5e-5);
    EXPECT_NEAR(number(record, "dryer1_b0"), 2.6316, 5e-5);
    EXPECT_NEAR(number(record, "dryer1_fit"), 84.28, 5e-3);
    const double three[] = {-1.28872986, 0.40665869, 0.06551796, 0.04382600};
    const double two[] = {-1.50096, 0.59173, 0.00531, 0.07323};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(number(record, "arx3_" + std::to_string(i + 1)), three[i], 5e-9);
        EXPECT_NEAR(number(record, "arx2_" + std::to_string(i + 1)), two[i], 5e-6);
    }
}

/// "3.195 (0.208)", as the lesson's tables write a mean and a standard deviation.
std::pair<double, double> mean_and_std(const std::string& cell) {
    const auto bracket = cell.find('(');
    return {std::stod(cell), std::stod(cell.substr(bracket + 1))};
}

// Oracle: means and standard deviations over the same 200 seeds by an independent program (mc_sys2_*.json).
void expect_study(const nlohmann::json& rows, const std::string& reference_file,
                  const std::vector<std::string>& reference_names) {
    std::ifstream file(DYNLAB_SOURCE_DIR "/tests/reference/data/" + reference_file);
    const auto stats = nlohmann::json::parse(file).at("stats");
    ASSERT_EQ(rows.size(), reference_names.size() + 1) << "the truth, then the methods";
    for (std::size_t method = 0; method < reference_names.size(); ++method) {
        const auto& expected = stats.at(reference_names[method]);
        for (int parameter = 0; parameter < 3; ++parameter) {
            const auto [mean, spread] = mean_and_std(rows[method + 1][parameter + 1]);
            const double half_last_digit = 0.000501;
            EXPECT_NEAR(mean, expected.at("mean")[parameter], half_last_digit) << reference_names[method];
            EXPECT_NEAR(spread, expected.at("std")[parameter], half_last_digit) << reference_names[method];
        }
    }
}

TEST(lesson_04, studies_agree_with_the_reference_and_own_programs_with_the_library) {
    const nlohmann::json record = record_of_lesson("04_estimators");
    const auto rows = [&record](const char* table) { return record.at("tables").at(table).at("rows"); };

    expect_study(rows("lambda"), "mc_sys2_0.2.json",
                 {"ivsvf_lambda0.3_yfoh", "ivsvf_lambda3_yfoh", "ivsvf_lambda30_yfoh"});
    expect_study(rows("low"), "mc_sys2_0.2.json", {"lssvf_lambda3_yfoh", "ivsvf_lambda3_yfoh", "oe"});
    expect_study(rows("high"), "mc_sys2_0.4.json", {"lssvf_lambda3_yfoh", "ivsvf_lambda3_yfoh", "oe"});
    nlohmann::json holds = rows("holds");
    holds.erase(3);  // the data without noise
    expect_study(holds, "mc_sys2_0.2.json", {"lssvf_lambda3_yfoh", "lssvf_lambda3_yzoh"});
    EXPECT_LT(number(record, "agreement"), 1e-10);
    EXPECT_LT(number(record, "iv_agreement"), 1e-10);
    EXPECT_EQ(number(record, "refused"), 200) << "a negative real pole in every run";
}

// Oracles: the simulator's parameters (crane_truth), the limits of the assignment, the fit that no linear model beats.
TEST(lesson_03_crane, finds_the_crane_and_says_what_the_model_is_worth) {
    const nlohmann::json record = record_of_lesson("03_crane");
    const CraneTruth truth = crane_truth({});

    EXPECT_NEAR(number(record, "swing"), truth.natural_frequency, 0.02 * truth.natural_frequency);
    EXPECT_LT(number(record, "swing_error"), 2) << "percent, the worst of all repetitions";
    EXPECT_LT(number(record, "pendulum_error"), 2);
    EXPECT_NEAR(number(record, "free_frequency"), truth.natural_frequency, 0.01 * truth.natural_frequency);
    EXPECT_GT(number(record, "free_damping"), truth.damping_ratio) << "the air damps too";
    EXPECT_LT(number(record, "free_damping"), 2 * truth.damping_ratio);
    EXPECT_NEAR(number(record, "free_gain"), 1e3 * truth.speed_gain, 0.03 * 1e3 * truth.speed_gain);
    EXPECT_NEAR(number(record, "dry_voltage"), truth.dry_voltage, 0.05);
    const double gravity = CraneParameters{}.gravity;
    EXPECT_NEAR(number(record, "length"), gravity / std::pow(truth.natural_frequency, 2), 0.01);

    EXPECT_EQ(number(record, "repetitions"), 40);
    for (const char* gap : {"gap_x", "gap_theta"}) {
        EXPECT_GT(number(record, gap), 0) << "nothing beats the best linear model on average";
        EXPECT_LT(number(record, gap), 2);
    }
    EXPECT_GT(number(record, "discard_from"), 10);
    EXPECT_LT(number(record, "settling_lqr"), 3);
    EXPECT_LT(number(record, "left_lqr"), number(record, "left_p") / 4);
    EXPECT_LT(number(record, "largest_angle_lqr"), number(record, "largest_angle_p"));
    // The characteristic polynomial of a loop in controllable form ends in the last gain, the product of its poles.
    const auto modulus = [&](const char* re, const char* im) {
        return std::hypot(number(record, re), number(record, im));
    };
    EXPECT_NEAR(std::pow(modulus("fast_re", "fast_im") * modulus("slow_re", "slow_im"), 2), number(record, "gain4"),
                0.01 * number(record, "gain4"));
    EXPECT_LT(number(record, "start_left"), 0.5 * number(record, "start_error")) << "friction explains the start";
}

class lesson_03_crane_report : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(languages, lesson_03_crane_report, testing::Values("en", "fr"),
                         [](const auto& language) { return std::string(language.param); });
class lesson_05_slides : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(languages, lesson_05_slides, testing::Values("en", "fr"),
                         [](const auto& language) { return std::string(language.param); });

TemplateFile report_of(const std::string& lesson, const std::string& language) {
    return read_template(DYNLAB_SOURCE_DIR "/lessons/" + lesson + "/report." + language + ".md");
}

/// The pages of a lesson's report; none where LaTeX lacks the language.
std::vector<std::string> pages_of(const Workbench& bench, const std::string& lesson, const std::string& language) {
    std::vector<std::string> pages;
    if (language == "fr" && bench.shell("kpsewhich french.ldf").exit_code != 0) return pages;
    const std::string report = shared_report(lesson, language);
    expect_whole_quantities(bench, report);
    std::istringstream text(text_of_pdf(bench, report));
    for (std::string page; std::getline(text, page, '\f');) pages.push_back(page);
    const std::string all = std::accumulate(pages.begin(), pages.end(), std::string());
    for (const SectionRule& section : document_rules(report_of(lesson, language)).sections)
        EXPECT_THAT(all, HasSubstr(replaced(section.title(language), "'", "’")));
    std::smatch point;
    EXPECT_FALSE(language == "fr" && std::regex_search(all, point, std::regex(R"(\d\.\d)")))
        << "a decimal point in text, table or figure: " << point.str();
    return pages;
}

/// Numbers with a decimal point in the text are those of the experiments' plan; all results are slots.
void expect_no_result_typed_in(const TemplateFile& source, const std::set<std::string>& plan) {
    const std::regex decimal(R"((\d+)[.,](\d+))");
    const std::string& text = source.body.text;
    for (std::sregex_iterator found(text.begin(), text.end(), decimal), end; found != end; ++found)
        EXPECT_TRUE(plan.count((*found)[1].str() + "." + (*found)[2].str())) << found->str();
}

TEST_P(lesson_03_crane_report, keeps_to_six_pages_and_one_of_appendix) {
    const std::string language = GetParam();
    const Workbench bench(Workbench::Memory::kShared);
    const std::vector<std::string> pages = pages_of(bench, "03_crane", language);
    if (pages.empty()) GTEST_SKIP() << "texlive-lang-french is not installed";
    const DocumentRules rules = document_rules(report_of("03_crane", language));
    ASSERT_EQ(static_cast<int>(pages.size()), *rules.pages + *rules.appendix_pages);
    EXPECT_THAT(pages.back(), HasSubstr(replaced(rules.sections.back().title(language), "'", "’")));
    expect_full_pages(bench, shared_report("03_crane", language),
                      section_titles(report_of("03_crane", language).body.text));
}

TEST_P(lesson_03_crane_report, types_no_result_in) {
    expect_no_result_typed_in(report_of("03_crane", GetParam()), {"0.24", "0.02", "0.5", "0.2"});
}

TEST_P(lesson_05_slides, keep_to_twelve_with_the_eight_points_and_pass_the_check) {
    const Workbench bench(Workbench::Memory::kShared);
    const std::vector<std::string> pages = pages_of(bench, "05_thruster", GetParam());
    if (pages.empty()) GTEST_SKIP() << "texlive-lang-french is not installed";
    const DocumentRules rules = document_rules(report_of("05_thruster", GetParam()));
    EXPECT_EQ(rules.sections.size(), 8u);
    EXPECT_EQ(*rules.pages, 12);
    EXPECT_LE(static_cast<int>(pages.size()), 12);
    const ChildResult checked =
        bench.dynlab({"check", shared_report("05_thruster", GetParam()), "--template", "slides", "--json"});
    EXPECT_EQ(checked.exit_code, 0) << checked.output;
    EXPECT_TRUE(nlohmann::json::parse(checked.output).at("findings").empty()) << checked.output;
}

TEST_P(lesson_05_slides, type_no_result_in) {
    expect_no_result_typed_in(report_of("05_thruster", GetParam()), {});
}

// oracle: the notation of plot_data.h; how it moves is seen in tests/documents
TEST(lesson_pages, of_crane_and_thruster_show_the_plant_in_motion_and_copies_say_how) {
    for (const auto& [lesson, parts] : {std::pair{"03_crane", 2}, std::pair{"05_thruster", 1}}) {
        const Workbench bench(Workbench::Memory::kShared);
        const std::string page = read_file(page_of_lesson(lesson));
        const std::size_t at = page.find("\"motion\":{\"measured\":true");
        ASSERT_NE(at, std::string::npos) << lesson;
        EXPECT_EQ(page.find("\"motion\":{\"measured\"", at + 1), std::string::npos) << "one is enough";
        const std::string moving = page.substr(at, page.find("</script>", at) - at);
        std::size_t signals = 0;
        for (std::size_t k = moving.find("\"turns\""); k != std::string::npos; k = moving.find("\"turns\"", k + 1))
            ++signals;
        EXPECT_EQ(signals, static_cast<std::size_t>(parts));
        EXPECT_LT(page.size(), 3u << 20);
        ASSERT_EQ(bench.dynlab({"new", lesson, "mine"}).exit_code, 0);
        EXPECT_THAT(bench.read("mine/analysis.lua"), HasSubstr("-- motion{plant = "));
    }
}

TEST(lesson_03_crane_copy, has_the_sections_and_no_text_of_the_solution) {
    const Workbench bench(Workbench::Memory::kShared);
    ASSERT_EQ(bench.dynlab({"new", "03_crane", "mine"}).exit_code, 0);
    const std::string report = bench.read("mine/report.md");
    EXPECT_THAT(report, HasSubstr("# Raw data"));
    EXPECT_THAT(report, HasSubstr("title: \"Identification of a trolley crane\""));
    EXPECT_THAT(report, Not(HasSubstr("effect of friction")));
}

// Oracles: the simulator's parameters (thruster_truth, thruster_thrust), the bars of the assignment.
TEST(lesson_05_thruster, finds_curve_and_delay_and_a_better_model_than_a_linear_one) {
    const nlohmann::json record = record_of_lesson("05_thruster");
    const ThrusterParameters plant;
    const ThrusterTruth truth = thruster_truth(plant);

    EXPECT_NEAR(number(record, "rest_noise"), std::hypot(plant.noise_std, plant.resolution / std::sqrt(12.)),
                4 * plant.noise_std / std::sqrt(2. * 1500));
    EXPECT_NEAR(number(record, "rest_level"), plant.tare, 4 * plant.noise_std / std::sqrt(1500.));
    EXPECT_NEAR(number(record, "ring_frequency"), plant.cell_frequency, 0.05 * plant.cell_frequency);
    EXPECT_NEAR(number(record, "edge_forward"), plant.dead_band, 5);
    EXPECT_NEAR(number(record, "edge_reverse"), -plant.dead_band, 5);
    EXPECT_NEAR(number(record, "asymmetry"), -truth.forward_thrust / truth.reverse_thrust, 0.05);
    EXPECT_GT(number(record, "onset"), 1e3 * truth.delay) << "nothing answers before the delay";
    EXPECT_LT(number(record, "onset"), 1e3 * truth.delay + 15);

    for (const std::string shape : {"sine", "square"}) {
        EXPECT_NEAR(number(record, "delay_hammerstein_" + shape), 1e3 * truth.delay, 5);
        for (const std::string way : {"val_", "raw_"})
            EXPECT_GT(number(record, way + "hammerstein_" + shape), number(record, way + "linear_" + shape) + 5);
        EXPECT_GT(number(record, "gain_" + shape), 5) << "the least of the repetitions";
        EXPECT_GT(number(record, "root_gain_" + shape), 0);
    }
}

// Oracle: common English words, and the cells of the lesson.
TEST(lesson_copies, are_french_throughout_where_french_is_asked_for) {
    for (const std::string& lesson : lesson_slugs(true)) {
        const Workbench bench(Workbench::Memory::kShared);
        ASSERT_EQ(bench.dynlab({"new", lesson, "mine", "--lang", "fr"}).exit_code, 0);
        ASSERT_EQ(bench.dynlab({"new", lesson, "english"}).exit_code, 0);
        const std::string script = bench.read("mine/analysis.lua"), report = bench.read("mine/report.md");
        for (const std::string& text : {script, report, bench.read("mine/group.toml")})
            for (const char* word : {" is ", " are ", " your ", " what ", " with ", " which ", "YOUR", "Your"})
                EXPECT_THAT(text, Not(HasSubstr(word))) << lesson;
        EXPECT_THAT(script, HasSubstr("-- language: fr\n"));
        EXPECT_THAT(report, HasSubstr("title: \"Identification d'un"));
        EXPECT_THAT(report, HasSubstr("\n# Données brutes"));
        const auto marks = [](const std::string& text) {
            const std::regex mark("-- %%|YOUR CODE HERE|VOTRE CODE ICI|[*][*]Question \\d+");
            return std::distance(std::sregex_iterator(text.begin(), text.end(), mark), std::sregex_iterator());
        };
        EXPECT_EQ(marks(script), marks(bench.read("english/analysis.lua"))) << "as many cells and questions";
    }
}

// Oracle: common English words.
TEST(lesson_copies, have_french_guidance_where_the_tasks_are_french) {
    std::size_t french = 0;
    for (const Lesson& lesson : dynlab::lessons()) {
        if (!std::filesystem::is_regular_file(lesson.tasks("fr"))) continue;
        const Workbench bench(Workbench::Memory::kShared);
        ASSERT_EQ(bench.dynlab({"new", lesson.slug, "mine", "--lang", "fr"}).exit_code, 0);
        for (const char* word : {" is ", " are ", " your ", " what ", " with ", " which ", "Your", "My work"})
            EXPECT_THAT(bench.read("mine/report.md"), Not(HasSubstr(word))) << lesson.slug;
        ++french;
    }
    EXPECT_GT(french, lesson_slugs(true).size());
}

TEST(lesson_copies, have_the_lesson_s_subtitle_where_its_questions_are_answered) {
    const Workbench bench;
    for (const Lesson& lesson : dynlab::lessons()) {
        const ScriptHeader header = read_percent_script(lesson.script()).header;
        ASSERT_EQ(bench.dynlab({"new", lesson.slug, lesson.slug}).exit_code, 0);
        EXPECT_EQ(bench.read(lesson.slug + "/report.md").find("\nsubtitle: \"" + header.subtitle + "\"\n") !=
                      std::string::npos,
                  header.template_name == "lesson");
    }
}

// Oracle: the labels of figures and tables, and their references, as they are written.
TEST(lesson_copies, mention_what_they_show) {
    for (const Lesson& lesson : dynlab::lessons()) {
        const std::string copy = without_solutions(read_text(lesson.script()), lesson.script());
        const std::regex label(R"re(\{#((?:fig|tbl):\w+)|#(tbl:\w+)\})re");
        for (std::sregex_iterator at(copy.begin(), copy.end(), label), end; at != end; ++at) {
            const std::string name = (*at)[1].matched ? (*at)[1].str() : (*at)[2].str();
            if (name == "tbl:name" || name == "fig:name") continue;  // how labels are written, at the beginning
            EXPECT_TRUE(std::regex_search(copy, std::regex("@" + name + "\\b"))) << lesson.slug << ' ' << name;
        }
    }
}

TEST(lesson_copies, of_a_review_are_french_as_well) {
    const Workbench bench(Workbench::Memory::kShared);
    ASSERT_EQ(bench.dynlab({"new", "review", "mine", "--lang", "fr"}).exit_code, 0);
    const std::string report = bench.read("mine/report.md");
    for (const char* word : {" is ", " are ", " your ", " what ", " with ", " which "})
        EXPECT_THAT(report, Not(HasSubstr(word)));
    EXPECT_THAT(report, HasSubstr("title: Relecture d'un rapport\nlang: fr\n"));
    EXPECT_EQ(bench.dynlab({"report", "mine"}).exit_code, 0);
}

TEST(lesson_05_copy, makes_slides_with_the_points_and_no_guidance) {
    const Workbench bench(Workbench::Memory::kShared);
    ASSERT_EQ(bench.dynlab({"new", "05", "mine"}).exit_code, 0);
    EXPECT_THAT(bench.read("mine/report.md"), HasSubstr("title: \"Identification of an underwater thruster\""));
    const ChildResult made = bench.dynlab({"report", "mine"});
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    const std::string text = text_of_pdf(bench, "mine/report.pdf");
    EXPECT_THAT(text, HasSubstr("Raw data"));
    EXPECT_THAT(text, Not(HasSubstr("What do you observe")));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\f'), 9) << "the title and eight points";
}

}  // namespace test_lessons
}  // namespace dynlab::test
