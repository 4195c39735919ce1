// Oracle: the texts, written here by hand.
#include <gtest/gtest.h>

#include "documents/complaints.h"
#include "documents/error.h"

namespace dynlab {
namespace test_document_error {

TEST(document_error, begins_with_its_place_and_keeps_place_and_sentence_apart) {
    const DocumentError error(Place{"a/report.md", 7}, Message("key \"{}\" occurs twice", "title"));
    EXPECT_STREQ(error.what(), "a/report.md:7: key \"title\" occurs twice");
    EXPECT_EQ(message_text(error.message()), error.what());
    EXPECT_EQ(error.place().file, "a/report.md");
    EXPECT_EQ(error.place().line, 7);
    EXPECT_EQ(error.sentence().id(), "key \"{}\" occurs twice");
    EXPECT_STREQ(DocumentError(Place{"report.md"}, Message("it is too long")).what(), "report.md: it is too long");
}

TEST(document_error, that_quotes_a_zero_byte_says_what_follows_it) {
    const std::string line("a\0b", 3);
    EXPECT_STREQ(DocumentError(Place{"x.lua", 1}, Message("header: {}", Message("\"{}\" is odd", line))).what(),
                 "x.lua:1: header: \"a?b\" is odd");
}

TEST(document_error, of_many_complaints_has_the_first_ten_a_line_each) {
    Complaints complaints;
    for (int line = 1; line <= 12; ++line) complaints.add({"report.md", line}, Message("wrong"));
    complaints.add({"report.md", 12}, Message("wrong"));  // the same again
    std::string expected;
    for (int line = 1; line <= 10; ++line) expected += "report.md:" + std::to_string(line) + ": wrong\n";
    try {
        complaints.throw_if_any();
        FAIL();
    } catch (const DocumentError& error) {
        EXPECT_EQ(error.what(), expected + "and 2 more problems");
    }
}

}  // namespace test_document_error
}  // namespace dynlab
