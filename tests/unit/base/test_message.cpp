#include "base/message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/catalog.h"
#include "base/error.h"
#include "base/reader.h"
#include "numerics/error.h"

namespace dynlab {
namespace {

using ::testing::ElementsAre;

// The oracle of this file is the English and the French that a reader expects, written by hand.

const Catalog& french() {
    static const Catalog catalog(R"(msgid ""
msgstr "Plural-Forms: nplurals=2; plural=n > 1;\n"

msgctxt "decimal sign"
msgid "."
msgstr ","

msgctxt "list"
msgid " and "
msgstr " et "

msgid "{} sample"
msgid_plural "{} samples"
msgstr[0] "{} échantillon"
msgstr[1] "{} échantillons"

msgid "the fit of {} is {} % on {}"
msgstr "l'adéquation de {} est de {} % sur {}"

msgid "set {}"
msgstr "donnez {}"

msgid "two {} and {}"
msgstr "deux {}"

msgid "{} of {}"
msgstr "{2} : {1}"
)");
    return catalog;
}

TEST(message, arguments_keep_their_types_and_are_formatted_for_the_reader) {
    const Message message("the fit of {} is {} % on {}", "y1", significant(93.21, 3),
                          plural(2, "{} sample", "{} samples"));
    EXPECT_EQ(message.id(), "the fit of {} is {} % on {}");
    EXPECT_EQ(std::get<Number>(message.arguments()[1]).value, 93.21);
    EXPECT_EQ(message_text(message), "the fit of y1 is 93.2 % on 2 samples");
    EXPECT_EQ(message_text(message, {&french()}), "l'adéquation de y1 est de 93,2 % sur 2 échantillons");
}

TEST(message, plural_form_follows_the_language) {
    const auto samples = [](std::int64_t n, const Reader& reader) {
        return message_text(plural(n, "{} sample", "{} samples"), reader);
    };
    EXPECT_EQ(samples(0, {}), "0 samples");
    EXPECT_EQ(samples(1, {}), "1 sample");
    EXPECT_EQ(samples(0, {&french()}), "0 échantillon");
    EXPECT_EQ(samples(2, {&french()}), "2 échantillons");
}

TEST(message, arguments_with_braces_percent_signs_and_quotes_appear_unchanged) {
    for (const char* name : {"{}", "%s %n", "\"quoted\"", "a{0}b", "\\", "مرحبا", "{} and {}", "1.5"}) {
        EXPECT_EQ(message_text(Message("set {}", name)), std::string("set ") + name);
        EXPECT_EQ(message_text(Message("set {}", name), {&french()}), std::string("donnez ") + name);
        EXPECT_EQ(message_text(Message::verbatim(name), {&french()}), name);
    }
}

TEST(message, verbatim_text_is_empty_where_it_says_nothing) {
    EXPECT_TRUE(Message::verbatim("").empty());
    EXPECT_EQ(Message::verbatim(""), Message());
    EXPECT_FALSE(Message::verbatim(" ").empty());
}

TEST(message, lists_are_joined_in_the_language_of_the_reader) {
    const Message message("set {}", listed({"a", "b", "c"}, Join::kAnd));
    EXPECT_EQ(message_text(message), "set a, b and c");
    EXPECT_EQ(message_text(message, {&french()}), "donnez a, b et c");
    EXPECT_EQ(message_text(sentences({Message("One."), Message("Two {}.", 2)})), "One. Two 2.");
    EXPECT_TRUE(sentences({}).empty());
}

TEST(message, option_has_the_name_that_its_reader_knows) {
    const Message message("set {}", OptionName{"max_iterations"});
    EXPECT_EQ(message_text(message), "set `max_iterations`");
    const Reader script{
        nullptr, [](std::string_view member) { return std::string(member == "max_iterations" ? "MaxIter" : "?"); }};
    EXPECT_EQ(message_text(message, script), "set MaxIter");
}

TEST(message, translation_may_take_the_arguments_in_another_order) {
    EXPECT_EQ(message_text(Message("{} of {}", "y{1}", "{1}"), {&french()}), "{1} : y{1}");
}

TEST(message, what_authors_wrote_is_looked_up_whole_in_their_own_catalog) {
    const Catalog authors("msgid \"Hz is wanted.\"\nmsgstr \"On demande des Hz.\"\n");
    const Reader reader{&french(), nullptr, &authors};
    const Message expected = Message::verbatim("Hz is wanted.");
    EXPECT_EQ(message_text(expected, reader), "On demande des Hz.");
    EXPECT_EQ(message_text(Message("set {}", expected), reader), "donnez On demande des Hz.");
    EXPECT_EQ(message_text(sentences({expected, Message("set {}", 1.5)}), reader), "On demande des Hz. donnez 1,5");
    EXPECT_EQ(message_text(Message("set {}", "Hz is wanted."), reader), "donnez Hz is wanted.") << "a name";
    EXPECT_EQ(message_text(Message::verbatim("Hz is wanted. So"), reader), "Hz is wanted. So");
    EXPECT_EQ(message_text(expected), "Hz is wanted.");
}

TEST(message, translation_with_missing_arguments_falls_back_to_english) {
    EXPECT_EQ(message_text(Message("two {} and {}", 1, 2), {&french()}), "two 1 and 2");
    EXPECT_EQ(message_text(Message("not in the catalog: {}", 1.5), {&french()}), "not in the catalog: 1,5");
}

TEST(message, numbers_have_the_digits_that_were_asked_for) {
    EXPECT_EQ(number_text(significant(0.050, 4)), "0.05");
    EXPECT_EQ(number_text(significant(-0.0, 4)), "0");
    EXPECT_EQ(number_text(decimals(93.2, 2)), "93.20");
    EXPECT_EQ(number_text(decimals(-0.001, 2)), "0.00");
    EXPECT_EQ(number_text(decimals(1e300 * 1e10, 2)), "Inf");
    EXPECT_EQ(number_text(decimals(1.5, 1), {&french()}), "1,5");
}

TEST(message, stored_parts_give_the_same_message) {
    const Message message = plural(3, "{} of {}", "{} in {}", "file.csv");
    EXPECT_EQ(Message::stored(message.id(), message.many(), message.arguments()), message);
    EXPECT_THROW(Message::stored("{} and {}", "", {std::int64_t{1}}), std::invalid_argument);
    EXPECT_THROW(Message::stored("{}", "{}", {Number{1.0}}), std::invalid_argument);
}

TEST(message, stored_parts_of_an_empty_message_are_empty) {
    EXPECT_TRUE(Message::stored("", "", {}).empty());
    EXPECT_THROW(Message::stored("", "", {std::int64_t{1}}), std::invalid_argument);
    EXPECT_THROW(Message::stored("", "{} samples", {std::int64_t{2}}), std::invalid_argument);
}

TEST(message, stored_numbers_have_at_most_17_digits) {
    for (const Number& number : {significant(1, 1), significant(1, 17), decimals(1, 0), decimals(1, 17)})
        EXPECT_EQ(Message::stored("{}", "", {number}), Message("{}", number));
    for (const Number& number :
         {significant(1, 0), significant(1, -1), significant(1, 18), decimals(1, -1), decimals(1, 400)})
        EXPECT_THROW(Message::stored("{}", "", {number}), std::invalid_argument);
}

TEST(message, errors_carry_their_message) {
    try {
        throw InvalidArgument("{} needs at least {}", "srivc", plural(4, "{} sample", "{} samples"));
    } catch (const std::exception& error) {
        EXPECT_STREQ(error.what(), "srivc needs at least 4 samples");
        EXPECT_EQ(message_of(error).id(), "{} needs at least {}");
    }
    EXPECT_EQ(message_of(std::runtime_error("of a library {}")), Message::verbatim("of a library {}"));
}

}  // namespace
}  // namespace dynlab
