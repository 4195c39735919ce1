// An error stays a message with arguments on its way from C++ through Lua to the run log. Oracles: the ids and
// arguments in the sources, and the texts for students, written by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/catalog.h"
#include "base/reader.h"
#include "script_run.h"
#include "scripting/conversions/option_words.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/kind_phrases.h"

namespace dynlab::test {
namespace test_error_messages {

using testing::HasSubstr;

RecordedError error_in(const std::string& code) {
    const RunRecord record = run(code);
    return record.error.value_or(RecordedError{Message("no error")});
}

/// The message behind "name: ".
Message said_by(const std::string& name, const Message& message) {
    EXPECT_EQ(message.id(), "{}: {}");
    EXPECT_EQ(message.arguments().front(), MessageArgument(name));
    return std::get<MessageList>(message.arguments().back()).items.front();
}

TEST(error_messages, of_a_function_have_its_name_and_arguments) {
    const RecordedError error = error_in("local x = 1\nzeros('a')");
    EXPECT_EQ(error.file, "lesson.lua");
    EXPECT_EQ(error.line, 2);
    const Message sentence = said_by("zeros", error.message);
    EXPECT_EQ(sentence.id(), "{} must be {}, but {} was given");
    EXPECT_EQ(sentence.arguments()[0], message_argument(Message("argument {} ({})", 1, Message::verbatim("n"))));
    EXPECT_EQ(sentence.arguments()[1], message_argument(Message("a number")));
    EXPECT_EQ(sentence.arguments()[2], message_argument(Message("the string \"{}\"", "a")));
    EXPECT_EQ(error.text(), "lesson.lua:2: zeros: argument 1 (n) must be a number, but the string \"a\" was given");
}

TEST(error_messages, of_lua_itself_become_messages) {
    const RecordedError error = error_in("local x\nprint(x.a)");
    EXPECT_EQ(error.message, Message("{} is {}, so it has no fields or elements", Message("the variable '{}'", "x"),
                                     Message("nil (it has no value)")));
    EXPECT_EQ(error.line, 2);
    EXPECT_EQ(error_in("local = 3").message, Message("expected a name before '{}'", "="));
    EXPECT_EQ(error_in("print(yy)").message, Message("unknown function or variable '{}'", "yy"));
}

TEST(error_messages, are_translated_after_the_run) {
    const Catalog french(R"po(msgid ""
msgstr "Plural-Forms: nplurals=2; plural=n > 1;\n"

msgid "{} must be {}, but {} was given"
msgstr "{} doit être {}, mais {} a été donné"

msgid "argument {} ({})"
msgstr "l'argument {} ({})"

msgid "a vector of {}"
msgstr "un vecteur de {}"

msgid "{} value"
msgid_plural "{} values"
msgstr[0] "{} valeur"
msgstr[1] "{} valeurs"

msgid "a number"
msgstr "un nombre"
)po");
    EXPECT_EQ(message_text(error_in("zeros(vector{1, 2})").message, {&french}),
              "zeros: l'argument 1 (n) doit être un nombre, mais un vecteur de 2 valeurs a été donné");
}

TEST(error_messages, survive_a_script_that_catches_and_raises_them_again) {
    const RecordedError direct = error_in("zeros(-1)");
    for (const char* code : {"local ok, e = pcall(zeros, -1) error(e, 0)",
                             "local ok, e = xpcall(zeros, function(e) return e end, -1) error(e, 0)",
                             "local c = coroutine.wrap(function() zeros(-1) end) c()",
                             "local c = coroutine.create(function() zeros(-1) end)\n"
                             "local ok, e = coroutine.resume(c) error(e, 0)"}) {
        const RecordedError again = error_in(code);
        EXPECT_EQ(again.message, direct.message) << code;
        EXPECT_EQ(again.line, 1) << code;
    }
}

TEST(error_messages, that_the_script_made_or_changed_are_verbatim) {
    const RecordedError changed = error_in("local ok, e = pcall(zeros, -1)\nerror('so: ' .. e, 0)");
    EXPECT_EQ(changed.message.id(), "{}");
    EXPECT_THAT(changed.text(), HasSubstr("zeros: argument 1 (n) must be nonnegative"));
    const RecordedError own = error_in("\nerror('my own {} sentence')");
    EXPECT_EQ(own.message, Message::verbatim("my own {} sentence"));
    EXPECT_EQ(own.line, 2);
    EXPECT_EQ(error_in("pcall(zeros, -1)\nerror('other')").message, Message::verbatim("other"));
    EXPECT_EQ(error_in("error({})").message.id(), "{}");
    EXPECT_EQ(error_in("error()").message, Message("error() was called without a message; write error(\"message\")"));
}

TEST(error_messages, of_a_function_of_the_script_are_quoted_with_their_place) {
    const RecordedError error = error_in(
        "local u = randn(20)\nlocal d = iddata(u, u, 1)\n"
        "sindy(d, {library = function(x, u)\n  return zeros(-1)\nend})");
    EXPECT_EQ(error.line, 3);
    const Message quoted = said_by("sindy", error.message);
    ASSERT_EQ(quoted.id(), "{}:{}: {}");
    EXPECT_EQ(quoted.arguments()[1], MessageArgument(std::int64_t{4}));
    EXPECT_EQ(message_text(quoted), "lesson.lua:4: zeros: argument 1 (n) must be nonnegative, but -1 was given");
}

TEST(error_messages, options_have_the_names_of_scripts_for_every_reader) {
    const Message message("{} of {}", OptionName{"max_iterations"}, Message("at most {}", OptionName{"no_such"}));
    EXPECT_EQ(message_text(with_script_options(message, {nullptr, option_name})), "MaxIter of at most `no_such`");
    EXPECT_EQ(message_text(message, {nullptr, option_name}), "MaxIter of at most `no_such`");
    EXPECT_EQ(with_script_options(plural(2, "{} pole", "{} poles"), {}), plural(2, "{} pole", "{} poles"));
}

// A kind without phrases would stay English in every language.
TEST(error_messages, all_kinds_of_objects_have_phrases) {
    for (const TypeEntry& entry : catalog_of_types()) {
        EXPECT_NE(with_article(entry.type->name).id(), "{}") << entry.type->name;
        EXPECT_NE(with_the(entry.type->name).id(), "{}") << entry.type->name;
    }
    for (const char* kind : {"number", "string", "boolean", "table", "function", "thread"})
        EXPECT_NE(with_article(kind).id(), "{}") << kind;
}

}  // namespace test_error_messages
}  // namespace dynlab::test
