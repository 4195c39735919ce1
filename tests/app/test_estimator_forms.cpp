// The controls of estimators follow from catalog, signatures and help pages. Oracle: the functions themselves, which
// refuse options that they do not know.
#include "app/workbench/estimator_forms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "base/languages.h"
#include "figures/gnuplot_renderer.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/interpreter/runtime.h"

namespace test_estimator_forms {
using namespace dynlab;
using testing::HasSubstr;
using testing::Not;

EstimatorForm form(const std::string& name) {
    for (const EstimatorForm& one : estimator_forms())
        if (one.name == name) return one;
    throw std::runtime_error("no form of " + name);
}
FormField option(const std::string& function, const std::string& name) {
    const EstimatorForm of_function = form(function);
    for (const FormField& field : of_function.options)
        if (field.name == name) return field;
    throw std::runtime_error("no option " + name);
}

std::string call_of(const EstimatorForm& form, const std::string& options) {
    std::string call = form.name + "(data";
    for (const FormField& argument : form.arguments) {
        const std::string initial = argument.initial.empty() ? "3" : argument.initial;
        call += argument.kind == "orders" ? ", {" + initial + "}" : ", " + initial;
    }
    return call + (options.empty() ? "" : ", {" + options + "}") + ")";
}

std::string error_of(const std::string& code) {
    GnuplotRenderer renderer;
    const RunRecord record = Runtime({}, renderer)
                                 .run_code(
                                     "local u = prbs(6, 8)\nlocal data = iddata(lsim(tf({2}, {1, 4, 3}), u, 0.05) + "
                                     "0.05*randn(#u), u, 0.05)\n" +
                                         code,
                                     "t.lua");
    return record.error ? record.error->text() : "";
}

TEST(estimator_forms, every_function_that_makes_a_model_of_a_record_is_there) {
    std::set<std::string> expected, there;
    for (const FunctionEntry& entry : catalog_of_functions()) {
        const std::string signature = entry.signature, area = entry.area;
        const bool estimates = area == "continuous time" || area == "discrete time" || area == "step tests" ||
                               area == "grey box" || area == "learning from data";
        if (estimates && signature.starts_with(entry.name + std::string("(data")) && signature.ends_with("-> G"))
            expected.insert(entry.name);
    }
    for (const EstimatorForm& one : estimator_forms()) there.insert(one.name);
    EXPECT_EQ(there, expected);
    EXPECT_GE(there.size(), 20u);
}

TEST(estimator_forms, what_a_new_step_is_given_works) {
    for (const EstimatorForm& one : estimator_forms()) {
        if (one.name.starts_with("step_")) continue;  // they want a step
        if (one.name.starts_with("cl")) {             // they want the reference of a loop, and say so
            EXPECT_THAT(error_of("local G = " + call_of(one, "")), HasSubstr("{Reference = r}")) << one.name;
            continue;
        }
        EXPECT_EQ(error_of("local G = " + call_of(one, "")), "") << one.name;
    }
}

TEST(estimator_forms, functions_know_all_options_that_are_offered) {
    for (const EstimatorForm& one : estimator_forms())
        for (const FormField& field : one.options) {
            // A function as the value of an option: the message refuses its type and does not call the option name
            // unknown.
            const std::string error = error_of("local G = " + call_of(one, field.name + " = print"));
            EXPECT_THAT(error, Not(HasSubstr("no option"))) << one.name << " " << field.name;
            EXPECT_THAT(error, HasSubstr(field.name)) << one.name << " " << field.name;
        }
}

TEST(estimator_forms, choices_flags_and_numbers_are_distinguished) {
    EXPECT_EQ(option("srivc", "InitialState").kind, "choice");
    EXPECT_THAT(option("srivc", "InitialState").parts,
                testing::ElementsAre("\"none\"", "\"steady\"", "\"estimate\"", "\"auto\""));
    EXPECT_EQ(option("srivc", "InitialState").initial, "\"auto\"");
    EXPECT_EQ(option("tfsrivc", "hold_y").kind, "choice") << "said on the page of srivc";
    EXPECT_EQ(option("rivsvf", "hold_y").kind, "choice") << "said on the page of lssvf";
    EXPECT_EQ(option("hammerstein", "TdMax").words, option("tfsrivc", "TdMax").words) << "more is said behind a colon";
    EXPECT_EQ(option("srivc", "Stable").kind, "flag");
    EXPECT_EQ(option("srivc", "lambda").kind, "number");
    EXPECT_EQ(option("tfsrivc", "TdMax").kind, "number");
    EXPECT_EQ(option("n4sid", "Weighting").parts.size(), 3u);
    EXPECT_EQ(form("procsrivc").arguments.at(0).kind, "process");
    EXPECT_EQ(form("greyest").arguments.at(0).kind, "text") << "equations are written";
    EXPECT_EQ(option("greyest", "InitialState").initial, "\"model\"");
    EXPECT_EQ(option("sindy", "weak").kind, "flag");
    EXPECT_THAT(form("bj").arguments.at(0).parts, testing::ElementsAre("nb", "nc", "nd", "nf", "nk"));
}

TEST(estimator_forms, are_french_for_french_sessions) {
    const std::regex english("\\b(the|of|with|any|by|and|at|in|off|to)\\b");
    const std::vector<EstimatorForm> forms = estimator_forms(), french = estimator_forms({catalog_of("fr")});
    ASSERT_EQ(french.size(), forms.size());
    for (std::size_t i = 0; i < forms.size(); ++i) {
        EXPECT_NE(french[i].summary, forms[i].summary);
        EXPECT_NE(french[i].noise, forms[i].noise);
        for (const std::string& text : {french[i].summary, french[i].structure, french[i].noise})
            EXPECT_FALSE(std::regex_search(text, english)) << text;
    }
}

/// What help pages say of arguments and options. Oracle: the pages, which say it in English.
TEST(estimator_forms, words_of_all_fields_are_french) {
    std::set<std::string> said;
    const std::vector<EstimatorForm> forms = estimator_forms(), french = estimator_forms({catalog_of("fr")});
    for (std::size_t i = 0; i < forms.size(); ++i)
        for (const auto fields : {&EstimatorForm::arguments, &EstimatorForm::options})
            for (std::size_t k = 0; k < (forms[i].*fields).size(); ++k) {
                const FormField &field = (forms[i].*fields)[k], &there = (french[i].*fields)[k];
                EXPECT_EQ(there.kind, field.kind);
                if (field.words.empty()) continue;
                said.insert(field.words);
                EXPECT_NE(there.words, field.words) << forms[i].name;
            }
    EXPECT_GT(said.size(), 50u);
}

}  // namespace test_estimator_forms
