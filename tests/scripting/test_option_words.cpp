// What a user reads names the options as scripts write them. Oracle: the sentences that the help pages' options
// promise.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "base/reader.h"
#include "script_run.h"
#include "scripting/conversions/option_words.h"

namespace test_option_words {

using namespace dynlab;
using testing::HasSubstr;

TEST(option_words, options_in_messages_become_those_of_lua) {  // oracle: definition
    EXPECT_EQ(option_name("max_iterations"), "MaxIter");
    EXPECT_EQ(option_name("foreign"), "`foreign`");
    const Message message("raise {} = {}, or {}", OptionName{"largest_delay"}, 2, OptionName{"foreign"});
    EXPECT_EQ(message_text(message, {nullptr, option_name}), "raise TdMax = 2, or `foreign`");
}

const std::string kDataSet =
    "rng(1) local u = prbs(7, 4)\n"
    "local y = lsim(tf({2}, {1, 4, 3}, {IODelay = 0.5}), u, 0.05) + 0.01*randn(#u, 1)\n"
    "local d = iddata(y, u, 0.05)\n";

TEST(option_words, errors_name_the_options_of_scripts) {
    for (const auto& [call, said] : std::vector<std::pair<std::string, std::string>>{
             {"procsrivc(d, 'P1D', {TdMin = 2, TdMax = 1})", "TdMax must be at least TdMin = 2, but is 1"},
             {"tfsrivc(d, 2, 0, {TdMax = 1000})", "TdMax must be shorter than the data"},
             {"tfcoe(d, 2, 0, {TdMin = -1})", "TdMin must be nonnegative, but is -1"},
             {"tfsrivc(d, 2, 0, {NumTd = 0})", "NumTd must be at least 1"},
             {"coe(d, {1, 2, 0}, {InitialState = 'warm'})",
              "option 'InitialState' must be one of \"none\", \"steady\", \"estimate\", \"auto\", but \"warm\" was "
              "given"},
             {"oe(d, {1, 2, 1}, {Offset = 'big'})", "option 'Offset' must be one of \"none\", \"remove\""},
             {"hammerstein(d, 2, 0, {InitialState = 'estimate'})",
              "option 'InitialState' must be one of \"none\", \"steady\", \"auto\", but \"estimate\" was given"},
             {"n4sid(d, 3, {Weighting = 'moesp'})", "option 'Weighting' must be one of \"MOESP\", \"N4SID\", \"CVA\""},
             {"procsrivc(d, 'P1I', {InitialState = 'estimate', Offset = 'estimate'})",
              "with InitialState = \"estimate\""},
             {"srivc(d, {1, 2, 0}, {Tol = 0})", "Tol must be positive, but is 0"},
             {"coe(d, {1, 2, 0}, {Fixed = {a3 = 1}})",
              "Fixed: the model has no parameter a3; its parameters are a1, a2, b0"},
             {"tfcoe(d, 2, 0, {Fixed = {Td = 1}})", "a delay with IODelay"},
             {"coe(d, {1, 2, 0}, {OutputWeights = {1, 2}})", "OutputWeights needs one positive number for each"},
             {"hammerstein(d, 2, 0, {Bins = 0})", "option 'Bins' must be between 1 and 1000, but 0 was given"},
             {"hammerstein(d, 2, 0, {Breakpoints = {2, 1}})", "Breakpoints must increase"},
             {"n4sid(d, 3, {BlockRows = 2})", "BlockRows must be greater than the order"}}) {
        const std::string error = dynlab::test::error_of(kDataSet + call);
        EXPECT_THAT(error, HasSubstr(said)) << call;
        EXPECT_THAT(error, testing::Not(HasSubstr("`"))) << call;
    }
}

TEST(option_words, delay_beyond_the_search_is_reported_with_the_option) {
    const std::string late = R"(rng(1)
local u = randn(400)
local y = lsim(tf({2}, {1, 2}, {IODelay = 15}), u, 0.1) + 0.02*randn(400)
local d = iddata(y, u, 0.1)
)";
    for (const char* message :
         {"tfsrivc(d, 1, 0).report.message", "tfcoe(d, 1, 0).report.message", "tfrivc(d, 1, 0).report.message",
          "procsrivc(d, 'P1D', {TdMax = 2}).report.message", "select(3, delayest(d, {poles = 1, zeros = 0})).message"})
        EXPECT_THAT(dynlab::test::printed(late + "print(" + message + ")"),
                    testing::ContainsRegex("The output responds about 15[.0-9]* s after the input, beyond the limit of "
                                           "the search \\(TdMax = [.0-9]+ s\\): increase TdMax[.]"))
            << message;
    EXPECT_EQ(dynlab::test::printed(late + "print(string.format('%.0f', tfsrivc(d, 1, 0, {TdMax = 18}).IODelay))"),
              "15\n");
}

TEST(option_words, messages_name_the_options_of_scripts) {
    for (const auto& [call, said] : std::vector<std::pair<std::string, std::string>>{
             {"procsrivc(d, 'P1D', {TdMax = 0.2})",
              "The delay is TdMax = 0.2 s, at the limit of the search: increase TdMax."},
             {"tfsrivc(d, 2, 0, {TdMin = 0.8, TdMax = 1.5})", "decrease TdMin"},
             {"coe(d, {1, 2, 0}, {MaxIter = 1})", "did not converge within MaxIter = 1 iterations"},
             {"oe(d, {2, 2, 1}, {MaxIter = 0})", "did not converge within MaxIter = 0 iterations"},
             {"tfcoe(d, 1, 1, {TdMax = 1})", "Fix the delay with IODelay"}}) {
        const std::string message = dynlab::test::printed(kDataSet + "print(" + call + ".report.message)");
        EXPECT_THAT(message, HasSubstr(said)) << call;
        EXPECT_THAT(message, testing::Not(HasSubstr("`"))) << call;
    }
}

// oracle: a default that is written out is the same call
TEST(option_words, written_default_of_a_choice_changes_nothing) {
    for (const auto& [call, option, initial, other] : std::vector<std::array<std::string, 4>>{
             {"lssvf(d, {2, 1, 10}, 3", "hold_y", "foh", "zoh"}, {"n4sid(d, 3", "Weighting", "MOESP", "N4SID"}}) {
        const auto fit_with = [&](const std::string& choice) {
            return call + ", {" + option + " = '" + choice + "'}).report.fit_percent";
        };
        EXPECT_EQ(dynlab::test::printed(kDataSet + "local fit = " + call + ").report.fit_percent\nprint(fit == " +
                                        fit_with(initial) + ", fit == " + fit_with(other) + ")"),
                  "true\tfalse\n")
            << call;
    }
}

}  // namespace test_option_words
