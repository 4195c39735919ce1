// Functions and options that were renamed: scripts with the earlier names work. Oracle: the same script with the
// present names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "script_run.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"

namespace test_earlier_names {

using namespace dynlab;
using dynlab::test::error_of;
using dynlab::test::printed;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kPresent =
    "predict_first('a', 3)\nreveal('a', 4)\n"
    "print(plant('suspension', {variant = 3, seed = 2}).y)\n"
    "print(true_model('suspension', {variant = 3}).gain)\n";
const std::string kEarlier =
    "guess('a', 3)\noutcome('a', 4)\n"
    "print(rig('suspension', {specimen = 3, seed = 2}).y)\n"
    "print(rig_truth('suspension', {specimen = 3}).gain)\n";

TEST(earlier_names, give_the_same_results_and_print_each_present_name_once) {
    const std::string earlier = printed(kEarlier + "print(#rig('crane').free_swing.t)"),
                      present = printed(kPresent + "print(#plant('crane').free_swing.t)");
    std::string results;
    std::size_t notes = 0;
    for (std::size_t at = 0, end = 0; at < earlier.size(); at = end) {
        end = earlier.find('\n', at) + 1;
        const std::string line = earlier.substr(at, end - at);
        if (line.find(" is now called ") == line.npos)
            results += line;
        else
            ++notes;
    }
    EXPECT_EQ(results, present);
    EXPECT_EQ(notes, 4u);
    EXPECT_THAT(earlier, StartsWith("guess is now called predict_first;"));
}

TEST(earlier_names, are_free_for_variables) {
    EXPECT_EQ(printed("rig = 5\nlocal guess = 6\nprint(rig, guess)"), "5\t6\n");
}

TEST(earlier_names, of_functions_fail_with_the_place_of_the_call) {
    EXPECT_THAT(error_of("print(1)\nrig('cranes')"), HasSubstr("lesson.lua:2: "));
}

TEST(earlier_names, lead_to_the_help_page_of_the_present_name) {
    std::vector<const FunctionEntry*> all;
    for (const FunctionEntry& entry : catalog_of_functions()) all.push_back(&entry);
    for (const auto& [earlier, present] : {std::pair("guess", "predict_first"), std::pair("outcome", "reveal"),
                                           std::pair("rig", "plant"), std::pair("rig_truth", "true_model")}) {
        const std::string text = help_text(earlier, all, 80);
        EXPECT_THAT(text, HasSubstr(std::string(earlier) + " is now called " + present));
        EXPECT_THAT(text, HasSubstr('\n' + std::string(present) + "\n==="));
    }
}

}  // namespace test_earlier_names
