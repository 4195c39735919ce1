#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "data_io/values/array_descriptions.h"
#include "data_io/values/json_values.h"
#include "described_sample.h"

namespace dynlab {
namespace test_json_values {

using nlohmann::json;
using ::testing::HasSubstr;

template <class T>
std::string refusal(const std::string& text, const ValueLimits& limits = {}) {
    try {
        value_of_json<T>(parsed_json(text, limits), limits);
    } catch (const ValueError& error) {
        return error.what();
    }
    return "";
}

// Oracle: the form by hand.
TEST(json_values, have_the_form_that_people_read) {
    EXPECT_EQ(json::parse(json_of(sample_whole())), json::parse(R"({
        "truth": true, "number": -0.33333333333333331, "size": 7, "shade": "dark", "text": "Régression \"1\"",
        "vector": [0.1, -2.0], "matrix": {"rows": 2, "columns": 3, "values": [1.0, 4.0, 2.0, 5.0, 3.0, 6.0]},
        "complex": [[1.0, -2.0], [0.0, 1.0]], "some": 2.5, "shared": {"name": "shared", "count": -5},
        "parts": [{"name": "a", "count": 1}, {"name": "b", "count": 2}], "named": {"first": {"name": "c", "count": 3}},
        "pairs": [["x", 1.5]]})"));
    EXPECT_EQ(json_of(Vector{{kNaN, kInfinity, -kInfinity}}), R"(["NaN","Infinity","-Infinity"])");
    EXPECT_EQ(json_of(std::string("a\xFF")), "\"a\xEF\xBF\xBD\"");
    EXPECT_EQ(json_of(std::map<std::string, int>{{"b", 1}, {"a", 2}}, 2), "{\n  \"a\": 2,\n  \"b\": 1\n}");
}

// Oracle: what went in.
TEST(json_values, come_back_but_for_what_programs_keep) {
    const Whole back = value_of_json<Whole>(parsed_json(json_of(sample_whole())));
    EXPECT_TRUE(equal(back, sample_whole()));
    EXPECT_EQ(back.secret, "");
    EXPECT_TRUE(equal(value_of_json<Whole>(parsed_json(json_of(Whole()))), Whole()));
    EXPECT_TRUE(std::isnan(value_of_json<double>(parsed_json("\"NaN\""))));
}

// Oracle: what the text is made of. In quadratic time this takes hours.
TEST(json_values, long_lists_and_objects_are_read) {
    constexpr std::size_t kCount = 500'000;
    std::string text = "[";
    for (std::size_t i = 0; i < kCount; ++i) text += "{},";
    text += "{";
    for (std::size_t i = 0; i < kCount; ++i) text += "\"" + std::to_string(i) + "\": 1,";
    const json value = parsed_json(text + "\"last\": 2}]");
    ASSERT_EQ(value.size(), kCount + 1);
    EXPECT_EQ(value.back().size(), kCount + 1);
    EXPECT_EQ(value.back().at("last"), 2);
}

TEST(json_values, errors_report_the_place) {
    EXPECT_EQ(refusal<std::vector<Part>>(R"([{"name": "a", "count": 1}, {"name": 3, "count": 1}])"),
              "[2].name: expected a string, got a JSON value of type number");
    EXPECT_EQ(refusal<std::vector<Part>>(R"([{"name": "a"}])"), "[1]: the member \"count\" is missing");
    EXPECT_EQ(refusal<Part>(R"({"name": "a", "count": 1e5})"),
              "count: expected a whole number, got a JSON value of type number");
    EXPECT_EQ(refusal<Part>(R"({"name": "a", "count": 18446744073709551615})"),
              "count: expected a whole number from -32768 to 32767, got 18446744073709551615");
    EXPECT_EQ(refusal<Part>(R"({"name": "a", "count": 13})"), "the value: thirteen parts bring bad luck");
    EXPECT_THAT(refusal<Matrix>(R"({"rows": 2, "columns": 2, "values": [1, 2, 3]})"), HasSubstr("2 x 2 numbers"));
    EXPECT_THAT(refusal<Matrix>(R"({"rows": 2000000000, "columns": 2000000000, "values": []})"), HasSubstr("numbers"));
    EXPECT_THAT(refusal<Matrix>(R"({"rows": -2, "columns": -2, "values": [1, 2, 3, 4]})"), HasSubstr("rows"));
}

// Oracle: the limits.
TEST(json_values, hostile_texts_are_refused) {
    ValueLimits limits;
    limits.depth = 50;
    EXPECT_THAT(refusal<Part>(std::string(3'000'000, '['), limits), HasSubstr("nested too deeply"));
    std::string many = "[0";
    for (int i = 0; i < 100'000; ++i) many += ",0";
    limits.memory = 1'000'000;
    EXPECT_THAT(refusal<Vector>(many + "]", limits), HasSubstr("too many values"));
    limits.bytes = 1000;
    EXPECT_THAT(refusal<Vector>(many + "]", limits), HasSubstr("the length limit"));
    for (const char* text : {"", "[", "nul", "{\"a\": }", "\xFF", "[1,]"}) EXPECT_NE(refusal<Vector>(text), "") << text;
}

// Oracle: the contract.
TEST(json_values, wrong_texts_give_a_value_or_an_error) {
    std::mt19937 random(11);
    const std::string text = json_of(sample_whole());
    int refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::string wrong = text;
        for (unsigned k = 0; k <= random() % 3; ++k) wrong[random() % wrong.size()] = " []{}\",:019eNt"[random() % 14];
        refused += refusal<Whole>(wrong).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 10000);
    EXPECT_LT(refused, 20000);
}

}  // namespace test_json_values
}  // namespace dynlab
