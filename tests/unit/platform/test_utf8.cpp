// Characters of UTF-8 and what Unicode says of them. Oracle: the C library's own decoder (in the locale C.UTF-8), RFC
// 3629 and RFC 2781 for what is none, the Unicode standard for letters and widths.
#include "platform/utf8.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cwchar>

#include "platform/utf8_locale.h"

namespace dynlab {
namespace test_utf8 {

using namespace std::string_literals;

const std::string kReplacement = "\xEF\xBF\xBD";

TEST(utf8, differs_from_windows_1252) {
    EXPECT_TRUE(is_utf8("ü"));
    EXPECT_FALSE(is_utf8("\xFC"));
}

TEST(utf8, every_character_as_the_c_library_reads_it) {
    const Utf8Locale locale;
    for (char32_t c = 0; c < 0x110000; ++c) {
        if (c >= 0xD800 && c < 0xE000) continue;
        const std::string bytes = utf8_of(c);
        wchar_t read = 0;
        std::mbstate_t state{};
        const std::size_t length = std::mbrtowc(&read, bytes.data(), bytes.size(), &state);
        ASSERT_EQ(length, c == 0 ? 0 : bytes.size()) << std::hex << static_cast<std::uint32_t>(c);
        ASSERT_EQ(static_cast<char32_t>(read), c);
        const std::string longer = bytes + "\x80";
        std::string_view rest = longer;
        ASSERT_EQ(take_character(rest), c);
        ASSERT_EQ(rest, "\x80");
    }
}

TEST(utf8, two_bytes_are_a_character_where_the_c_library_finds_one) {
    const Utf8Locale locale;
    for (int first = 0x80; first < 0x100; ++first)
        for (int second = 0; second < 0x100; ++second) {
            const std::string bytes = {static_cast<char>(first), static_cast<char>(second)};
            wchar_t read = 0;
            std::mbstate_t state{};
            const bool whole = std::mbrtowc(&read, bytes.data(), 2, &state) == 2;
            std::string_view rest = bytes;
            EXPECT_EQ(take_character(rest).has_value(), whole);
            EXPECT_EQ(rest.size(), whole ? 0u : 1u);
        }
}

// oracle: RFC 3629, 3 and 10
TEST(utf8, each_byte_that_belongs_to_no_character_is_one) {
    for (const std::string& broken :
         {"\xC0\x80"s, "\xE0\x80\x80"s, "\xED\xA0\x80"s, "\xF4\x90\x80\x80"s, "\xF0\x9F\x98"s, "\xE2\x82"s, "\xFF"s}) {
        EXPECT_EQ(characters_in(broken), std::u32string(broken.size(), kNoCharacter));
        EXPECT_EQ(characters_in(broken + "a").back(), U'a');
    }
    EXPECT_EQ(characters_in("\uFFFD"), U"\uFFFD");
    std::string_view replacement = kReplacement;
    EXPECT_TRUE(take_character(replacement).has_value());
    EXPECT_EQ(utf8_of(char32_t{0xD800}) + utf8_of(char32_t{0x110000}), kReplacement + kReplacement);
}

// oracle: RFC 2781, 2.1 and 2.2
TEST(utf8, pairs_of_utf16) {
    EXPECT_EQ(utf16_of("aé\U0001D401\U0010FFFF"), u"aé\xD835\xDC01\xDBFF\xDFFF");
    EXPECT_EQ(utf8_of(std::u16string(u"aé\xD835\xDC01")), "aé\U0001D401");
    EXPECT_EQ(utf8_of(std::u16string{0xD835, u'a', 0xDC01, 0xD835}), kReplacement + "a" + kReplacement + kReplacement);
}

std::string folded_text(std::u32string_view text) {
    std::string folded;
    for (const char32_t c : text) folded += folded_letter(c);
    return folded;
}

TEST(utf8, letters_are_compared_without_accents_case_and_form) {
    EXPECT_EQ(folded_text(U"ÉÇñÅůŹ ŁøĐħŋı ÆœßẞÞð"), "ecnauzlodhniaeoessssthd");
    EXPECT_EQ(folded_text(U"Ļšễ"), "lse");
    EXPECT_EQ(folded_text(U"ﬁﬀﬃﬆĲŉǆſ"), "fiffffistijndzs");
    EXPECT_EQ(folded_text(U"Ｂｒ７ \U0001D401\U0001D5EF\U0001D7D9 ℎℬ"), "br7bb1hb");
    EXPECT_EQ(folded_text(U"ΆΣςϊ ЁЙИ"), "ασσιеии");
    EXPECT_EQ(folded_text(U"٣४"), "34");
    EXPECT_EQ(folded_text(U"王が가"), "王が가");
    EXPECT_EQ(folded_text(U"²ªᵃ½①™'-· ,\u0301\u00AD\uE000"), "");
}

TEST(utf8, what_leaves_no_trace) {
    for (const char32_t c : U"\u0301\u00A8\u02C7\u00AD\u200B\u2060\uFEFF\uFE0F\u202E\U000E0041"s)
        EXPECT_TRUE(is_ignorable(c)) << std::hex << static_cast<std::uint32_t>(c);
    for (const char32_t c : {U'a', U'^', U'`', U' ', U'-', U'é', U'ি'}) EXPECT_FALSE(is_ignorable(c));
}

TEST(utf8, capitals_and_ideographs) {
    for (const char32_t c : {U'A', U'É', U'Ž', U'Σ', U'Й', U'Ｂ', U'\U0001D401'}) EXPECT_TRUE(is_capital(c));
    for (const char32_t c : {U'a', U'é', U'ß', U'σ', U'й', U'1', U'王'}) EXPECT_FALSE(is_capital(c));
    for (const char32_t c : {U'王', U'の', U'カ', U'ー', U'김', U'\U00020000'}) EXPECT_TRUE(is_ideograph(c));
    for (const char32_t c : {U'a', U'é', U'Й', U'ا'}) EXPECT_FALSE(is_ideograph(c));
}

// Oracle: the scripts of UAX #24 and their codes of ISO 15924; the directions of UAX #9.
TEST(utf8, scripts_directions_and_marks) {
    for (const auto& [c, name, code] : {std::tuple{U'é', "Latin", "Latn"},
                                        {U'Ω', "Greek", "Grek"},
                                        {U'Й', "Cyrillic", "Cyrl"},
                                        {U'द', "Devanagari", "Deva"},
                                        {U'王', "Han", "Hani"},
                                        {U'\u0301', "", ""},
                                        {U'1', "", ""},
                                        {U'\uE000', "", ""}}) {
        EXPECT_EQ(script_of(c).name, name);
        EXPECT_EQ(script_of(c).code, code);
    }
    for (const char32_t c : {U'ד', U'م'}) EXPECT_TRUE(is_right_to_left(c));
    for (const char32_t c : {U'a', U'1', U' ', U'王'}) EXPECT_FALSE(is_right_to_left(c));
    for (const char32_t c : {U'\u0301', U'\u05B8', U'ि'}) EXPECT_TRUE(is_mark(c));
    for (const char32_t c : {U'a', U'ד', U'-'}) EXPECT_FALSE(is_mark(c));
}

// oracle: UAX #11 and what the C library's wcwidth says of the same
TEST(utf8, columns_of_a_terminal) {
    const Utf8Locale locale;
    for (const char32_t c : U"aé\u0301日カｶＡ한€αЙ\U0001F408\u200B"s)
        EXPECT_EQ(static_cast<int>(columns_of(c)), ::wcwidth(static_cast<wchar_t>(c)))
            << std::hex << static_cast<std::uint32_t>(c);
    EXPECT_EQ(columns_of("Zoe\u0308 日本\xFF"), 3u + 1 + 4 + 1);
}

}  // namespace test_utf8
}  // namespace dynlab
