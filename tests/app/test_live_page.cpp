// What a page shows of a document, without a browser. Oracle: the documents that the test made up.
#include "app/live/live_page.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

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

/// Findings are made in English, as programs read them.
TEST_F(live_page, tells_in_the_document_s_language_what_is_wrong_and_found) {
    const std::string wrong = "analysis.lua:3: there is no function or variable 'y'";
    const json findings = json::parse(R"({"checked": ["checks of lesson a: 0 of 3 points"], "findings": [{
        "id": "answer-missing", "severity": "rule", "place": null, "what": "The answer \"gain\" (number) is not given.",
        "remedy": "Give it: answer(\"gain\", ...)."}]})");
    page.complain({Message::verbatim(wrong)});
    page.set_work(findings.dump(), false);
    EXPECT_EQ(whole()["language"], "en");
    EXPECT_EQ(whole()["complaints"], json({wrong}));
    EXPECT_EQ(whole()["findings"], findings);
    EXPECT_EQ(page.told(Message::verbatim(wrong)), wrong);

    page.changes();
    page.speak("fr", "");
    page.complain({Message::verbatim(wrong)});
    const json changed = json::parse(page.changes().value());
    EXPECT_EQ(changed["language"], "fr");
    EXPECT_EQ(changed["complaints"], json({"analysis.lua:3: il n'y a ni fonction ni variable «\u00A0y\u00A0»"}));
    EXPECT_EQ(changed["findings"]["checked"], findings["checked"]);
    const json finding = changed["findings"]["findings"][0];
    EXPECT_EQ(finding["what"], "La réponse «\u00A0gain\u00A0» (nombre) n'est pas donnée.");
    EXPECT_EQ(finding["remedy"], "Donnez-la\u00A0: answer(\"gain\", ...).");
    EXPECT_EQ(page.told(Message::verbatim("dynlab: note: " + wrong + "\n/tmp/a.pdf (up to date)")),
              "dynlab: note: " + changed["complaints"][0].get<std::string>() + "\n/tmp/a.pdf (à jour)");
    page.set_work("no JSON", false);
    EXPECT_TRUE(whole()["findings"].is_null());
}

/// A header that turns to another language takes along what was told before it.
TEST_F(live_page, tells_again_in_a_new_language_what_was_wrong_before) {
    const std::string wrong = "analysis.lua:3: there is no function or variable 'y'";
    const json english = json::array({wrong}),
               french = json::array({"analysis.lua:3: il n'y a ni fonction ni variable «\u00A0y\u00A0»"});
    const auto changed = [&] { return json::parse(page.changes().value())["complaints"]; };
    page.complain({Message::verbatim(wrong)});
    EXPECT_EQ(changed(), english);
    page.speak("fr", "");
    EXPECT_EQ(changed(), french);
    page.complain({Message::verbatim(wrong)});
    EXPECT_FALSE(page.changes()) << "it is the same complaint";
    page.speak("en", "");
    EXPECT_EQ(changed(), english);
    SetDocument set = document("<svg>1</svg>");
    set.complaints = {Message::verbatim(wrong)};
    page.speak("fr", "");
    page.show(set, script, {});
    EXPECT_EQ(changed(), french);
    EXPECT_EQ(page.content().complaints, std::vector{Message::verbatim(wrong)})
        << "remembered for a page in any language";
    page.speak("en", "");
    EXPECT_EQ(changed(), english);
}

/// A lesson's sentences are read when they are asked for first, and anew for another lesson. Oracle: the files, which
/// the test changes meanwhile.
TEST_F(live_page, reads_the_french_of_a_lesson_once) {
    const auto add_lesson = [&](const std::string& slug, const std::string& french) {
        const auto place = folder.path() / "lessons" / slug;
        std::filesystem::create_directories(place);
        std::ofstream(place / "lesson.lua") << "-- ---\n-- title: A lesson\n-- ---\n\nprint(1)\n";
        std::ofstream(place / "checks.fr.txt") << "quuxes abound here\n  " << french << "\n";
    };
    add_lesson("91_first", "c'est deux");
    add_lesson("92_second", "il y en a deux");
    const test::EnvironmentVariable lessons("DYNLAB_LESSONS", folder.path() / "lessons");
    page.speak("fr", "91_first");
    EXPECT_EQ(page.told(Message("quuxes abound here")), "c'est deux");
    add_lesson("91_first", "changed");
    EXPECT_EQ(page.told(Message("quuxes abound here")), "c'est deux");
    page.speak("fr", "92_second");
    EXPECT_EQ(page.told(Message("quuxes abound here")), "il y en a deux");
    page.speak("fr", "");
    EXPECT_EQ(page.told(Message("quuxes abound here")), "quuxes abound here");
}

}  // namespace test_live_page
