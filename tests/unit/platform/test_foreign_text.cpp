#include "platform/text/foreign_text.h"

#include <gtest/gtest.h>

namespace dynlab {
namespace test_foreign_text {

// oracle: the code charts of IBM code page 850 and of Windows-1252
TEST(foreign_text, names_are_read_in_the_code_page_that_makes_letters_of_them) {
    EXPECT_EQ(utf8_of_name("Chloé 王"), "Chloé 王");
    EXPECT_EQ(utf8_of_name("M\x81ller"), "Müller");  // 850
    EXPECT_EQ(utf8_of_name("donn\x82"
                           "es"),
              "données");
    EXPECT_EQ(utf8_of_name("S\x9Bren Wei\xE1"), "Søren Weiß");
    EXPECT_EQ(utf8_of_name("\x90lise \xD6sak"), "Élise Ísak");
    EXPECT_EQ(utf8_of_name("M\xFCller"), "Müller");  // Windows-1252
    EXPECT_EQ(utf8_of_name("Chlo\xE9"), "Chloé");
    EXPECT_EQ(utf8_of_name("Fran\xE7ois"), "François");
    EXPECT_EQ(utf8_of_windows_1252("Nu\xF1"
                                   "ez \x96 \x80"),
              "Nuñez – €");
}

// oracle: UAX #15, table 1 and 2
TEST(foreign_text, letters_and_their_accents_become_one) {
    EXPECT_EQ(composed("E\u0301lise"), "Élise");
    EXPECT_EQ(composed("\u1112\u1161\u11AB"), "한");
    EXPECT_EQ(composed("は\u309A"), "ぱ");
    EXPECT_EQ(composed("Élise"), "Élise");
    EXPECT_EQ(composed(""), "");
}

}  // namespace test_foreign_text
}  // namespace dynlab
