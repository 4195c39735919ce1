#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"
#include "documents/words/characters.h"

namespace dynlab {
namespace test_characters {

using testing::HasSubstr;

const char* const kDeclared = "\\DeclareUnicodeCharacter{03C9}{\\dynlabsymbol{\\omega}} % ω\n";

// Oracle: the Unicode code charts.
TEST(characters, latex_prints_ascii_western_letters_and_declared_symbols) {
    const PrintableCharacters latex = PrintableCharacters::of_latex(kDeclared);
    for (const char32_t c : {U'a', U'~', U'é', U'œ', U'ß', U'Š', U'“', U'–', U'ω'}) EXPECT_TRUE(latex.can_print(c));
    for (const char32_t c : {U'θ', U'你', U'😀', U'\u0301', U'\x1b'}) EXPECT_FALSE(latex.can_print(c));
    EXPECT_EQ(code_of(U'θ'), "U+03B8");
    EXPECT_EQ(code_of(U'😀'), "U+1F600");
}

TEST(characters, broken_text_and_control_characters_are_named) {
    for (const auto& printable : {PrintableCharacters::of_latex(kDeclared), PrintableCharacters::of_html()}) {
        EXPECT_THAT(message_text(printable.complaint("\xff").value()), HasSubstr("UTF-8"));
        EXPECT_THAT(message_text(printable.complaint("\xc3").value()), HasSubstr("UTF-8"));
        EXPECT_THAT(message_text(printable.complaint("\xc0\xaf").value()), HasSubstr("UTF-8")) << "overlong form";
        EXPECT_THAT(message_text(printable.complaint("\xed\xa0\x80").value()), HasSubstr("UTF-8")) << "surrogate";
        EXPECT_THAT(message_text(printable.complaint("\x1b[31m").value()), HasSubstr("control character U+001B"));
    }
    EXPECT_FALSE(PrintableCharacters::of_html().complaint("你好 😀"));
}

}  // namespace test_characters
}  // namespace dynlab
