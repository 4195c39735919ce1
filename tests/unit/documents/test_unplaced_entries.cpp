// Oracle: the sentences, written here by hand.
#include "documents/unplaced_entries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/reader.h"

namespace test_unplaced_entries {

using namespace dynlab;
using testing::ElementsAre;
using testing::IsEmpty;

RunRecord record() {
    RunRecord all;
    all.values["gain"] = {3.0, "3"};
    all.tables["models"] = {{"a"}, {{"1"}}};
    all.figures["residuals"] = {};
    all.figures["residuals_2"] = {};
    all.figures["cell-1-figure-1"] = {};
    all.outputs["cell-1"] = {{"", "cell-1-figure-1"}};
    all.texts["remark"] = {"words"};
    return all;
}

TEST(unplaced_entries, are_reported_with_the_line_to_write) {
    std::vector<std::string> texts;
    for (const UnplacedEntries& entries :
         unplaced_entries(record(), "Only words, and `gain` without a slot; ![](figure:residuals_3){#fig:x}"))
        texts.push_back(message_text(entries.message()));
    EXPECT_THAT(
        texts,
        ElementsAre("the figures 'residuals', 'residuals_2' are passed to the report but never shown; write "
                    "![](figure:residuals){#fig:residuals}",
                    "the table 'models' is passed to the report but never shown; write ::: {.table name=models} above "
                    "its caption and ::: below the caption",
                    "the text 'remark' is passed to the report but never shown; write ::: {.text name=remark} and, on "
                    "a later line, :::",
                    "the value 'gain' is passed to the report but never shown; write `gain`{.value}"));
}

TEST(unplaced_entries, are_none_where_all_have_a_slot) {
    EXPECT_THAT(unplaced_entries(record(),
                                 "![](figure:residuals){#fig:residuals} ![Words](figure:residuals_2)\n"
                                 "::: {.table name=models}\nCaption {#tbl:models}\n:::\n"
                                 "::: {.text name=\"remark\"}\n:::\nThe gain is `gain`{.value}."),
                IsEmpty());
}

}  // namespace test_unplaced_entries
