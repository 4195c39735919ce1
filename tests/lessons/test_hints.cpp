// Hints of the lessons and how they are given. Oracles: the questions in the lessons' sources, and hand-written files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "documents/error.h"
#include "platform/atomic_file.h"
#include "support/program.h"
#include "workflow/hints.h"
#include "workflow/lesson_catalog.h"

namespace dynlab::test {
namespace test_hints {
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::set<int> questions_of(const Lesson& lesson) {
    const std::string source = read_text(lesson.script());
    const std::regex question("\\*\\*Question ([0-9]+)");
    std::set<int> numbers;
    for (std::sregex_iterator it(source.begin(), source.end(), question), end; it != end; ++it)
        numbers.insert(std::stoi((*it)[1]));
    return numbers;
}

TEST(hints, are_two_or_three_for_each_question_of_each_lesson_and_in_french_where_its_tasks_are) {
    std::size_t read = 0;
    for (const Lesson& lesson : lessons()) {
        for (const std::string language : {"en", "fr"}) {
            if (language == "fr" && !std::filesystem::exists(lesson.folder / "tasks.fr.lua")) continue;
            SCOPED_TRACE(lesson.slug + " " + language);
            std::set<int> answered;
            for (const auto& [question, stages] : read_hints(lesson.hints(language))) {
                answered.insert(question);
                EXPECT_TRUE(stages.size() == 2 || stages.size() == 3) << question;
            }
            EXPECT_EQ(answered, questions_of(lesson));
            ++read;
        }
    }
    EXPECT_EQ(read, 12u);
}

TEST(hints, are_read_stage_by_stage) {
    const Hints hints =
        hints_in("# Question 2\n\n1. Look at\n   the end.\n2. Then `step`.\n\n# Question 10\n1. Yes.\n", "hints.md");
    ASSERT_EQ(hints.size(), 2u);
    EXPECT_THAT(hints.at(2), ElementsAre("Look at the end.", "Then `step`."));
    EXPECT_THAT(hints.at(10), ElementsAre("Yes."));
}

std::string complaint(const std::string& text) {
    try {
        hints_in(text, "hints.md");
    } catch (const DocumentError& error) {
        return error.what();
    }
    return "";
}

TEST(hints, that_cannot_be_read_are_reported_with_their_line) {
    EXPECT_THAT(complaint("## Question 2\n"), AllOf(HasSubstr("hints.md:1"), HasSubstr("# Question 4")));
    EXPECT_THAT(complaint("1. Look.\n"), AllOf(HasSubstr("hints.md:1"), HasSubstr("heading")));
    EXPECT_THAT(complaint("# Question 1\n1. a\n3. b\n"), AllOf(HasSubstr("hints.md:3"), HasSubstr("hint 2")));
    EXPECT_THAT(complaint("# Question 1\n1. a\nb\n"), HasSubstr("indent the continuation lines"));
    EXPECT_THAT(complaint("# Question 1\n   a\n"), HasSubstr("hints.md:2"));
    EXPECT_THAT(complaint("# Question 1\n1. a\n# Question 1\n"), AllOf(HasSubstr("hints.md:3"), HasSubstr("already")));
}

// oracle: the file of the lesson
TEST(hints, are_given_one_at_a_time) {
    const Workbench bench;
    const std::vector<std::string> stages = read_hints(find_lesson("04").hints("en")).at(4);
    ASSERT_EQ(stages.size(), 3u);
    const auto begins = [&](std::size_t i) {  // as a terminal shows it: without the marks of code
        std::string text = stages[i].substr(0, 20);
        std::erase(text, '`');
        return text;
    };
    const std::string first = bench.dynlab({"hint", "04", "4"}).output;
    EXPECT_THAT(first, AllOf(HasSubstr("Hint 1 of 3"), HasSubstr(begins(0)), HasSubstr("Hints remaining: 2."),
                             Not(HasSubstr("Hint 2"))));
    EXPECT_EQ(bench.dynlab({"hint", "4", "4"}).output.find("Hint 2"), std::string::npos) << "asked again, told again";
    EXPECT_THAT(bench.dynlab({"hint", "04", "4", "--next"}).output,
                AllOf(HasSubstr("Hint 1 of 3"), HasSubstr("Hint 2 of 3"), HasSubstr("Hints remaining: 1."),
                      Not(HasSubstr("Hint 3"))));
    EXPECT_THAT(bench.dynlab({"hint", "04"}).output, HasSubstr("question  4   hints: 3, seen: 2"));
    EXPECT_THAT(bench.dynlab({"hint", "04", "4", "--all"}).output,
                AllOf(HasSubstr("Hint 3 of 3"), HasSubstr("the last hint")));
    const ChildResult none = bench.dynlab({"hint", "04", "40"});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_THAT(none.error_output, HasSubstr("Questions with hints: 1, 2, 3, 4,"));
}

TEST(hints, of_a_copy_are_in_its_language_and_not_in_its_files) {
    const Workbench bench;
    ASSERT_EQ(bench.dynlab({"new", "03_crane", "grue", "--lang", "fr"}).exit_code, 0);
    const std::string stage = read_hints(find_lesson("03_crane").hints("fr")).at(4).at(0);
    EXPECT_THAT(
        bench.dynlab({"hint", "grue", "4"}).output,
        AllOf(HasSubstr("Leçon 03_crane, question 4\n"), HasSubstr("Indice 1 sur 3\n"), HasSubstr(stage.substr(0, 40)),
              HasSubstr("Indices restants : 2. Pour afficher l'indice suivant, lancez :  dynlab hint grue 4 --next")));
    EXPECT_THAT(bench.dynlab({"hint", "grue", "4", "--all"}).output,
                HasSubstr("C'est le dernier indice. Pour créer le corrigé, lancez :"));
    EXPECT_THAT(bench.dynlab({"hint", "grue"}).output, HasSubstr("question  4   indices : 3, déjà vus : 3\n"));
    EXPECT_THAT(bench.read("grue/analysis.lua") + bench.read("grue/report.md"), Not(HasSubstr(stage.substr(0, 20))));
}

}  // namespace test_hints
}  // namespace dynlab::test
