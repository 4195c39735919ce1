// A language needs only a .po file: a script in German, in the same process as one in French and one in English.
// Oracle: what the catalog languages/de.po says, written by hand, and German rules of numbers and plurals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/languages.h"
#include "documents/percent_script.h"
#include "platform/atomic_file.h"
#include "script_run.h"

namespace dynlab::test {
namespace test_another_language {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class another_language : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        add_language("de", read_text(std::filesystem::path(DYNLAB_SOURCE_DIR) / "tests/scripting/languages/de.po"));
    }
};

const std::string kEstimation =
    "rng(1) local u = prbs(6, 8)\nlocal y = lsim(tf({2}, {1, 1.2, 4}), u, 0.1) + 0.01*randn(#u)\n"
    "local d = iddata(y, u, 0.1)\nprint(d)\npresent(srivc(d, {1, 2, 0}))\n";

TEST_F(another_language, is_read_by_scripts_with_its_numbers_and_plurals) {
    const std::string german = printed(kEstimation, {}, "de");
    EXPECT_THAT(german, AllOf(HasSubstr("iddata: 504 Abtastwerte, 1 Ausgang, 1 Eingang, Ts = 0,1 s"),
                              HasSubstr("zeitkontinuierliche Übertragungsfunktion"), HasSubstr("Pole:"),
                              HasSubstr("Geschätzt mit srivc, Anpassung an die Schätzdaten 9")));
    EXPECT_THAT(german, testing::ContainsRegex("Statische Verstärkung: 0,[45]"));
    EXPECT_THAT(german, testing::ContainsRegex("nach [0-9]+ Durchgängen konvergiert: Anpassung 9[0-9],[0-9]+ %"));
}

TEST_F(another_language, stands_beside_others_in_one_process) {
    EXPECT_THAT(printed(kEstimation, {}, "fr"), AllOf(HasSubstr("Gain statique"), Not(HasSubstr("Verstärkung"))));
    EXPECT_THAT(printed(kEstimation, {}, "en"), AllOf(HasSubstr("Steady-state gain: 0."), Not(HasSubstr("Gain"))));
}

TEST_F(another_language, is_that_of_errors_where_they_are_read) {
    const RunRecord record = run("prnt(1)", {}, "de");
    ASSERT_TRUE(record.error);
    EXPECT_EQ(record.error->text({catalog_of("de")}),
              "lesson.lua:1: eine Funktion oder Variable „prnt“ gibt es nicht; war „print“ gemeint?");
    EXPECT_EQ(record.error->text(), "lesson.lua:1: unknown function or variable 'prnt'; did you mean 'print'?");
}

TEST_F(another_language, messages_without_a_translation_are_english) {
    EXPECT_THAT(run("srivc(1)", {}, "de").error->text({catalog_of("de")}),
                HasSubstr("must be an iddata object, but 1 was given"));
}

TEST_F(another_language, is_one_that_lessons_may_be_in) {
    EXPECT_EQ(
        parse_percent_script("-- ---\n-- title: Eine\n-- language: de\n-- ---\nprint(1)\n", "a.lua").header.language,
        "de");
}

}  // namespace test_another_language
}  // namespace dynlab::test
