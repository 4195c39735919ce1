#include "data_io/values/message_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "base/catalog.h"
#include "base/reader.h"
#include "data_io/values/cbor_values.h"
#include "data_io/values/estimate_descriptions.h"
#include "data_io/values/json_values.h"

namespace dynlab {
namespace test_message_values {

using ::testing::HasSubstr;

/// With an argument of every kind, lists in lists and a plural.
Message sample() {
    const MessageList faults{{Message("a zero that cancels a pole"),
                              Message("standard errors larger than the values of {}", listed({"a1", "{}", "\"b0\""}))},
                             Join::kAnd};
    const Message first("{} of {} fits {} % ({}) with {} = {}", "y1", plural(2, "{} pole", "{} poles"),
                        significant(93.214, 3), decimals(-0.5, 2), OptionName{"max_iterations"}, std::int64_t{-7});
    const Message all = sentences({first, Message("That model has {}.", faults)});
    return Message("{}", MessageList{{all, Message::verbatim("100 % {}")}, Join::kLines});
}

template <class T>
std::string refusal_of_json(const nlohmann::json& json, const ValueLimits& limits = {}) {
    try {
        value_of_json<T>(json, limits);
    } catch (const ValueError& error) {
        return error.what();
    }
    return "";
}

// Oracle: what went in.
TEST(message_values, come_back) {
    for (const Message& message : {sample(), Message(), Message("no arguments"), plural(1, "{} pole", "{} poles"),
                                   Message::verbatim(""), Message("{} %", significant(-0.0, 17))}) {
        EXPECT_EQ(from_cbor<Message>(cbor_of(message)), message);
        EXPECT_EQ(from_json<Message>(json_of(message)), message);
    }
    const Message nan = from_json<Message>(json_of(Message("{} s", kNaN)));
    EXPECT_EQ(message_text(nan), "NaN s");
}

// Oracle: the French and the option's name, written by hand: what was stored is no text yet.
TEST(message_values, are_translated_after_they_come_back) {
    const Catalog french(R"(msgid ""
msgstr "Plural-Forms: nplurals=2; plural=n > 1;\n"

msgctxt "decimal sign"
msgid "."
msgstr ","

msgid "{} pole"
msgid_plural "{} poles"
msgstr[0] "{} pôle"
msgstr[1] "{} pôles"

msgid "with {} and {} = {}"
msgstr "avec {} et {} = {}"
)");
    const Message message("with {} and {} = {}", plural(3, "{} pole", "{} poles"), OptionName{"stable"}, 0.25);
    const Reader reader{&french, [](std::string_view) { return std::string("Stable"); }};
    EXPECT_EQ(message_text(from_cbor<Message>(cbor_of(message)), reader), "avec 3 pôles et Stable = 0,25");
}

// Oracle: the names of the members in the description, and the kinds by the names of JSON.
TEST(message_values, have_their_arguments_with_their_kinds) {
    const nlohmann::json json =
        nlohmann::json::parse(json_of(Message("{} {} {} {}", 3, "y1", OptionName{"offset"}, decimals(1.5, 1))));
    EXPECT_EQ(json.at("id"), "{} {} {} {}");
    EXPECT_FALSE(json.contains("many"));
    EXPECT_EQ(json.at("arguments").at(0), nlohmann::json({{"count", 3}}));
    EXPECT_EQ(json.at("arguments").at(1), nlohmann::json({{"text", "y1"}}));
    EXPECT_EQ(json.at("arguments").at(2), nlohmann::json({{"option", "offset"}}));
    EXPECT_EQ(json.at("arguments").at(3).at("number"),
              nlohmann::json({{"value", 1.5}, {"digits", 1}, {"meaning", "decimals"}}));
}

TEST(message_values, of_results_come_back) {
    OrderCandidate candidate;
    candidate.failure = Message("the search was stopped before its turn");
    EXPECT_EQ(from_cbor<OrderCandidate>(cbor_of(candidate)).failure, candidate.failure);
    MonteCarloRun run;
    run.outcomes.resize(1);
    run.outcomes.front().failure = plural(2, "it gave {} parameter, but {} in an earlier run",
                                          "it gave {} parameters, but {} in an earlier run", 3);
    EXPECT_EQ(from_cbor<MonteCarloRun>(cbor_of(run)).outcomes.front().failure, run.outcomes.front().failure);
}

TEST(message_values, with_other_arguments_than_slots_are_refused) {
    using nlohmann::json;
    const json text = json::array({json{{"text", "x"}}}), count = json::array({json{{"count", 1}}});
    const auto refusal = [](const json& message) { return refusal_of_json<Message>(message); };
    EXPECT_EQ(refusal({{"id", "{}"}, {"arguments", text}}), "");
    EXPECT_THAT(refusal({{"id", "{} {}"}, {"arguments", text}}), HasSubstr("other arguments than its format"));
    EXPECT_THAT(refusal({{"id", "none"}, {"arguments", text}}), HasSubstr("other arguments than its format"));
    EXPECT_THAT(refusal({{"id", "{}"}, {"arguments", json::array()}}), HasSubstr("other arguments than its format"));
    EXPECT_THAT(refusal({{"id", "{}"}, {"many", "{} {}"}, {"arguments", count}}), HasSubstr("other arguments"));
    EXPECT_THAT(refusal({{"id", "{}"}, {"many", "{}s"}, {"arguments", text}}), HasSubstr("begin with a count"));
    EXPECT_THAT(refusal({{"id", ""}, {"arguments", text}}), HasSubstr("no format"));
    EXPECT_THAT(refusal({{"id", ""}, {"many", "{}s"}, {"arguments", count}}), HasSubstr("no format"));
    EXPECT_NE(refusal("a text"), "");
    EXPECT_NE(refusal(json::object()), "");
    json list;
    list["join"] = "comma";
    list["items"][0]["id"] = "{}";
    json outer;
    outer["id"] = "{}";
    outer["arguments"][0]["list"] = list;
    EXPECT_THAT(refusal(outer), HasSubstr("arguments[1].list.items[1]"));
}

TEST(message_values, arguments_of_no_or_two_kinds_are_refused) {
    using nlohmann::json;
    const auto refusal = [](const json& argument) {
        json message;
        message["id"] = "{}";
        message["arguments"] = json::array({argument});
        return refusal_of_json<Message>(message);
    };
    EXPECT_THAT(refusal(json::object()), HasSubstr("of one kind"));
    EXPECT_THAT(refusal({{"text", "x"}, {"count", 1}}), HasSubstr("of one kind"));
    json argument;
    argument["list"]["items"] = json::array();
    argument["list"]["join"] = "glue";
    EXPECT_NE(refusal(argument), "");
    argument.clear();
    for (const int digits : {-1, 0, 18, 1000000000}) {
        argument["number"] = {{"value", 1.5}, {"digits", digits}, {"meaning", "significant"}};
        EXPECT_THAT(refusal(argument), HasSubstr("digits")) << digits;
    }
    argument["number"] = {{"value", 1e300}, {"digits", 400}, {"meaning", "decimals"}};
    EXPECT_THAT(refusal(argument), HasSubstr("digits"));
}

// Oracle: the limits of depth and memory.
TEST(message_values, nested_without_end_are_refused) {
    Message message("x");
    for (int i = 0; i < 1000; ++i) message = Message("{}", message);
    const std::string bytes = cbor_of(message);
    EXPECT_THROW(from_cbor<Message>(bytes), ValueError);
    ValueLimits limits;
    limits.memory = 1000;
    const std::string long_list = cbor_of(Message("{}", listed(std::vector<std::string>(100, "x"))));
    EXPECT_THROW(from_cbor<Message>(long_list, limits), ValueError);
}

// Oracle: the contract: what is read can be shown, whatever was done to the bytes.
TEST(message_values, wrong_bytes_give_a_message_or_an_error) {
    std::mt19937 random(7);
    const std::string bytes = cbor_of(sample());
    int read = 0, refused = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::string wrong = bytes;
        for (unsigned k = 0; k <= random() % 4; ++k) wrong[random() % wrong.size()] = static_cast<char>(random());
        if (trial % 5 == 0) wrong.erase(random() % wrong.size(), random() % 9);
        ValueLimits limits;
        limits.memory = 100'000;
        try {
            const Message message = from_cbor<Message>(wrong, limits);
            message_text(message);
            EXPECT_EQ(cbor_of(from_cbor<Message>(cbor_of(message))), cbor_of(message));
            ++read;
        } catch (const ValueError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(read, 0);
}

}  // namespace test_message_values
}  // namespace dynlab
