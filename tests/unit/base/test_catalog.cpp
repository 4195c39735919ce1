#include "base/catalog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace dynlab {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Oracle: the forms that the languages' grammars ask for; the expressions are those of the gettext manual, section
// "Plural forms".
TEST(catalog, plural_rules_choose_the_forms_of_the_languages) {
    const PluralRule english("nplurals=2; plural=n != 1;");
    EXPECT_EQ(english.form(0), 1u);
    EXPECT_EQ(english.form(1), 0u);
    const PluralRule japanese("nplurals=1; plural=0;");
    EXPECT_EQ(japanese.form(7), 0u);
    const PluralRule polish("nplurals=3; plural=n==1 ? 0 : n%10>=2 && n%10<=4 && (n%100<10 || n%100>=20) ? 1 : 2;");
    for (const std::int64_t one : {1}) EXPECT_EQ(polish.form(one), 0u);
    for (const std::int64_t few : {2, 3, 4, 22, 103, 1004}) EXPECT_EQ(polish.form(few), 1u) << few;
    for (const std::int64_t many : {0, 5, 11, 12, 14, 21, 100, 112, 1011}) EXPECT_EQ(polish.form(many), 2u) << many;
    const PluralRule slovenian("nplurals=4; plural=n%100==1 ? 0 : n%100==2 ? 1 : n%100==3 || n%100==4 ? 2 : 3;");
    EXPECT_EQ(slovenian.form(101), 0u);
    EXPECT_EQ(slovenian.form(202), 1u);
    EXPECT_EQ(slovenian.form(4), 2u);
    EXPECT_EQ(slovenian.form(5), 3u);
    const PluralRule arabic(
        "nplurals=6; plural=n==0 ? 0 : n==1 ? 1 : n==2 ? 2 : n%100>=3 && n%100<=10 ? 3 : n%100>=11 ? 4 : 5;");
    const std::vector<std::int64_t> firsts = {0, 1, 2, 3, 11, 100};
    for (std::size_t form = 0; form < firsts.size(); ++form) EXPECT_EQ(arabic.form(firsts[form]), form);
}

TEST(catalog, plural_rules_that_cannot_be_read_are_refused) {
    for (const char* rule :
         {"nplurals=2", "plural=n;", "nplurals=0; plural=0;", "nplurals=2; plural=n;", "nplurals=2; plural=n >;",
          "nplurals=2; plural=(n > 1;", "nplurals=2; plural=m;", "nplurals=2; plural=n ? 1;", "nplurals=7; plural=0;"})
        EXPECT_THROW(PluralRule{rule}, std::runtime_error) << rule;
    EXPECT_EQ(PluralRule("nplurals=2; plural=n / 0;").form(5), 0u);
    EXPECT_THROW(PluralRule("nplurals=2; plural=" + std::string(100000, '(') + "n"), std::runtime_error);
}

TEST(catalog, entries_of_a_po_file_are_read) {
    const Catalog catalog(R"(# A comment.
msgid ""
msgstr ""
"Content-Type: text/plain; charset=UTF-8\n"
"Plural-Forms: nplurals=2; plural=n > 1;\n"

#: engine/a.cpp:3
msgid "one\n"
"two \"three\" \\ {}"
msgstr ""
"un\tdeux {}"

#, fuzzy
#| msgid "before"
msgid "uncertain"
msgstr "incertain"

msgid "untranslated"
msgstr ""

msgctxt "menu"
msgid "open"
msgstr "ouvrir"
msgid "{} file"
msgid_plural "{} files"
msgstr[0] "{} fichier"
msgstr[1] "{} fichiers"

#~ msgid "obsolete"
#~ msgstr "obsolète"
)");
    EXPECT_EQ(catalog.translation("one\ntwo \"three\" \\ {}"), "un\tdeux {}");
    EXPECT_EQ(catalog.translation("uncertain"), "");
    EXPECT_EQ(catalog.translation("untranslated"), "");
    EXPECT_EQ(catalog.translation("obsolete"), "");
    EXPECT_EQ(catalog.translation("open"), "");
    EXPECT_EQ(catalog.translation("open", "menu"), "ouvrir");
    EXPECT_EQ(catalog.plural("{} file", 0), "{} fichier");
    EXPECT_EQ(catalog.plural("{} file", 2), "{} fichiers");
    EXPECT_THAT(catalog.forms("{} file"), ElementsAre("{} fichier", "{} fichiers"));
    EXPECT_THAT(catalog.forms("open", "menu"), ElementsAre("ouvrir"));
    EXPECT_TRUE(catalog.forms("open").empty());
    EXPECT_EQ(catalog.rule().form(1), 0u);
    EXPECT_EQ(catalog.size(), 3u);
    EXPECT_EQ(catalog.decimal_sign(), ".");
    EXPECT_EQ(catalog.list_separator(" and "), " and ");
}

TEST(catalog, broken_files_are_refused_with_their_line) {
    const auto reading = [](std::string text) { return [text = std::move(text)] { Catalog{text}; }; };
    EXPECT_THAT(reading("msgid \"a\"\nmsgstr b\n"), ThrowsMessage<std::runtime_error>(HasSubstr("line 2")));
    EXPECT_THAT(reading("msgid \"a\"\n\nmsgid \"b\"\n"), ThrowsMessage<std::runtime_error>(HasSubstr("msgstr")));
    EXPECT_THAT(reading("\"a\"\n"), ThrowsMessage<std::runtime_error>(HasSubstr("line 1")));
    EXPECT_THAT(reading("msgid \"a\nmsgstr \"b\"\n"), ThrowsMessage<std::runtime_error>(HasSubstr("quotation")));
    EXPECT_THAT(reading("msgid \"a\\x\"\n"), ThrowsMessage<std::runtime_error>(HasSubstr("escape")));
    EXPECT_THAT(reading("msgid \"a\"\nmsgstr[1] \"b\"\n"), ThrowsMessage<std::runtime_error>(HasSubstr("numbered")));
    EXPECT_THAT(reading("\x7f"
                        "ELF"),
                ThrowsMessage<std::runtime_error>(HasSubstr("line 1")));
    EXPECT_EQ(Catalog("").size(), 0u);
}

}  // namespace
}  // namespace dynlab
