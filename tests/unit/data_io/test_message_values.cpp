#include "data_io/values/message_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "base/reader.h"
#include "data_io/values/cbor_values.h"
#include "data_io/values/json_values.h"

namespace dynlab {
namespace test_message_values {

using ::testing::HasSubstr;

/// One with arguments of every kind.
Message sample_message() {
    return Message("{} of {}: {}, {} and {}; {}, {}", -3, "R\xC3\xA9gression {} \"1\"", significant(0.05, 3),
                   decimals(-0.0, 2), OptionName{"max_iterations"}, listed({"y1", "", "%s"}, Join::kAnd),
                   plural(2, "{} sample of {}", "{} samples of {}", 1.5));
}

std::vector<Message> samples() {
    return {sample_message(),
            Message(),
            Message("plain"),
            Message::verbatim("{} {} {}"),
            sentences({Message("One."), sample_message()}),
            Message("{}", MessageList{{}, Join::kLines}),
            Message("{} to {}", std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()),
            Message("{} and {}", std::numeric_limits<double>::infinity(), 0.1 + 0.2)};
}

template <class Read>
std::string refusal(const Read& read) {
    try {
        read();
    } catch (const ValueError& error) {
        return error.what();
    }
    return "";
}

std::string refusal_of_json(const std::string& text) {
    return refusal([&] { from_json<Message>(text); });
}

// Oracle: what went in.
TEST(message_values, messages_come_back) {
    for (const Message& message : samples()) {
        EXPECT_EQ(from_cbor<Message>(cbor_of(message)), message) << message_text(message);
        EXPECT_EQ(from_json<Message>(json_of(message)), message) << message_text(message);
    }
    EXPECT_EQ(from_cbor<std::vector<Message>>(cbor_of(samples())), samples());
}

// Oracle: the form that the header describes, written by hand.
TEST(message_values, arguments_are_stored_under_their_kinds) {
    const Message message =
        plural(2, "{} of {} for {}", "{} in {} for {}", significant(0.05, 3), listed({"y"}, Join::kOr));
    EXPECT_EQ(nlohmann::json::parse(json_of(message)), nlohmann::json::parse(R"({
        "id": "{} of {} for {}",
        "many": "{} in {} for {}",
        "arguments": [{"count": 2},
                      {"number": {"value": 0.05, "digits": 3, "meaning": "significant"}},
                      {"list": {"join": "or", "items": [{"id": "{}", "arguments": [{"text": "y"}]}]}}]
    })"));
    EXPECT_EQ(nlohmann::json::parse(json_of(Message("plain"))), nlohmann::json::parse(R"({"id": "plain"})"));
    EXPECT_EQ(from_json<Message>(R"({"id": "set {}", "arguments": [{"option": "delay"}]})"),
              Message("set {}", OptionName{"delay"}));
}

TEST(message_values, what_is_no_message_is_refused_with_its_place) {
    EXPECT_THAT(refusal_of_json(R"({"id": "{} and {}", "arguments": [{"count": 1}]})"),
                HasSubstr("other arguments than its format"));
    EXPECT_THAT(refusal_of_json(R"({"id": "{} a", "many": "{} {}", "arguments": [{"count": 1}]})"),
                HasSubstr("other arguments than its format"));
    EXPECT_THAT(refusal_of_json(R"({"id": "{} a", "many": "{} b", "arguments": [{"text": "1"}]})"),
                HasSubstr("does not begin with a count"));
    EXPECT_THAT(refusal_of_json(R"({"id": "", "arguments": [{"count": 1}]})"), HasSubstr("an empty message"));
    EXPECT_THAT(refusal_of_json(R"({"id": "", "many": "a"})"), HasSubstr("an empty message"));
    EXPECT_EQ(refusal_of_json(R"({"id": "{}", "arguments": [{"count": 1, "text": "1"}]})"),
              "arguments[1]: an argument of a message is of one kind");
    EXPECT_EQ(refusal_of_json(R"({"id": "{}", "arguments": [{"truth": true}]})"),
              "arguments[1]: an argument of a message is of no known kind");
    EXPECT_THAT(refusal_of_json(R"({"id": "{}", "arguments": [{"list": {"items": [], "join": "xor"}}]})"),
                HasSubstr("arguments[1].list.join: expected one of comma, and, or"));
    for (const char* digits : {"0", "18", "400", "-1"})
        EXPECT_THAT(refusal_of_json(R"({"id": "{}", "arguments": [{"number": {"value": 1, "meaning": "significant",
                                        "digits": )" +
                                    std::string(digits) + "}}]}"),
                    HasSubstr("at most 17 digits"))
            << digits;
    EXPECT_THAT(refusal_of_json(R"({"many": "b"})"), HasSubstr("the member \"id\" is missing"));
    EXPECT_NE(refusal_of_json(R"(["a"])"), "");
}

TEST(message_values, nesting_without_end_is_refused) {
    std::string begin, end;
    for (int i = 0; i < 10000; ++i) {
        begin += R"({"id": "{}", "arguments": [{"list": {"join": "and", "items": [)";
        end += "]}}]}";
    }
    EXPECT_THAT(refusal_of_json(begin + R"({"id": "a"})" + end), HasSubstr("nested"));
    Message message("a");
    for (int i = 0; i < 300; ++i) message = Message("{}", message);
    const std::string bytes = cbor_of(message);
    EXPECT_THAT(refusal([&] { from_cbor<Message>(bytes); }), HasSubstr("nested deeper"));
}

// Oracle: bytes that are damaged give a message that can be shown, or a ValueError.
TEST(message_values, damaged_bytes_give_a_message_or_an_error) {
    const std::string whole = cbor_of(samples());
    std::mt19937 random(5);
    int read = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string bytes = whole;
        for (int changes = 0; changes < 1 + i % 3; ++changes)
            bytes[random() % bytes.size()] = static_cast<char>(random());
        if (i % 7 == 0) bytes.resize(random() % bytes.size());
        try {
            for (const Message& message : from_cbor<std::vector<Message>>(bytes)) message_text(message);
            ++read;
        } catch (const ValueError& error) {
            EXPECT_STRNE(error.what(), "");
        }
    }
    EXPECT_GT(read, 0);
}

}  // namespace test_message_values
}  // namespace dynlab
