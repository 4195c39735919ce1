#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/course_aliases.h"

namespace dynlab::test {
namespace test_course_aliases {
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Words = std::vector<std::string>;

Words renamed(const Words& words) {
    std::string note;
    Words now = with_new_names(words, note);
    EXPECT_EQ(note.empty(), now == words) << note;
    return now;
}

// oracle: the table of old and new names
TEST(course_aliases, old_names_become_new_ones_with_a_note) {
    EXPECT_THAT(renamed({"course", "peer", "send", "crane"}), ElementsAre("course", "review", "send", "crane"));
    EXPECT_THAT(renamed({"course", "--course", "k", "receive", "a.zip"}),
                ElementsAre("course", "--course", "k", "submit", "a.zip"));
    EXPECT_THAT(renamed({"--course", "x", "course", "--course=k", "final", "receive", "a.pdf"}),
                ElementsAre("--course", "x", "course", "--course=k", "submit", "--stage", "final", "a.pdf"));
    EXPECT_THAT(renamed({"course", "assignment", "remove", "carne"}),
                ElementsAre("course", "assignment", "--remove", "carne"));
    EXPECT_THAT(renamed({"course", "roster", "return", "g1"}), ElementsAre("course", "drop", "--end", "g1"));
    std::string note;
    with_new_names({"course", "override", "crane", "g1", "work", "60"}, note);
    EXPECT_THAT(note, HasSubstr("dynlab course override is now dynlab course mark"));
    EXPECT_THAT(renamed({"look", "a.csv"}), ElementsAre("inspect", "a.csv"));
    EXPECT_THAT(renamed({"--course", "x", "hand-back", "marks"}),
                ElementsAre("--course", "x", "export-grades", "marks"));
    with_new_names({"look", "look"}, note);
    EXPECT_THAT(note, HasSubstr("dynlab look is now dynlab inspect"));
    EXPECT_THAT(renamed({"manual", "folder", "--timings"}), ElementsAre("site", "folder", "--timings"));
}

// oracle: only the command itself is a name, no file and no group of the same name
TEST(course_aliases, other_words_stay) {
    for (const Words& words :
         {Words{"course", "submit", "receive"}, Words{"course", "extend", "time", "return"}, Words{"grade", "receive"},
          Words{"run", "look"}, Words{"course"}, Words{"course", "peer"}, Words{},
          Words{"course", "review", "assign", "crane"}, Words{"run", "course", "release"}, Words{"help", "manual"}})
        EXPECT_EQ(renamed(words), words);
}

// oracle: the old commands had a name behind add, change and remove
TEST(course_aliases, an_assignment_may_be_called_as_an_old_command) {
    for (const Words& words :
         {Words{"course", "assignment", "add", "--first", "2026-03-01 12:00"}, Words{"course", "assignment", "change"},
          Words{"course", "assignment", "remove", "--reason", "x"}})
        EXPECT_EQ(renamed(words), words);
    EXPECT_THAT(renamed({"course", "assignment", "add", "remove", "--first", "x"}),
                ElementsAre("course", "assignment", "remove", "--first", "x"));
}

}  // namespace test_course_aliases
}  // namespace dynlab::test
