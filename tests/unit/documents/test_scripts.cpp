#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "documents/words/scripts.h"

namespace dynlab {
namespace test_scripts {

using testing::ElementsAre;
using testing::IsEmpty;

const PrintableCharacters kPdflatex = PrintableCharacters::of_latex(
    "\\DeclareUnicodeCharacter{03C9}{}\n\\DeclareUnicodeCharacter{0394}{}\n\\DeclareUnicodeCharacter{03B1}{}\n");

// Oracle: the scripts of UAX #24 and their codes of ISO 15924.
TEST(scripts, are_named_once_and_latin_is_not) {
    EXPECT_THAT(scripts_of(kPdflatex, "Élise, Nguyễn, ω 12"), IsEmpty());
    EXPECT_THAT(scripts_of(kPdflatex, "Дмитрий 王小明 محمد 王"),
                ElementsAre("Arabic=arab", "Cyrillic=cyrl", "Han=hani"));
    EXPECT_THAT(scripts_of(kPdflatex, "दे 한 か"), ElementsAre("Devanagari=deva", "Hangul=hang", "Hiragana=hira"));
}

TEST(scripts, greek_letters_are_symbols_unless_they_make_a_word) {
    EXPECT_THAT(scripts_of(kPdflatex, "Δω Дa"), ElementsAre("Cyrillic=cyrl"));
    EXPECT_FALSE(first_beyond(kPdflatex, "Δω, ωαω, é"));
    EXPECT_EQ(first_beyond(kPdflatex, "Δω αωαω"), U'α') << "a word of four letters";
    EXPECT_EQ(first_beyond(kPdflatex, "Δό"), U'ό') << "a letter that pdflatex does not have";
    EXPECT_THAT(scripts_of(kPdflatex, "Δό"), ElementsAre("Greek=grek"));
}

TEST(scripts, letters_are_replaced_singly_and_accents_are_left_out) {
    const auto beyond = letters_beyond(kPdflatex, "é Д o\u0300 ω");
    EXPECT_THAT(beyond, ElementsAre(U'\u0300', U'Д'));
    EXPECT_EQ(without_letters("é Д o\u0300 ω", beyond), "é ? o ω");
}

// Oracle: U+200E by hand around each phrase.
TEST(scripts, right_to_left_phrases_get_marks_and_links_do_not) {
    EXPECT_EQ(with_direction_marks("a דוד בן 12 {b}"), "a \u200Eדוד בן\u200E 12 {b}");
    EXPECT_EQ(with_direction_marks("محمد~علي, دوד"), "\u200Eمحمد~علي\u200E, \u200Eدوד\u200E");
    EXPECT_EQ(with_direction_marks("שָׁלוֹם."), "\u200Eשָׁלוֹם\u200E.") << "with vowel signs";
    EXPECT_EQ(with_direction_marks("\\href{https://x.org/דוד}{דוד}"), "\\href{https://x.org/דוד}{\u200Eדוד\u200E}");
    EXPECT_EQ(with_direction_marks("דוד\na & דוד \\\\\nדוד"),
              "\u200Eדוד\u200E\na & \\mbox{\u200Eדוד\u200E} \\\\\n\u200Eדוד\u200E");
    EXPECT_EQ(with_direction_marks("plain é"), "plain é");
}

}  // namespace test_scripts
}  // namespace dynlab
