// What a page shows of a document, without a browser. Oracle: the documents that the test made up.
#include "app/live/live_page.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "course/issues/issues_report.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"

namespace test_live_page {
using namespace dynlab;
using nlohmann::json;

class live_page : public testing::Test {
  protected:
    /// A document of one picture.
    SetDocument document(const std::string& picture) const {
        const auto file = folder.path() / "picture.svg";
        std::ofstream(file) << picture;
        SetChunk chunk;
        chunk.html = "<img src=\"@picture@\">";
        chunk.pictures.push_back({"@picture@", false, "", file});
        SetDocument set;
        set.chunks = {chunk};
        set.complaints = {Message("analysis.lua:3: no such figure")};
        return set;
    }
    json whole() const { return json::parse(page.whole()); }

    TemporaryFolder folder;
    PercentScript script = parse_percent_script("print(1)\n", "analysis.lua");
    LivePage page;
};

TEST_F(live_page, is_not_settled_while_it_is_that_of_the_run_before) {
    page.show(document("<svg>1</svg>"), script, {});
    page.set_states({{"one", {"done", 1}}}, false);
    EXPECT_TRUE(page.settled());
    EXPECT_EQ(whole()["recalled"], false);
    page.show(page.content());
    EXPECT_FALSE(page.settled());
    EXPECT_EQ(whole()["recalled"], true);
    page.set_running(true);
    EXPECT_EQ(whole()["running"], true);
    page.set_running(false);
    EXPECT_FALSE(page.settled());
    page.show(document("<svg>1</svg>"), script, {});
    EXPECT_TRUE(page.settled());
    EXPECT_EQ(whole()["recalled"], false);
}

TEST_F(live_page, content_has_what_is_wrong_and_the_pictures_that_are_shown_now) {
    for (const char* picture : {"<svg>1</svg>", "<svg>2</svg>", "<svg>3</svg>"})
        page.show(document(picture), script, {});
    const PageContent content = page.content();
    ASSERT_EQ(content.pictures.size(), 1u);
    EXPECT_EQ(content.pictures.begin()->second.bytes, "<svg>3</svg>");
    LivePage again;
    again.show(content);
    const json shown = json::parse(again.whole());
    EXPECT_EQ(shown["complaints"], json({"analysis.lua:3: no such figure"}));
    EXPECT_TRUE(again.picture(content.pictures.begin()->first));
}

const Message kWrong = Message("{}{}", "analysis.lua:3: ", Message("unknown function or variable '{}'", "y"));
constexpr const char* kWrongInEnglish = "analysis.lua:3: unknown function or variable 'y'";
constexpr const char* kWrongInFrench = "analysis.lua:3: fonction ou variable inconnue\u202F: «\u00A0y\u00A0»";

/// Issues are created in English, as programs read them.
TEST_F(live_page, reports_in_the_document_s_language_what_is_wrong_and_found) {
    CheckResult result;
    result.checked = {Message("checks of lesson {}: {} of {} points", "a", 0, 3)};
    result.findings = {{"answer-missing", Severity::kRule, 0, "",
                        Message("The answer \"{}\" (number) is missing.", "gain"),
                        Message("Submit the answer: answer(\"{}\", ...).", "gain")}};
    const json findings = json::parse(issues_as_json(result));
    page.complain({kWrong});
    page.set_work(findings.dump(), false);
    EXPECT_EQ(whole()["language"], "en");
    EXPECT_EQ(whole()["complaints"], json({kWrongInEnglish}));
    EXPECT_EQ(whole()["findings"], findings);
    EXPECT_EQ(page.translated(kWrong), kWrongInEnglish);

    page.changes();
    page.speak("fr", "");
    page.complain({kWrong});
    const json changed = json::parse(page.changes().value());
    EXPECT_EQ(changed["language"], "fr");
    EXPECT_EQ(changed["complaints"], json({kWrongInFrench}));
    EXPECT_EQ(changed["findings"]["checked"], findings["checked"]);
    const json issue = changed["findings"]["findings"][0];
    EXPECT_EQ(issue["what"], "La réponse «\u00A0gain\u00A0» (nombre) n'est pas donnée.");
    EXPECT_EQ(issue["remedy"], "Rendez la réponse\u202F: answer(\"gain\", ...).");
    EXPECT_EQ(
        page.translated(Message("{}", MessageList{{kWrong, Message("{} (up to date)", "/tmp/a.pdf")}, Join::kLines})),
        std::string(kWrongInFrench) + "\n/tmp/a.pdf (à jour)");
    page.set_work("no JSON", false);
    EXPECT_TRUE(whole()["findings"].is_null());
}

/// When the header switches to another language, earlier problems are reported again in that language.
TEST_F(live_page, reports_again_in_a_new_language_what_was_wrong_before) {
    const json english = json::array({kWrongInEnglish}), french = json::array({kWrongInFrench});
    const auto changed = [&] { return json::parse(page.changes().value())["complaints"]; };
    page.complain({kWrong});
    EXPECT_EQ(changed(), english);
    page.speak("fr", "");
    EXPECT_EQ(changed(), french);
    page.complain({kWrong});
    EXPECT_FALSE(page.changes()) << "it is the same complaint";
    page.speak("en", "");
    EXPECT_EQ(changed(), english);
    SetDocument set = document("<svg>1</svg>");
    set.complaints = {kWrong};
    page.speak("fr", "");
    page.show(set, script, {});
    EXPECT_EQ(changed(), french);
    EXPECT_EQ(page.content().complaints, std::vector{kWrong}) << "remembered for a page in any language";
    page.speak("en", "");
    EXPECT_EQ(changed(), english);
}

TEST_F(live_page, has_a_paragraph_for_each_line_of_a_complaint) {
    page.complain({Message("{}", MessageList{{kWrong, Message::verbatim("b")}, Join::kLines}), Message::verbatim("c")});
    EXPECT_EQ(whole()["complaints"], json({kWrongInEnglish, "b", "c"}));
}

/// What authors wrote is read when it is needed first, and again for another lesson. Oracle: the files, which the test
/// changes meanwhile.
TEST_F(live_page, reads_the_french_of_a_lesson_once) {
    const auto add_lesson = [&](const std::string& slug, const std::string& french) {
        const auto place = folder.path() / "lessons" / slug;
        std::filesystem::create_directories(place);
        std::ofstream(place / "lesson.lua") << "-- ---\n-- title: A lesson\n-- ---\n\nprint(1)\n";
        std::ofstream(place / "checks.fr.po") << "msgid \"quuxes abound here\"\nmsgstr \"" << french << "\"\n";
    };
    add_lesson("91_first", "c'est deux");
    add_lesson("92_second", "il y en a deux");
    const Message quuxes = Message::verbatim("quuxes abound here");
    const test::EnvironmentVariable lessons("DYNLAB_LESSONS", folder.path() / "lessons");
    page.speak("fr", "91_first");
    EXPECT_EQ(page.translated(quuxes), "c'est deux");
    add_lesson("91_first", "changed");
    EXPECT_EQ(page.translated(quuxes), "c'est deux");
    page.speak("fr", "92_second");
    EXPECT_EQ(page.translated(quuxes), "il y en a deux");
    page.speak("fr", "");
    EXPECT_EQ(page.translated(quuxes), "quuxes abound here");
}

}  // namespace test_live_page
