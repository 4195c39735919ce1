// Text in bytes of any kind. Oracle: RFC 2781 (UTF-16), RFC 3629 (UTF-8), the XML recommendation 4.1 and 4.6,
// HTML 4.01 24.
#include "course/names/byte_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dynlab {
namespace test_byte_text {

using namespace std::string_literals;
using testing::HasSubstr;
using testing::Not;

const std::string kMathematicalB = "\xF0\x9D\x90\x81";  // U+1D401 in UTF-8; D835 DC01 in UTF-16
const std::string kReplacement = "\xEF\xBF\xBD";

TEST(byte_text, utf16_of_either_order_with_pairs_of_units) {
    EXPECT_EQ(text_in("\xFE\xFF\0A\0\xE9\x04\x1F\xD8\x35\xDC\x01\xDB\xFF\xDF\xFF"s),
              "Aé\u041F" + kMathematicalB + "\U0010FFFF");
    EXPECT_EQ(text_in("\xFF\xFE"
                      "A\0\x35\xD8\x01\xDC\xAC\x20"s),
              "A" + kMathematicalB + "€");
}

TEST(byte_text, half_a_pair_is_no_character) {
    EXPECT_EQ(text_in("\xFE\xFF\xD8\x35\0A"s), kReplacement + "A");
    EXPECT_EQ(text_in("\xFE\xFF\xDC\x01\0A"s), kReplacement + "A");
    EXPECT_EQ(text_in("\xFE\xFF\0A\xD8\x35"s), "A" + kReplacement);
    EXPECT_EQ(text_in("\xFE\xFF\xD8\x35\xD8\x35\xDC\x01"s), kReplacement + kMathematicalB);
}

TEST(byte_text, runs_of_utf16_without_a_mark) {
    const std::string noise = "\x01\x02\x80\x81\x90\x03"s;
    EXPECT_THAT(text_in(noise + "\0B\0o\0l\0d"s + noise), HasSubstr("Bold"));
    std::string bold;
    for (int i = 0; i < 4; ++i) bold += "\xD8\x35\xDC\x01";
    EXPECT_THAT(text_in(noise + bold + noise),
                HasSubstr(kMathematicalB + kMathematicalB + kMathematicalB + kMathematicalB));
}

TEST(byte_text, references_by_number) {
    EXPECT_EQ(without_references("Zo&#xE9; &#233;&#Xe9; &#x1D401;&#119809; &#0000000233;"),
              "Zoé éé " + kMathematicalB + kMathematicalB + " é");
    for (const char* none : {"&#0;", "&#xD835;", "&#xDFFF;", "&#x110000;"})
        EXPECT_EQ(without_references(none), kReplacement) << none;
}

TEST(byte_text, references_by_name) {
    EXPECT_EQ(without_references("R&amp;D &lt;b&gt; &quot;&apos;"), "R&D <b> \"'");
    EXPECT_EQ(without_references("M&uuml;ller Zo&eacute; &Aring;&yuml;&szlig;&OElig;&scaron;"), "Müller Zoé ÅÿßŒš");
    EXPECT_EQ(without_references("a&nbsp;b&shy;c&zwnj;d"), "a\u00A0b\u00ADc\u200Cd");
    EXPECT_EQ(without_references("&amp;lt;"), "&lt;");  // once
}

TEST(byte_text, what_is_no_reference_stays) {
    for (const std::string text :
         {"R&D", "&", "a & b; c", "&;", "&#;", "&#x;", "&#12x;", "&#-1;", "&unheard;", "&amp", "&#99999999999;"})
        EXPECT_EQ(without_references(text), text);
}

}  // namespace test_byte_text
}  // namespace dynlab
