// The page of a French document. Oracle: French sentences written by hand, and words of English that no French text
// has.
#include <gmock/gmock.h>

#include <regex>

#include "support/preview.h"

namespace test_preview_french {
using namespace dynlab;
using namespace dynlab::test;
using testing::HasSubstr;
namespace fs = std::filesystem;

class preview_french : public preview_page {
  protected:
    /// The texts of a part of the page: those on the screen and those for screen readers.
    static std::string all_words(Browser& browser, const std::string& selector) {
        return browser.evaluate("return [...document.querySelectorAll('" + selector +
                                "')].flatMap((part) => [part, "
                                "...part.querySelectorAll('*')].flatMap((node) => [node.title, node.ariaLabel, "
                                "...[...node.childNodes].filter((child) => child.nodeType === 3).map((child) => "
                                "child.data)])).filter((words) => words?.trim()).join(' | ')");
    }
    static void expect_no_english(const std::string& words) {
        static const std::regex english(
            "(^|[^A-Za-z])(the|this|is|are|it|its|not|of|with|run|every|again|saved?|leaves|found|finds|"
            "made|hints?|open|given|printed|cells?)($|[^A-Za-z])",
            std::regex::icase);
        std::smatch found;
        EXPECT_FALSE(std::regex_search(words, found, english)) << found.str() << " in " << words;
    }
    bool says(Browser& browser, const std::string& id, const std::string& pattern, double seconds = 30) const {
        return browser.becomes_true("/" + pattern + "/.test(document.getElementById('" + id + "').innerText)", seconds);
    }
};

const std::string kFrench = "-- ---\n-- title: Un document\n-- language: fr\n-- ---\n\n";
const std::string kSome =
    "-- %% [markdown]\n-- # Premier\n--\n-- Des mots au début.\n\n-- %% id=un\nlocal x = 20\nprint(\"x vaut \" .. "
    "x)\n\n"
    "-- %% id=choix\nlocal k = slider(\"k\", 2.5, 1, 10, {step = 0.5, unit = \"V\", label = \"gain\"})\n\n"
    "-- %% id=suite\nprint(\"k vaut \" .. k)\n\n";

TEST_F(preview_french, the_page_speaks_its_document_s_language) {
    write(kFrench + kSome);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "k vaut 2.5"));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.editing .CodeMirror')"));
    EXPECT_EQ(browser.evaluate("return document.documentElement.lang"), "\"fr\"");
    EXPECT_TRUE(says(browser, "state", "^\\d cellules, \\d+,\\d s$"));
    EXPECT_TRUE(says(browser, "run-all", "^Tout exécuter$"));
    EXPECT_TRUE(says(browser, "save", "^Enregistrer$"));
    EXPECT_EQ(browser.evaluate("return document.getElementById('run-all').title"),
              "\"Exécuter de nouveau toutes les cellules\"");
    EXPECT_EQ(browser.evaluate("return document.getElementById('editor').getAttribute('aria-label')"),
              "\"Texte source\"");
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.slider output').innerText.startsWith('2,5')"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.slider button').textContent === 'Réinitialiser'"));
    for (const char* part : {"#bar", "#editor-bar", "#conflict", "#draft", "#question", "#hand-in"})
        expect_no_english(all_words(browser, part));

    std::string wrong = kFrench + kSome;
    wrong.replace(wrong.find("Des mots"), 3, "Voir @fig:rien. Des");
    write(wrong);
    EXPECT_TRUE(says(browser, "complaints", "le renvoi @fig:rien n.a pas de cible"));
    wrong = kFrench + kSome;
    wrong.replace(wrong.find("print("), 6, "pritn(");
    write(wrong);
    EXPECT_TRUE(says(browser, "state", "^arrêté par une erreur$"));
    EXPECT_TRUE(says(browser, "to-mistake", "^Aller à l.erreur$"));
    EXPECT_TRUE(shows(browser, "fonction ou variable inconnue"));

    write(kHead + kFirst);  // English from here on
    EXPECT_TRUE(shows(browser, "x is 20"));
    EXPECT_TRUE(browser.becomes_true("document.documentElement.lang === 'en'"));
    EXPECT_TRUE(says(browser, "run-all", "^Run all$"));
}

/// What the editor itself says is in the page's language as well, and follows it.
TEST_F(preview_french, the_editor_s_search_speaks_it_too) {
    write(kFrench + kSome);
    const Preview preview(file(), true, {"--edit"});
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "k vaut 2.5"));
    ASSERT_TRUE(browser.becomes_true(
        "document.querySelector('.editing .CodeMirror')?.CodeMirror.getValue().includes('k vaut')"));
    const auto key_in_field = [](int code) {
        return "field?.dispatchEvent(new KeyboardEvent('keydown', {keyCode: " + std::to_string(code) +
               ", bubbles: true, cancelable: true}));";
    };
    const std::string field = "const field = document.querySelector('.CodeMirror-dialog input'); ";
    const auto asked = [&](const std::string& command) {  // what is open is closed before
        browser.evaluate(field + key_in_field(27) +
                         "[...document.querySelectorAll('.CodeMirror-dialog button')].pop()?.click();"
                         "document.querySelector('.CodeMirror').CodeMirror.execCommand('" +
                         command + "')");
        return all_words(browser, ".CodeMirror-dialog");
    };
    const auto answer = [&](const std::string& words) {
        browser.evaluate(field + "field.value = '" + words + "'; " + key_in_field(13));
        return all_words(browser, ".CodeMirror-dialog");
    };
    const std::string search = asked("find");
    EXPECT_THAT(search, testing::AllOf(HasSubstr("Chercher\u202F:"), HasSubstr("expression rationnelle")));
    EXPECT_THAT(asked("replaceAll"), HasSubstr("Tout remplacer\u202F:"));
    EXPECT_THAT(asked("replace"), HasSubstr("Remplacer\u202F:"));
    EXPECT_THAT(answer("vaut"), HasSubstr("Par\u202F:"));
    const std::string question = answer("est");
    EXPECT_THAT(question, testing::AllOf(HasSubstr("Remplacer\u202F?"), HasSubstr("Oui"), HasSubstr("Non"),
                                         HasSubstr("Tout"), HasSubstr("Arrêter")));
    for (const std::string& words : {search, question}) expect_no_english(words);

    write(kHead + kFirst);  // English from here on
    EXPECT_TRUE(shows(browser, "x is 20"));
    EXPECT_TRUE(browser.becomes_true("document.documentElement.lang === 'en'"));
    EXPECT_THAT(asked("find"), testing::AllOf(HasSubstr("Search:"), HasSubstr("(Use /re/ syntax for regexp search)")));
}

TEST_F(preview_french, an_untrusted_document_asks_in_french) {
    write(kFrench + kSome);
    const Preview preview(file(), false);
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("!document.getElementById('question').hidden"));
    EXPECT_TRUE(says(browser, "question", "Ce document exécute des programmes. L.exécuter.\\?"));
    EXPECT_TRUE(says(browser, "allow", "^L.exécuter$"));
    browser.evaluate("fetch('document.pdf').then(async r => { window.refused = r.status + await r.text() })");
    EXPECT_TRUE(browser.becomes_true("/^403Ce document n.a pas encore le droit/.test(window.refused)"));
    browser.click("#allow");
    EXPECT_TRUE(shows(browser, "x vaut 20"));
}

TEST_F(preview_french, findings_and_what_is_submitted_are_reported_in_french) {
    fs::create_directory(folder.path() / "mine");
    write(
        "-- ---\n-- title: Un rapport\n-- language: fr\n-- template: lesson\n-- answers:\n--   gain: number\n-- ---\n\n"
        "-- %% [markdown]\n-- **Question 1.** Quel gain ? `gain` est un nombre.\n\n-- %% id=demande\n-- VOTRE CODE "
        "ICI\n",
        "mine/analysis.lua");
    write("---\ntitle: Un rapport\nlang: fr\n---\n\n::: cells\n:::\n", "mine/report.md");
    write(
        "check {\n  id = \"gain\", points = 3, about = \"le gain\", hint = \"C'est deux.\",\n"
        "  test = function(a) return near(a.gain, 2) end }\n",
        "mine/checks.lua");
    const Preview preview(folder.path() / "mine");
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(shows(browser, "Quel gain"));
    EXPECT_TRUE(says(browser, "show-findings", "1 réponse manquante, \\d règles? enfreintes?.*, 0 sur 3 points", 120))
        << browser.evaluate("return document.getElementById('show-findings').innerText");
    browser.click("#show-findings");
    for (const char* words : {"Réponses manquantes", "gain \\(nombre\\)", "À corriger",
                              "La question 1 est sans réponse", "Vérifications de la leçon.: 0 sur 3 points"})
        EXPECT_TRUE(says(browser, "findings", words)) << words;
    expect_no_english(all_words(browser, "#findings"));

    browser.click("#show-hand-in");
    EXPECT_TRUE(says(browser, "made", "dynlab crée le rapport à partir du script enregistré"));
    browser.click("#make-report");
    EXPECT_TRUE(says(browser, "made", "mine\\/report.pdf", 60));
    EXPECT_TRUE(browser.becomes_true("!document.getElementById('make-pack').disabled"));
    browser.click("#make-pack");
    EXPECT_TRUE(says(browser, "made", "mine\\.zip.: \\d fichiers, SHA-256", 60))
        << browser.evaluate("return document.getElementById('made').innerText");
}

/// What the document's own scripts add to the page: they are there before its language is known.
TEST_F(preview_french, questions_and_plants_speak_it_too) {
    write(
        kFrench +
        "-- %% [markdown]\n-- ::: choice\n-- Combien font deux et deux ?\n--\n-- - [ ] Trois.\n--\n--   Il en manque.\n"
        "-- - [x] Quatre.\n--\n--   Comptez.\n-- :::\n\n-- %% id=mobile\nlocal t = linspace(0, 4, 201)\n"
        "motion{plant = \"thruster\", t = t, measured = {force = 20*sin(t)}, simulated = {force = 18*sin(t)}}\n");
    const Preview preview(file());
    Browser browser;
    browser.open(preview.address());
    ASSERT_TRUE(browser.becomes_true("document.querySelectorAll('.option').length === 2"));
    EXPECT_TRUE(browser.becomes_true("document.querySelector('.asked [aria-label=\"Choisissez une réponse.\"]')"));
    ASSERT_TRUE(browser.becomes_true("document.querySelector('.motion button')"));
    EXPECT_EQ(browser.evaluate("return document.querySelector('.motion button').innerText"), "\"Lecture\"");
    EXPECT_TRUE(browser.becomes_true("/mesuré .* N, . simulé .* N/.test(document.querySelector('.motion').innerText)"));
}

}  // namespace test_preview_french
