#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "numerics/models/process_model.h"
#include "support/thrown_message.h"

namespace test_process_model {

using namespace dynlab;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(process_model, reads_structures_with_letters_in_any_order) {  // oracle: definition
    const ProcessStructure structure = ProcessStructure::parse("P3UZDI");
    EXPECT_EQ(structure.poles, 3);
    EXPECT_TRUE(structure.underdamped && structure.zero && structure.delay && structure.integrator);
    EXPECT_EQ(structure.text(), "P3DIZU");
    for (const char* text : {"P1", "P1D", "P2U", "P2DU", "P2Z", "P3DIZU"})
        EXPECT_EQ(ProcessStructure::parse(text).text(), text);
}

TEST(process_model, names_its_parameters) {  // oracle: definition
    EXPECT_THAT(ProcessStructure::parse("P1").parameter_names(), ElementsAre("Kp", "Tp1"));
    EXPECT_THAT(ProcessStructure::parse("P2DU").parameter_names(), ElementsAre("Kp", "Tw", "Zeta", "Td"));
    EXPECT_THAT(ProcessStructure::parse("P3DIZ").parameter_names(), ElementsAre("Kp", "Tp1", "Tp2", "Tp3", "Tz", "Td"));
    EXPECT_THAT(ProcessStructure::parse("P3U").parameter_names(), ElementsAre("Kp", "Tp3", "Tw", "Zeta"));
}

TEST(process_model, transfer_function_is_the_formula) {  // oracle: the definition evaluated at a point
    const Complex s(0.3, 0.7);
    const auto at = [&](const char* text, const Vector& parameters) {
        return ProcessModel(ProcessStructure::parse(text), parameters).transfer_function().at(s);
    };
    const auto expect_equal = [](Complex a, Complex b) { EXPECT_LT(std::abs(a - b), 1e-13 * std::abs(b)); };
    expect_equal(at("P1D", Vector{{2, 0.5, 0.3}}), 2.0 * std::exp(-0.3 * s) / (0.5 * s + 1.0));
    expect_equal(at("P2Z", Vector{{2, 0.5, 3, -1}}), 2.0 * (1.0 - s) / ((0.5 * s + 1.0) * (3.0 * s + 1.0)));
    expect_equal(at("P3IU", Vector{{2, 4, 0.5, 0.1}}), 2.0 / ((4.0 * s + 1.0) * (0.25 * s * s + 0.1 * s + 1.0) * s));
    expect_equal(at("P3", Vector{{1, 2, 3, 4}}), 1.0 / ((2.0 * s + 1.0) * (3.0 * s + 1.0) * (4.0 * s + 1.0)));
}

TEST(process_model, gives_parameters_by_name) {
    const ProcessModel model(ProcessStructure::parse("P2DU"), Vector{{1, 2, 3, 4}});
    EXPECT_EQ(model.parameter("Zeta"), 3);
    EXPECT_THAT(thrown_message([&] { model.parameter("Tp1"); }), AllOf(HasSubstr("P2DU"), HasSubstr("Tp1")));
}

TEST(process_model, says_which_letters_exist) {
    for (const char* text : {"", "P", "P0", "P4", "p1", "P1U", "P1X", "P1DD", "Q1"})
        EXPECT_THAT(thrown_message([&] { ProcessStructure::parse(text); }), HasSubstr("D (delay)")) << text;
    EXPECT_THAT(thrown_message([] { ProcessModel(ProcessStructure::parse("P1D"), Vector::Ones(2)); }),
                AllOf(HasSubstr("Kp, Tp1, Td"), HasSubstr("2")));
}

}  // namespace test_process_model
