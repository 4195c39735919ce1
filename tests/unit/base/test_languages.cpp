#include "base/languages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/reader.h"

namespace dynlab {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(languages, english_needs_no_catalog_and_french_has_one) {
    EXPECT_EQ(languages().front(), "en");
    EXPECT_THAT(languages(), Contains("fr"));
    EXPECT_EQ(catalog_of("en"), nullptr);
    ASSERT_NE(catalog_of("fr"), nullptr);
    EXPECT_EQ(number_text(decimals(1.5, 1), {catalog_of("fr")}), "1,5");
    EXPECT_EQ(missing_catalog("fr") + missing_catalog("en"), "");
}

TEST(languages, a_language_needs_only_a_po_file) {
    add_language("xx",
                 "msgid \"{} sample\"\nmsgid_plural \"{} samples\"\nmsgstr[0] \"{} Wert\"\nmsgstr[1] \"{} Werte\"\n");
    EXPECT_THAT(languages(), Contains("xx"));
    const Message three = plural(3, "{} sample", "{} samples");
    EXPECT_EQ(message_text(three, {catalog_of("xx")}), "3 Werte");
}

TEST(languages, missing_and_broken_catalogs_fall_back_to_english_with_a_reason) {
    EXPECT_EQ(catalog_of("zz"), nullptr);
    EXPECT_THAT(missing_catalog("zz"), HasSubstr("zz.po"));
    add_language("yy", "msgid \"a\nmsgstr \"b\"\n");
    testing::internal::CaptureStderr();
    EXPECT_EQ(catalog_of("yy"), nullptr);
    EXPECT_EQ(catalog_of("yy"), nullptr);
    const std::string reported = testing::internal::GetCapturedStderr();
    EXPECT_THAT(reported, testing::StartsWith("dynlab: note: yy.po, line 1"));
    EXPECT_EQ(std::count(reported.begin(), reported.end(), '\n'), 1);  // reported once
    EXPECT_THAT(missing_catalog("yy"), HasSubstr("yy.po, line 1"));
    EXPECT_EQ(message_text(Message("a {}", 1), {catalog_of("yy")}), "a 1");
}

}  // namespace
}  // namespace dynlab
