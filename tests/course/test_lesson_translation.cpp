// Lessons in two languages, and checks that students read. Oracles: a lesson that is planted with one fault at a time.
#include "course/grading/lesson_translation.h"

#include <gmock/gmock.h>

#include "course/grading/lesson_trial.h"
#include "course/grading_bench.h"
#include "workflow/student_copy.h"

namespace dynlab::test {
namespace test_lesson_translation {
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kChecks =
    "check{id = 'K', points = 2, about = \"The gain\", test = function(a) return near(a.K, 8.5) end,\n"
    "  mistakes = {{when = function(a) return a.K < 0 end, say = \"The sign is \\\"wrong\\\".\"}},\n"
    "  hint = \"Output over input.\"}\n";

class lesson_translation : public testing::Test {
  protected:
    lesson_translation() {
        bench_.write(
            "80_gain/lesson.lua",
            "-- ---\n-- title: A gain\n-- lesson: 80_gain\n-- language: en\n-- answers:\n--   K: number\n-- ---\n\n"
            "-- %% [markdown]\n-- Find the gain.\n--\n-- Twice.\n\n-- %%\n-- BEGIN SOLUTION\n"
            "answer('K', 17/2)\n-- END SOLUTION\n\n-- %% [markdown]\n-- The end.\n");
        bench_.write("80_gain/checks.lua", kChecks);
        lesson_ = *lesson_in(bench_.path("80_gain"));
    }
    std::string faults() const {
        std::string text;
        for (const LessonFault& fault : faults_of_texts(lesson_))
            text += fault.file + ": " + message_text(fault.what) + "\n";
        return text;
    }
    Workbench bench_;
    Lesson lesson_;
};

TEST_F(lesson_translation, sentences_of_checks_are_found_once) {
    EXPECT_THAT(sentences_of_checks(std::string(kChecks) + kChecks),
                ElementsAre("The gain", "The sign is \"wrong\".", "Output over input."));
}

// oracle: dynlab sheet, which refuses such tasks
TEST_F(lesson_translation, tasks_without_their_language_are_reported) {
    write_translation_skeleton(lesson_, "fr");
    std::string tasks = bench_.read("80_gain/tasks.fr.lua");
    EXPECT_THAT(faults(), testing::Not(HasSubstr("tasks.fr.lua")));
    tasks.erase(tasks.find("-- language: fr\n"), 16);
    bench_.write("80_gain/tasks.fr.lua", tasks);
    EXPECT_THAT(faults(), HasSubstr("tasks.fr.lua: the header has \"language: en\""));
}

TEST_F(lesson_translation, sentences_that_are_not_translated_are_counted) {
    bench_.write("80_gain/checks.fr.po", "msgid \"The gain\"\nmsgstr \"Le gain\"\n");
    EXPECT_THAT(faults(), HasSubstr("checks.fr.po: 2 of 3 sentences in checks.lua have no translation; the first is \""
                                    "The sign is"));
    bench_.write("80_gain/tasks.fr.lua",
                 "-- ---\n-- title: Un gain\n-- language: fr\n-- ---\n\n-- %% [markdown]\n-- A\n\n"
                 "-- %% [markdown]\n-- B\n");
    bench_.shell("rm 80_gain/checks.fr.po");
    EXPECT_THAT(faults(), HasSubstr("checks.fr.po: the file is missing"));
}

TEST_F(lesson_translation, the_skeleton_holds_every_cell_and_every_sentence) {
    bench_.write("80_gain/checks.fr.po", "msgid \"The gain\"\nmsgstr \"Le gain\"\n");
    EXPECT_EQ(write_translation_skeleton(lesson_, "fr").size(), 2u);
    const PercentScript tasks = read_percent_script(lesson_.tasks("fr"));
    ASSERT_EQ(tasks.cells.size(), 2u);
    EXPECT_EQ(tasks.header.language, "fr");
    EXPECT_THAT(tasks.cells[0].content, HasSubstr("Find the gain.\n\nTwice."));
    lesson_script(lesson_, "fr");  // fits the lesson
    const std::string words = bench_.read("80_gain/checks.fr.po");
    EXPECT_THAT(words, HasSubstr("msgstr \"Le gain\"\n"));
    EXPECT_THAT(words, HasSubstr("msgid \"The sign is \\\"wrong\\\".\"\nmsgstr \"\"\n"));
    EXPECT_THAT(write_translation_skeleton(lesson_, "fr"), IsEmpty());
}

// oracle: the number in the check, which a student can copy
TEST_F(lesson_translation, checks_that_give_the_answer_away_are_warned_of) {
    GradingSetup setup;
    setup.lesson = lesson_;
    setup.isolation = strongest_isolation();
    setup.program = DYNLAB_PROGRAM;
    const auto warnings = [&] {
        std::string text;
        for (const LessonFault& one : giveaways_of(try_checks_of(setup, Mutants::kNone)))
            text += message_text(one.what) + "\n";
        return text;
    };
    EXPECT_THAT(warnings(), HasSubstr("pass the check \"K\" by entering K = 8.5"));
    bench_.write("80_gain/checks.lua",
                 "local y, u = 17, 2\ncheck{id = 'K', test = function(a) return near(a.K, y/u) end}\n");
    EXPECT_EQ(warnings(), "");
}

}  // namespace test_lesson_translation
}  // namespace dynlab::test
