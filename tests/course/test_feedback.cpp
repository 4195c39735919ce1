// What students read. Oracles: the header and roster that are made here, and poppler's text of the PDF.
#include <gmock/gmock.h>

#include "course/grading_bench.h"
#include "workflow/given_script.h"

namespace dynlab::test {
namespace test_feedback {
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kAnswers = "--   x: number\n";
constexpr const char* kSolution = "answer('x', 42)\n";
constexpr const char* kChecks =
    "check{id = 'x', points = 2.5, about = 'The number', hint = 'Six times seven.',\n"
    "  test = function(a) return near(a.x, 42) end}\n";
constexpr const char* kFrench =
    "-- ---\n-- title: T\n-- lesson: 99_small\n-- language: fr\n-- answers:\n--   x: number\n";

TEST(feedback, is_in_the_language_of_what_was_submitted) {
    const Workbench bench;
    const auto language = [&] { return language_of_work(bench.path()); };
    EXPECT_EQ(language(), "");
    bench.write("analysis.lua", GradingBench::header(kAnswers));
    EXPECT_EQ(language(), "en");
    bench.write("analysis.lua", "-- ---\n-- title: T\n-- language: fr\n-- ---\n");
    EXPECT_EQ(language(), "fr");
    bench.write("report.md", "---\ntitle: T\n---\n");
    EXPECT_EQ(language(), "fr");
    bench.write("report.md", "---\ntitle: T\nlang: en\n---\n");
    EXPECT_EQ(language(), "en");
    bench.write("report.md", "---\nsecret: [\n---\n");
    EXPECT_EQ(language(), "fr");
    bench.write("analysis.lua", "-- ---\n-- language: klingon\n-- ---\n");
    EXPECT_EQ(language(), "");
}

TEST(feedback, is_titled_after_the_group_and_not_after_the_folder_of_a_platform) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    bench.submit_file("Zoé Lefèvre_900001_assignsubmission_file_", "answer('x', 1)\n");
    work.write("in/Zoé Lefèvre_900001_assignsubmission_file_/report.md", "---\ntitle: T\nlang: fr\n---\n");
    bench.submit_file("Ada Byron_900002_assignsubmission_file_", kSolution);
    bench.submit_file("Ida Rhodes_900003_assignsubmission_file_", kSolution);
    work.write("roster.csv",
               "id,name,group,language\n1,Zoé Lefèvre,group-03,\n2,Ada Byron,,fr\n3,Ida Rhodes,group-04,\n");
    std::vector<std::string> words = {"grade", "in",          "--lesson",    "99",       "--out",
                                      "out",   "--isolation", bench.level(), "--roster", "roster.csv"};
    const ChildResult run = work.dynlab(words);
    ASSERT_EQ(run.exit_code, 0) << run.error_output;
    const auto feedback = [&](const std::string& name) {
        return work.read("out/results/" + name + "_assignsubmission_file_/feedback.md");
    };
    EXPECT_THAT(
        feedback("Zoé Lefèvre_900001"),
        AllOf(StartsWith("# Retour pour group-03\n\nLeçon 99\\_small, points\u202F: **0 sur 2,5.**\n\nVotre script est "
                         "allé jusqu'au bout.\n\n## Vérifications\n\n- **The number** – 0 sur 2,5"),
              Not(HasSubstr("assignsubmission")), HasSubstr("écrivez à votre enseignant")));
    EXPECT_THAT(feedback("Ada Byron_900002"), StartsWith("# Retour pour Ada Byron\n\nLeçon"));
    EXPECT_THAT(feedback("Ida Rhodes_900003"),
                StartsWith("# Feedback for group-04\n\nLesson 99\\_small: **2.5 of 2.5 points.**"));
    const std::string pdf =
        work.shell("pdftotext -layout out/results/Zo*/feedback.pdf - && pdfinfo out/results/Zo*/feedback.pdf").output;
    EXPECT_THAT(pdf, AllOf(HasSubstr("Retour pour group-03"), HasSubstr("Vérifications"), HasSubstr("0 sur 2,5"),
                           ContainsRegex("Leçon 99_small, points *(\u202F)? *: 0 sur 2,5[.]"),
                           Not(HasSubstr("assignsubmission"))));
    const std::string english = work.shell("pdftotext -layout out/results/Ida*/feedback.pdf -").output;
    EXPECT_THAT(english, AllOf(HasSubstr("Feedback for group-04"), HasSubstr("Checks"), HasSubstr("contact your")));
    work.write("roster.csv", "id,name,language\n1,Zoé Lefèvre,français\n");
    EXPECT_THAT(work.dynlab(words).error_output,
                HasSubstr("roster.csv, line 2: the language must be en or fr, but \"français\" was given"));
}

// oracle: the names as the roster has them, in poppler's text
TEST(feedback, names_are_text_whatever_is_in_them) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    const std::string link = "[x](javascript:alert(1))", tag = "<img src=x>", formula = "$x_2$ *y*";
    for (const std::string& group : {link, tag, formula}) bench.submit_file(group, kSolution);
    work.write("roster.csv", "id,name,group\n1,A\tB," + link + "\n2,C\x1B[31mD," + tag + "\n3,\"E\nF\"," + formula +
                                 "\n4,G\u0085H,\n");
    const ChildResult run = work.dynlab(
        {"grade", "in", "--lesson", "99", "--out", "out", "--isolation", bench.level(), "--roster", "roster.csv"});
    EXPECT_EQ(run.exit_code, 0) << run.error_output;
    const auto text = [&](const std::string& file) { return work.shell("pdftotext -layout '" + file + "' -").output; };
    for (const std::string& group : {link, tag, formula})
        EXPECT_THAT(text("out/results/" + group + "/feedback.pdf"), HasSubstr("Feedback for " + group));
    EXPECT_THAT(text("out/summary.pdf"), AllOf(HasSubstr("A?B"), HasSubstr("C?[31mD"), HasSubstr("E?F"),
                                               HasSubstr("G?H"), HasSubstr(link), HasSubstr(tag)));
}

TEST(feedback, of_late_work_reports_the_reason_in_its_language) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    const Workbench& work = bench.bench();
    work.write("in/late/analysis.lua", std::string(kFrench) + "-- ---\n" + kSolution);
    work.shell("touch -d '2026-03-03 08:00 UTC' in/late/analysis.lua");
    work.write("deadlines.csv", "submission,deadline,percent_per_day,most_percent\n*,2026-03-01 18:00,12.5,50\n");
    const ChildResult graded = bench.grade({"--deadlines", "deadlines.csv", "--timezone", "UTC"});
    ASSERT_EQ(graded.exit_code, 0) << graded.error_output;
    EXPECT_THAT(work.read("out/results/late/feedback.md"),
                HasSubstr("points perdus\u202F: 0,62 (reçu le 2026-03-03 08:00 UTC, 1 j 14 h après la date limite du "
                          "2026-03-01 18:00 UTC\u202F; la pénalité est de 12,5\u202F% des points par jour entamé, au "
                          "plus 50\u202F%)."));
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr("1 d 14 h after the deadline of 2026-03-01 18:00 UTC"));
}

TEST(feedback, of_a_submission_that_does_not_count_says_so) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    bench.submit_file("Zoé Lefèvre_900001_assignsubmission_file_", "answer('x', 1)\n");
    work.write("in/Ida Rhodes_900003_assignsubmission_file_/analysis.lua",
               std::string(kFrench) + "-- ---\n" + kSolution);
    work.write("roster.csv", "id,name,group\n1,Zoé Lefèvre,group-03\n3,Ida Rhodes,group-03\n");
    const auto feedback = [&](const std::string& name) {
        return work.read("out/results/" + name + "_assignsubmission_file_/feedback.md");
    };
    bench.grade({"--roster", "roster.csv"});
    EXPECT_THAT(feedback("Zoé Lefèvre_900001"), HasSubstr("**This submission does not count.** Of your submissions, "
                                                          "the best submission counts: Ida Rhodes (900003)."));
    EXPECT_THAT(feedback("Ida Rhodes_900003"), Not(HasSubstr("ne compte pas")));
    // A manual mark reverses the result.
    work.write("out/marks.csv",
               "who,check,points,reason\nZoé Lefèvre_900001_assignsubmission_file_,x,1.5,said it\n"
               "Ida Rhodes_900003_assignsubmission_file_,x,0,copied\n");
    EXPECT_THAT(bench.grade({"--roster", "roster.csv"}).output, HasSubstr("0 graded now, 2 unchanged"));
    EXPECT_THAT(feedback("Zoé Lefèvre_900001"), Not(HasSubstr("does not count")));
    EXPECT_THAT(feedback("Ida Rhodes_900003"),
                HasSubstr("**Ce rendu ne compte pas.** De vos rendus, le meilleur compte\u202F: "
                          "Zoé Lefèvre (900001)."));
    EXPECT_THAT(work.read("out/gradebook.csv"), HasSubstr("3,Ida Rhodes,Zoé Lefèvre_900001_assign"));
}

// oracle: French typography, which has no space within a place and none of its quotation marks in code
TEST(feedback, in_french_reports_what_stopped_a_script_in_french) {
    GradingBench bench(kAnswers,
                       "check{id = 'x', about = 'The number', hint = 'damp(G, \"all\")',\n"
                       "  test = function(a) return near(a.x, 42) end}\n",
                       kSolution);
    const Workbench& work = bench.bench();
    bench.submit_file("a", std::string(kFrench) + "-- ---\nanswer('x', maen({1}))\n");
    const ChildResult run =
        work.dynlab({"grade", "in", "--lesson", "99", "--out", "out", "--isolation", bench.level()});
    ASSERT_EQ(run.exit_code, 0) << run.error_output;
    EXPECT_THAT(
        work.read("out/results/a/feedback.md"),
        AllOf(HasSubstr(
                  "`analysis.lua:8`: fonction ou variable inconnue\u202F: «\u00A0maen\u00A0»\u202F; vouliez-vous dire"),
              Not(HasSubstr("unknown function"))));
    EXPECT_THAT(work.shell("pdftotext out/results/a/feedback.pdf - | tr '\\n' ' '").output,
                AllOf(HasSubstr("analysis.lua:8"), HasSubstr("damp(G, \"all\")")));
}

// oracle: the file itself, which a new one would replace, and poppler's text of it
TEST(feedback, is_set_again_only_where_its_text_has_changed) {
    GradingBench bench(kAnswers, kChecks, kSolution);
    Workbench& work = bench.bench();
    bench.submit_file("a", "answer('x', 41)\n");
    const auto grade = [&](const std::string& own, const std::vector<std::string>& more) {
        work.write("own/own.lua", "check{id = 'own', about = 'Its size', test = function(a) " + own + " end}\n");
        std::vector<std::string> words = {"grade", "in",    "--lesson", "99",          "--checks",
                                          "own",   "--out", "out",      "--isolation", bench.level()};
        words.insert(words.end(), more.begin(), more.end());
        const ChildResult run = work.dynlab(words);
        EXPECT_EQ(run.exit_code, 0) << run.error_output;
        return work.shell("stat -c '%i %y' out/results/a/feedback.pdf; sha256sum < out/results/a/feedback.pdf").output;
    };
    const auto text = [&] { return work.shell("pdftotext out/results/a/feedback.pdf - | tr '\\n' ' '").output; };
    const std::string first = grade("return a.x > 40", {});
    EXPECT_THAT(text(), HasSubstr("Its size – 1 of 1"));
    EXPECT_EQ(grade("return a.x >= 41", {"--again"}), first);
    const std::string other = grade("return a.x > 41", {"--again"});
    EXPECT_NE(other, first);
    EXPECT_THAT(text(), HasSubstr("Its size – 0 of 1"));
    // A file that the user changed is replaced, and a PDF of an earlier text is removed.
    work.write("out/results/a/feedback.pdf", "spoilt");
    grade("return a.x >= 42", {"--again"});
    EXPECT_THAT(text(), HasSubstr("Its size – 0 of 1"));
    grade("return a.x > 40", {"--again", "--no-pdf"});
    EXPECT_FALSE(std::filesystem::exists(work.path("out/results/a/feedback.pdf")));
}

}  // namespace test_feedback
}  // namespace dynlab::test
