// What pages get of the catalogs. Oracle: translations and plural forms written by hand.
#include "documents/html/script_catalogs.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/languages.h"

namespace test_script_catalogs {

using namespace dynlab;

nlohmann::json given(const std::string& javascript, const std::vector<std::string>& languages) {
    const std::string script = script_catalogs(javascript, languages), begin = "const dynlabCatalogs = ";
    EXPECT_TRUE(script.starts_with(begin) && script.ends_with(";\n")) << script;
    EXPECT_EQ(script.find('<'), std::string::npos) << "no text ends the page's script";
    return nlohmann::json::parse(script.substr(begin.size(), script.size() - begin.size() - 2));
}

constexpr const char* kPolish = R"po(msgid ""
msgstr "Plural-Forms: nplurals=3; plural=n==1 ? 0 : n%10>=2 && n%10<=4 && (n%100<10 || n%100>=20) ? 1 : 2;\n"

msgctxt "decimal sign"
msgid "."
msgstr ","

msgid "Stop"
msgstr "</script> \"Zatrzymaj\""

msgid "say \"{}\" \\ twice"
msgstr "dwa razy {}"

msgctxt "state"
msgid "on"
msgstr "wł."

msgid "on"
msgstr "na"

msgid "{} cell"
msgid_plural "{} cells"
msgstr[0] "{} komórka"
msgstr[1] "{} komórki"
msgstr[2] "{} komórek"

msgid "of another page"
msgstr "innej strony"
)po";

TEST(script_catalogs, hold_the_marked_messages_of_a_language) {
    add_language("pl", kPolish);
    const nlohmann::json all = given(
        "say(tr(\"Stop\"), tr(\"say \\\"{}\\\" \\\\ twice\"));\nconst a = {b: trIn(\"state\", \"on\"), c: "
        "trPlural(\"{} cell\", \"{} cells\"), d: tr(\"not translated\"), e: str(\"of another page\")};",
        {"en", "pl", "zz"});
    ASSERT_EQ(all.size(), 1u) << all;
    const nlohmann::json& polish = all.at("pl");
    EXPECT_EQ(polish.at("decimalSign"), ",");
    EXPECT_EQ(polish.at("texts"), nlohmann::json::parse(R"json({
        "Stop": "</script> \"Zatrzymaj\"", "say \"{}\" \\ twice": "dwa razy {}", "state\u0004on": "wł.",
        "{} cell": ["{} komórka", "{} komórki", "{} komórek"]})json"));
    const std::string forms = polish.at("forms");
    ASSERT_EQ(forms.size(), 200u);
    EXPECT_EQ(forms.substr(0, 6), "201112");
    EXPECT_EQ(forms.substr(112, 1), "2");
    EXPECT_EQ(forms.substr(122, 1), "1");
}

TEST(script_catalogs, of_english_are_empty) {
    EXPECT_EQ(script_catalogs("tr(\"Stop\")", {"en"}), "const dynlabCatalogs = {};\n");
}

}  // namespace test_script_catalogs
