#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>
#include <random>

#include "data_io/values/cbor_values.h"
#include "data_io/variable.h"
#include "described_sample.h"
#include "sample_variables.h"

namespace dynlab {
namespace test_cbor_values {

using ::testing::HasSubstr;

std::string hex(const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
        constexpr char kDigits[] = "0123456789abcdef";
        text += kDigits[static_cast<unsigned char>(c) >> 4];
        text += kDigits[c & 15];
    }
    return text;
}

template <class T>
std::string refusal(const std::string& bytes, const ValueLimits& limits = {}) {
    try {
        from_cbor<T>(bytes, limits);
    } catch (const ValueError& error) {
        return error.what();
    }
    return "";
}

// Oracle: the examples of RFC 8949, appendix A, and of RFC 8746, section 3.1.
TEST(cbor_values, are_written_as_the_standard_wants) {
    EXPECT_EQ(hex(cbor_of(10)), "0a");
    EXPECT_EQ(hex(cbor_of(1000)), "1903e8");
    EXPECT_EQ(hex(cbor_of(1000000000000)), "1b000000e8d4a51000");
    EXPECT_EQ(hex(cbor_of(-1)), "20");
    EXPECT_EQ(hex(cbor_of(-1000)), "3903e7");
    EXPECT_EQ(hex(cbor_of(1.1)), "fb3ff199999999999a");
    EXPECT_EQ(hex(cbor_of(true)), "f5");
    EXPECT_EQ(hex(cbor_of(std::optional<double>())), "f6");
    EXPECT_EQ(hex(cbor_of(std::string("IETF"))), "6449455446");
    EXPECT_EQ(hex(cbor_of(std::vector<int>{1, 2, 3})), "83010203");
    EXPECT_EQ(hex(cbor_of(std::map<std::string, std::vector<int>>{{"a", {}}, {"b", {2, 3}}})),
              "a261618061628202"
              "03");
    EXPECT_EQ(hex(cbor_of(Vector{{2}})),
              "d85648"
              "0000000000000040");
    EXPECT_EQ(hex(cbor_of(Matrix{{2, 2}})),
              "d904108282"
              "0102"
              "d85650"
              "0000000000000040"
              "0000000000000040");
}

// Oracle: another reader of CBOR, which passes tags over.
TEST(cbor_values, mean_the_same_to_another_reader) {
    using nlohmann::json;
    const json read = json::from_cbor(cbor_of(sample_whole()), true, true, json::cbor_tag_handler_t::ignore);
    EXPECT_EQ(read.at("number"), -1.0 / 3);
    EXPECT_EQ(read.at("shade"), "dark");
    EXPECT_EQ(read.at("matrix").at(0), json({2, 3}));
    EXPECT_EQ(read.at("vector").get_binary().size(), 16u);
    EXPECT_FALSE(read.contains("none"));
    EXPECT_FALSE(read.contains("maybe_empty"));
    EXPECT_EQ(read.at("named").at("first").at("count"), 3);
    EXPECT_EQ(read.at("pairs").at(0), json({"x", 1.5}));
    EXPECT_EQ(read.at("secret"), "for programs");
}

// Oracle: what went in.
TEST(cbor_values, come_back) {
    const Whole back = from_cbor<Whole>(cbor_of(sample_whole()));
    EXPECT_TRUE(equal(back, sample_whole()));
    EXPECT_EQ(back.secret, "for programs");
    EXPECT_TRUE(equal(from_cbor<Whole>(cbor_of(Whole())), Whole()));
    for (const double x : {-0.0, kInfinity, -kInfinity, std::bit_cast<double>(0xFFF8000000000123u), 5e-324})
        EXPECT_EQ(std::bit_cast<std::uint64_t>(from_cbor<double>(cbor_of(x))), std::bit_cast<std::uint64_t>(x));
    for (const std::int64_t k : {std::int64_t{0}, std::int64_t{-1}, INT64_MAX, INT64_MIN})
        EXPECT_EQ(from_cbor<std::int64_t>(cbor_of(k)), k);
    EXPECT_EQ(from_cbor<Matrix>(cbor_of(Matrix(3, 0))).rows(), 3);
    EXPECT_EQ(from_cbor<std::string>(cbor_of(std::string("\xFF\0x", 3))), std::string("\xFF\0x", 3));
}

// Oracle: the replacement character, U+FFFD.
TEST(cbor_values, texts_are_made_utf8_where_that_is_wanted) {
    ValueLimits limits;
    limits.only_utf8 = true;
    const std::map<std::string, std::string> texts = {{"a\xFFz", "\xC3\xA9\xC3"}};
    const std::map<std::string, std::string> expected = {{"a\xEF\xBF\xBDz", "\xC3\xA9\xEF\xBF\xBD"}};
    EXPECT_EQ((from_cbor<std::map<std::string, std::string>>(cbor_of(texts), limits)), expected);
    EXPECT_EQ((from_cbor<std::map<std::string, std::string>>(cbor_of(texts))), texts);
}

TEST(cbor_values, variables_of_every_kind_come_back) {
    const VariableTable variables = sample_variables();
    EXPECT_TRUE(equal(from_cbor<VariableTable>(cbor_of(variables)), variables));
    EXPECT_TRUE(from_cbor<VariableTable>(cbor_of(VariableTable())).empty());
}

TEST(cbor_values, every_beginning_is_refused) {
    const std::string variables = cbor_of(sample_variables()), whole = cbor_of(sample_whole());
    for (std::size_t length = 0; length < variables.size(); ++length)
        EXPECT_NE(refusal<VariableTable>(variables.substr(0, length)), "") << length;
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(refusal<Whole>(whole.substr(0, length)), "") << length;
    EXPECT_EQ(refusal<Whole>(whole + "x"), "the value: extra bytes follow the value");
}

// Oracle: the contract, for bytes that are changed at random, doubled or cut out.
TEST(cbor_values, wrong_bytes_give_a_value_or_an_error) {
    std::mt19937 random(7);
    const std::string samples[] = {cbor_of(sample_variables()), cbor_of(sample_whole())};
    int refused = 0;
    for (int trial = 0; trial < 40000; ++trial) {
        std::string wrong = samples[trial % 2];
        for (unsigned k = 0; k <= random() % 4; ++k) wrong[random() % wrong.size()] = static_cast<char>(random());
        if (trial % 5 == 0) wrong.erase(random() % wrong.size(), random() % 9);
        if (trial % 7 == 0) wrong.insert(random() % wrong.size(), wrong.substr(random() % wrong.size(), 20));
        ValueLimits limits;
        limits.memory = 100'000;
        refused += refusal<VariableTable>(wrong, limits).empty() ? 0 : 1;
        refused += refusal<Whole>(wrong, limits).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 50000);
    EXPECT_LT(refused, 80000);
}

// Oracle: the limits. Bytes like these overflow the stack of readers that recurse, or make others take memory.
TEST(cbor_values, hostile_bytes_cost_nothing) {
    for (const char opening : {'\x5f', '\x7f', '\x9f', '\xbf', '\x81', '\xa1', '\xc1'})
        EXPECT_NE(refusal<Variable>(std::string(3'000'000, opening)), "") << static_cast<int>(opening);
    EXPECT_THAT(refusal<Variable>(std::string(3'000'000, '\x81')), HasSubstr("nested deeper than 200"));
    EXPECT_THAT(refusal<std::vector<int>>(std::string("\x9b\x00\xff\xff\xff\xff\xff\xff\xff", 9)),
                HasSubstr("more elements than the data have bytes"));
    EXPECT_NE(refusal<std::string>(std::string("\x7b\xff\xff\xff\xff\xff\xff\xff\xff", 9)), "");
    EXPECT_NE(refusal<Vector>(std::string("\xd8\x56\x5b\xff\xff\xff\xff\xff\xff\xff\xff", 11)), "");
    const std::string huge =
        std::string("\xd9\x04\x10\x82\x82\x1a\x40\x00\x00\x00\x1a\x40\x00\x00\x00\xd8\x56\x40", 18);
    EXPECT_THAT(refusal<Matrix>(huge), HasSubstr("1073741824 x 1073741824 numbers do not match a length of 0 bytes"));
}

// Oracle: a list of a million empty texts takes a million strings, whatever it takes in CBOR.
TEST(cbor_values, no_more_memory_is_taken_than_allowed) {
    CborWriter writer;
    writer.begin_list(1'000'000);
    for (int i = 0; i < 1'000'000; ++i) writer.text("");
    ValueLimits limits;
    limits.memory = 1'000'000 * sizeof(std::string) - 1;
    EXPECT_THAT(refusal<std::vector<std::string>>(writer.bytes(), limits),
                HasSubstr("exceeds the allowed 31999999 bytes"));
    limits.memory += 1000;
    EXPECT_EQ(refusal<std::vector<std::string>>(writer.bytes(), limits), "");
    limits.memory = 800;
    EXPECT_NE(refusal<Vector>(cbor_of(Vector(Vector::Zero(101))), limits), "");
    EXPECT_EQ(refusal<Vector>(cbor_of(Vector(Vector::Zero(100))), limits), "");
    limits.bytes = 10;
    EXPECT_THAT(refusal<std::string>(cbor_of(std::string("0123456789")), limits),
                HasSubstr("exceeds the limit of 10 bytes"));
}

TEST(cbor_values, errors_report_the_place_what_was_wanted_and_given) {
    const auto with_parts = [](const std::string& part) {
        const std::string bytes = cbor_of(std::vector<Part>{{"a", 1}, {"b", 2}});
        return bytes.substr(0, bytes.size() - cbor_of(Part{"b", 2}).size()) + part;
    };
    const auto members = [](const auto& write) {
        CborWriter writer;
        writer.begin_object();
        write(writer);
        writer.end_object();
        return writer.take();
    };
    EXPECT_EQ(refusal<std::vector<Part>>(with_parts(members([](CborWriter& w) { w.member("name"), w.number(1); }))),
              "[2].name: expected a string, got a number");
    EXPECT_EQ(refusal<std::vector<Part>>(with_parts(members([](CborWriter& w) { w.member("nome"), w.text("b"); }))),
              "[2]: the member \"name\" is missing");
    EXPECT_EQ(refusal<std::vector<Part>>(with_parts(
                  members([](CborWriter& w) { w.member("name"), w.text("b"), w.member("count"), w.whole(40000); }))),
              "[2].count: expected a whole number from -32768 to 32767, got 40000");
    EXPECT_EQ(refusal<std::vector<Part>>(with_parts(cbor_of(Part{"b", 13}))), "[2]: thirteen parts bring bad luck");
    std::map<std::string, Shade> shades = {{"wall", Shade::kDark}};
    std::string grey = cbor_of(shades);
    grey.replace(grey.find("dark"), 4, "grey");
    EXPECT_EQ((refusal<std::map<std::string, Shade>>(grey)),
              "[\"wall\"]: expected one of light, dark, got another string");
    EXPECT_THAT(refusal<Vector>(cbor_of(Matrix{{1, 2}})), HasSubstr("expected a vector, got a matrix"));
}

}  // namespace test_cbor_values
}  // namespace dynlab
