// The questions with which a lesson's reader checks what was understood. Oracle: the notation, read here a second time,
// and poppler's reading of the sheet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "lesson_record.h"
#include "workflow/lesson_catalog.h"
#include "workflow/measures.h"

namespace dynlab::test {
namespace test_self_check {
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
}

TEST(self_check, has_five_questions_a_lesson_each_with_one_right_answer_and_a_reason_for_every_option) {
    for (const Lesson& lesson : lessons()) {
        SCOPED_TRACE(lesson.slug);
        const std::string text = read_text(lesson.self_check());
        EXPECT_EQ(count(text, "::: choice\n"), 5u);
        EXPECT_EQ(count(text, "\n- [x] "), 5u);
        EXPECT_EQ(count(text, "\n- [ ] "), 10u);
        const std::regex with_reason("- \\[[ x]\\] [^\n]+\n\n  [^\n]+[.*)]\n");
        EXPECT_EQ(std::distance(std::sregex_iterator(text.begin(), text.end(), with_reason), std::sregex_iterator()),
                  15);
        std::set<std::size_t> places;  // no reader learns "always the second"
        for (std::size_t at = text.find("::: choice"); at != std::string::npos; at = text.find("::: choice", at + 1))
            places.insert(count(text.substr(at, text.find("\n- [x]", at) - at), "\n- [ ]"));
        EXPECT_GE(places.size(), 2u);
    }
}

/// The reasons of a self-check: the indented paragraphs below its options.
std::vector<std::string> reasons_in(const std::string& questions) {
    std::vector<std::string> reasons;
    const std::regex reason("\n\n  ([^\n]+)\n");
    for (std::sregex_iterator it(questions.begin(), questions.end(), reason), end; it != end; ++it)
        reasons.push_back((*it)[1]);
    return reasons;
}

TEST(self_check, of_task_sheets_has_questions_without_answers) {
    const Workbench bench(Workbench::Memory::kShared);
    const std::string text = bench.shell("pdftotext -layout '" + shared_sheet("05_thruster") + "' -").output;
    EXPECT_LT(text.find("Question 10."), text.find("Five questions to check yourself"));
    EXPECT_THAT(text, AllOf(HasSubstr("Bad luck."), HasSubstr("An error of the structure.")));
    EXPECT_THAT(text, AllOf(Not(HasSubstr("Answers to the questions")), Not(HasSubstr("Luck would change")),
                            Not(HasSubstr("[x]"))));
    std::size_t sheets = 0;
    for (const Lesson& lesson : lessons())
        for (const std::string language : {"en", "fr"}) {
            if (language == "fr" && !std::filesystem::exists(lesson.tasks(language))) continue;
            SCOPED_TRACE(lesson.slug + " " + language);
            std::vector<std::string> command{"sheet", lesson.slug, "-o", "sheet.html"};
            if (language == "fr") command.insert(command.end(), {"--lang", language});
            const ChildResult made = bench.dynlab(command);
            ASSERT_EQ(made.exit_code, 0) << made.error_output;
            const std::string page = bench.read("sheet.html");
            const std::string questions = read_text(lesson.self_check(language));
            EXPECT_EQ(count(page, "<details"), 0u);
            const std::vector<std::string> reasons = reasons_in(questions);
            EXPECT_EQ(reasons.size(), 15u);
            for (const std::string& reason : reasons) EXPECT_THAT(page, Not(HasSubstr(reason.substr(0, 30)))) << reason;
            ++sheets;
        }
    EXPECT_EQ(sheets, 12u);
}

TEST(self_check, of_reports_with_solutions_has_the_answers) {
    const Workbench bench(Workbench::Memory::kShared);
    const std::string text =
        bench
            .shell("pdftotext -layout '" +
                   shared_document({"report", "02_least_squares"}, "02_least_squares.en.pdf").string() + "' -")
            .output;
    EXPECT_LT(text.find("Five questions to check yourself"), text.find("Answers to the questions"));
    EXPECT_LT(text.find("Answers to the questions"), text.find("All three methods minimize the same sum of squares."));
    EXPECT_NE(text.find("All three methods minimize the same sum of squares."), std::string::npos);
    ASSERT_EQ(bench.dynlab({"new", "05", "mine"}).exit_code, 0);
    EXPECT_THAT(bench.read("mine/analysis.lua"), Not(HasSubstr("choice")));
}

TEST(self_check, and_tasks_are_french_where_french_is_asked_for) {
    const Workbench bench(Workbench::Memory::kShared);
    for (const Lesson& lesson : {find_lesson("03_crane"), find_lesson("05"), find_lesson("06"), find_lesson("07")}) {
        SCOPED_TRACE(lesson.slug);
        const std::string text = bench.shell("pdftotext -layout '" + shared_sheet(lesson.slug, "fr") + "' -").output;
        EXPECT_THAT(text, AllOf(HasSubstr("Cinq questions"), HasSubstr("Question 10.")));
        for (const char* word : {" is ", " are ", " your ", " what ", " with ", " which "})
            EXPECT_THAT(text, Not(HasSubstr(word)));
        // The same answers are right, option by option.
        const auto signs = [&](const std::string& language) {
            const std::string questions = read_text(lesson.self_check(language));
            std::string found;
            for (std::size_t at = questions.find("\n- ["); at != std::string::npos;
                 at = questions.find("\n- [", at + 1))
                found += questions[at + 4];
            return found;
        };
        EXPECT_EQ(signs("fr"), signs("en"));
        EXPECT_EQ(count(signs("fr"), "x"), 5u);
    }
    const ChildResult refused = bench.dynlab({"sheet", "02", "--lang", "fr"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.error_output, HasSubstr("n'a pas d'énoncé dans la langue"));
}

TEST(french_tasks, give_equations_their_article) {  // "Estimez équation 2" is no French
    const std::regex bare("(^|[^'(])@eq:[a-z_]+");
    for (const char* slug : {"03_crane", "05", "06", "07"}) {
        const std::filesystem::path tasks = find_lesson(slug).folder / "tasks.fr.lua";
        const std::string text = read_text(tasks);
        std::smatch found;
        EXPECT_FALSE(std::regex_search(text, found, bare)) << tasks << ": " << found.str();
    }
}

TEST(measures, have_the_same_formulas_in_french) {
    const auto english = measures_for_documents("en"), french = measures_for_documents("fr");
    EXPECT_GE(english.size(), 9u);
    ASSERT_EQ(french.size(), english.size());
    const std::regex formula(R"(\$\$[^$]+\$\$)");
    for (const auto& [name, text] : english) {
        ASSERT_TRUE(french.contains(name)) << name;
        std::smatch here, there;
        ASSERT_TRUE(std::regex_search(text, here, formula) && std::regex_search(french.at(name), there, formula));
        EXPECT_EQ(here.str(), there.str());
        EXPECT_NE(text, french.at(name));
    }
}

// oracle: the file of the lesson, and the values that its run reported
TEST(talk_sheets, have_answers_for_the_instructor_only) {
    const Workbench bench(Workbench::Memory::kShared);
    const ChildResult made = bench.dynlab({"sheet", "05", "--talk", "-o", "ask.md"});
    ASSERT_EQ(made.exit_code, 0) << made.error_output;
    const std::string asked = bench.read("ask.md");
    ASSERT_EQ(bench.dynlab({"sheet", "05", "--talk", "--answers", "-o", "answer.md"}).exit_code, 0);
    const std::string answered = bench.read("answer.md");
    const std::string source = read_text(find_lesson("05").talk_questions());
    const std::size_t questions = count("\n" + source, "\n# ");
    EXPECT_GE(questions, 8u);
    EXPECT_EQ(count(asked, "?**"), questions);
    EXPECT_EQ(count(answered, "?**"), questions);
    EXPECT_THAT(asked, Not(HasSubstr("The sine visits all widths")));
    EXPECT_THAT(answered, AllOf(HasSubstr("The sine visits all widths"), Not(HasSubstr(".value}"))));
    EXPECT_THAT(answered, Not(HasSubstr("local "))) << "no code";
    EXPECT_EQ(bench.dynlab({"sheet", "02", "--talk"}).exit_code, 1);
    EXPECT_EQ(bench.dynlab({"sheet", "05", "--answers"}).exit_code, 2);
}

}  // namespace test_self_check
}  // namespace dynlab::test
