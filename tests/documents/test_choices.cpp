// Self-check questions. Oracle: the notation and the valid places of answers, written here by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "document_fixture.h"
#include "support/pdf_inspection.h"

namespace dynlab {
namespace test_choices {

using choices = DocumentTest;
using test::inspect_pdf;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const char* const kTwo = R"(# Before

::: choice
What is $2^3$?

- [ ] Six.

  That is 2 times 3.
- [x] Eight.

  Three factors `2`.
:::

::: choice
Which are even?

- [x] Two.

  Two halves of one.
- [x] Four.

  Two halves of two.
- [ ] Five.

  One is left over.
:::

# After

The end.
)";

TEST_F(choices, have_their_answers_at_the_end_of_printed_documents) {
    std::string text;
    for (const std::string& page : inspect_pdf(make(kTwo, "out.pdf")).pages) text += page;
    for (const char* shown : {"a) Six.", "b) Eight.", "c) Five.", "Answers to the questions",
                              "Wrong. That is 2 times 3.", "Right. Three factors 2.", "2. a), b)"})
        EXPECT_THAT(text, HasSubstr(shown));
    EXPECT_LT(text.find("The end."), text.find("Answers to the questions"));
    EXPECT_LT(text.find("Answers to the questions"), text.find("That is 2 times 3"));
    EXPECT_THAT(text, Not(HasSubstr("[x]")));
}

TEST_F(choices, are_folded_below_their_question_in_html) {
    const std::string page = html(kTwo);
    const std::size_t first = page.find("<details"), closed = page.find("</details>"),
                      second = page.find("<details", closed);
    ASSERT_NE(second, std::string::npos);
    EXPECT_LT(first, page.find("That is 2 times 3"));
    EXPECT_LT(page.find("That is 2 times 3"), closed);
    EXPECT_LT(closed, page.find("Which are even"));
    EXPECT_EQ(page.find("open", first), page.find("open", second)) << "folded";
    EXPECT_THAT(page, AllOf(HasSubstr("<summary>Answer</summary>"), Not(HasSubstr("Answers to the questions"))));
}

TEST_F(choices, that_are_not_whole_are_reported_with_their_line) {
    const auto reported = [&](const std::string& body) { return refusal("Text.\n\n::: choice\n" + body + ":::\n"); };
    EXPECT_THAT(reported("Why?\n\n- [ ] a\n\n  No.\n- [ ] b\n\n  No.\n"), HasSubstr("a correct option"));
    EXPECT_THAT(reported("Why?\n\n- [x] a\n- [ ] b\n"),
                AllOf(HasSubstr(":4: "), HasSubstr("must explain why the option is correct or wrong")));
    EXPECT_THAT(reported("Why?\n\n- a\n\n  No.\n- [x] b\n\n  Yes.\n"),
                HasSubstr("each option must start with [x] or [ ]"));
    EXPECT_THAT(reported("Why?\n"), HasSubstr("a choice must consist of a question and a list"));
}

}  // namespace test_choices
}  // namespace dynlab
