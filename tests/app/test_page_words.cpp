// The words of our pages, and what pages get of their translations. Oracles: the sources of the pages, which name their
// words by key; French written by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "app/page/page_files.h"
#include "app/page/page_routes.h"
#include "base/catalog.h"
#include "base/languages.h"
#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"
#include "support/page_client.h"

namespace test_page_words {
using namespace dynlab;
namespace fs = std::filesystem;

using Rows = std::map<std::string, std::string>;  // English by key

std::string source_of(const std::string& file) {
    const bool of_workbench = file.starts_with("bench_") || file.starts_with("workbench.");
    const char* const folder = file.starts_with("office") ? "engine/app/office"
                               : of_workbench             ? "engine/app/workbench"
                                                          : "engine/app/page";
    return read_text(fs::path(DYNLAB_SOURCE_DIR) / folder / file);
}

/// Without its remarks; addresses have no blank before their //.
std::string code_of(const std::string& file) {
    return std::regex_replace(source_of(file), std::regex(R"((^|\s)//[^\n]*)"), "$1");
}

/// key: tr("English"), and the other marks
void add_rows(const std::string& file, Rows& rows) {
    static const std::regex row(R"re((?:"([^"]+)"|(\w+)): tr(?:In\("[^"]*", |Plural\(|\()"([^"]*)"(?:, "[^"]*")?\))re");
    const std::string all = code_of(file), text = all.substr(0, all.find("const VIEWS"));  // these are names of views
    for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
        const std::string key = (*found)[1].str() + (*found)[2].str();
        EXPECT_TRUE(rows.emplace(key, (*found)[3]).second) << key << " stands twice";
    }
}

/// The page's own rows, and those of all pages.
Rows rows_of(const std::string& file) {
    Rows rows;
    add_rows("words.js", rows);
    add_rows(file, rows);
    return rows;
}

/// From behind an opening bracket to its closing one, or to the comma before.
std::string first_argument(const std::string& text, std::size_t begin) {
    int depth = 1;
    std::size_t end = begin;
    for (; end < text.size() && depth > 0 && !(depth == 1 && text[end] == ','); ++end)
        depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    return text.substr(begin, end - begin);
}

/// The keys that are complete literals in say(...), and the keys named in the HTML. Compared and appended literals do
/// not count.
std::set<std::string> keys_shown(const std::string& text) {
    static const std::regex call(R"(\bsay\()"), key(R"re("(\w+)"(?! *\+))re"), other(R"re((===|!==|\+) *"[^"]*")re"),
        named(R"re(data-say(?:-title|-label)?="(\w+)")re");
    std::set<std::string> keys;
    for (std::sregex_iterator found(text.begin(), text.end(), call), end; found != end; ++found) {
        const auto behind = static_cast<std::size_t>(found->position() + found->length());
        const std::string argument = std::regex_replace(first_argument(text, behind), other, "");
        for (std::sregex_iterator word(argument.begin(), argument.end(), key); word != end; ++word)
            keys.insert((*word)[1]);
    }
    for (std::sregex_iterator found(text.begin(), text.end(), named), end; found != end; ++found)
        keys.insert((*found)[1]);
    return keys;
}

/// The pages whose texts are in page_words.js: live documents and the figures of a prompt.
const std::vector<std::string> kPreview = {"index.html", "page.js",    "editor.js", "drafts.js", "findings.js",
                                           "hand_in.js", "sliders.js", "view.html", "view.js",   "text_cells.js"};

std::vector<std::string> workbench_files() {
    std::vector<std::string> files = {"workbench.html", "workbench.js"};
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "engine/app/workbench")) {
        const std::string name = entry.path().filename();
        if (name.starts_with("bench_") && name != "bench_words.js") files.push_back(name);
    }
    return files;
}

std::vector<std::string> office_files() {
    std::vector<std::string> files = {"office.html"};
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "engine/app/office")) {
        const std::string name = entry.path().filename();
        if (name.ends_with(".js") && name != "office_words.js") files.push_back(name);
    }
    return files;
}

std::string code_of(const std::vector<std::string>& files) {
    std::string all;
    for (const std::string& file : files) all += code_of(file) + "\n";
    return all;
}

void expect_rows(const std::string& code, const Rows& rows) {
    const std::set<std::string> keys = keys_shown(code);
    EXPECT_GT(keys.size(), 40u);
    for (const std::string& key : keys) EXPECT_TRUE(rows.contains(key)) << "no row for " << key;
}

bool names(const std::string& code, const std::string& key) {
    return code.find('"' + key + '"') != std::string::npos;
}

TEST(page_words, of_a_live_document_have_rows_and_no_row_is_unused) {
    const Rows rows = rows_of("page_words.js");
    const std::string code = code_of(kPreview);
    expect_rows(code, rows);
    const std::vector<std::string>& kinds = answer_kinds();
    for (const auto& [key, row] : rows)
        EXPECT_TRUE(names(code, key) || std::find(kinds.begin(), kinds.end(), key) != kinds.end()) << key;
    for (const std::string& kind : kinds) EXPECT_TRUE(rows.contains(kind)) << "answers of the kind " << kind;
}

/// Some keys are put together of a name and an ending, or of a beginning and a name.
TEST(page_words, of_the_workbench_have_rows_and_no_row_is_unused) {
    const Rows rows = rows_of("bench_words.js");
    const std::string code = code_of(workbench_files());
    expect_rows(code, rows);
    static const std::regex put_together("(no_|shape|letter|edge)?(.*?)(About|Part|Step)?");
    for (const auto& [key, row] : rows) {
        std::smatch parts;
        ASSERT_TRUE(std::regex_match(key, parts, put_together));
        std::string name = parts[2];
        if (parts[1] == "shape") name.front() = static_cast<char>(std::tolower(name.front()));
        const bool put = parts[1].matched || parts[3].matched, entry = code.find(name + ":") != std::string::npos;
        EXPECT_TRUE(names(code, key) || parts[1] == "letter" || (put && (entry || names(code, name)))) << key;
    }
}

/// The keys of states and of to-do items are built from a name and a suffix, or are in tables.
TEST(page_words, of_the_instructor_s_page_have_rows_and_no_row_is_unused) {
    const Rows rows = rows_of("office_words.js");
    const std::string code = code_of(office_files());
    expect_rows(code, rows);
    static const std::regex put_together("(.*?)(State)?");
    Rows of_all_pages;
    add_rows("words.js", of_all_pages);
    for (const auto& [key, row] : rows) {
        std::smatch parts;
        ASSERT_TRUE(std::regex_match(key, parts, put_together));
        const bool put = parts[2].matched && code.find("State`") != std::string::npos;
        EXPECT_TRUE(names(code, key) || put || of_all_pages.contains(key)) << key;
    }
}

TEST(page_words, are_written_in_the_tables_alone) {
    static const std::regex quoted(R"re("([^"\n]*)"|`([^`\n]*)`)re"), words("[A-Za-z']{2,} [a-z']{2,} [a-z']{2,}"),
        given(R"re((textContent|title|ariaLabel|innerText)(:|\s=)\s*["`][A-Za-z])re");
    std::vector<std::string> files = kPreview;
    for (const std::string& file : office_files()) files.push_back(file);
    for (const std::string& file : files) {
        if (!file.ends_with(".js")) continue;
        for (const std::string& line : lines_of(code_of(file))) {
            EXPECT_FALSE(std::regex_search(line, given)) << file << ": " << line;
            for (std::sregex_iterator found(line.begin(), line.end(), quoted), end; found != end; ++found)
                EXPECT_FALSE(std::regex_search(found->str(), words) &&
                             !found->str().starts_with("`dynlab "))  // a command
                    << file << ": " << found->str();
        }
    }
    for (const char* file : {"index.html", "workbench.html", "view.html", "office.html"}) {
        const std::string body = std::regex_replace(source_of(file), std::regex("<title>[^<]*</title>"), "");
        std::smatch text;
        EXPECT_FALSE(std::regex_search(body, text, std::regex(R"(>\s*[A-Za-z][^<>]*<)"))) << file << text.str();
        EXPECT_FALSE(std::regex_search(body, text, std::regex(R"re((aria-label|\stitle)="(?!Ctrl-S"))re")))
            << file << text.str();
    }
}

/// What the first group of a pattern finds.
std::set<std::string> all_found(const std::string& text, const std::string& pattern) {
    const std::regex expected(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator one(text.begin(), text.end(), expected), end; one != end; ++one) found.insert((*one)[1]);
    return found;
}

/// A page does not know whether a server or a worker answers. Oracle: the functions with which browsers ask servers.
TEST(page_words, one_file_of_the_document_s_page_speaks_to_the_server) {
    static const std::regex asks(R"(\b(fetch|EventSource|XMLHttpRequest|WebSocket|order)\()");
    for (const PageFile& file : page_files()) {
        const bool of_workbench = file.name.starts_with("bench_") || file.name == "workbench.js";
        const bool speaks = file.name == "orders.js" || file.name == "session.js" || file.name == "office_session.js";
        if (!file.name.ends_with(".js") || of_workbench || speaks) continue;
        EXPECT_FALSE(std::regex_search(code_of(std::string(file.name)), asks)) << file.name;
    }
    for (const char* file : {"session.js", "office_session.js"})
        EXPECT_TRUE(std::regex_search(code_of(file), asks)) << file;
}

/// The editor's own words are looked up by their English. Oracle: the sources of CodeMirror that our pages load.
TEST(page_words, contain_all_that_the_editor_s_search_says) {
    const fs::path package = "/usr/share/javascript/codemirror";
    ASSERT_TRUE(fs::exists(package)) << "libjs-codemirror, which scripts/test installs";
    std::set<std::string> said, reported;
    for (const std::string& file :
         all_found(source_of("page_routes.cpp"), R"re(\{"/codemirror[^"]*", "([^"]*\.js)"\})re"))
        said.merge(all_found(read_text(package / file), R"re(\bphrase\("([^"]*)"\))re"));
    const std::set<std::string> lists = all_found(source_of("editor.js"), R"re(const kPhrases = \[([^\]]*)\])re");
    ASSERT_EQ(lists.size(), 1u);
    const Rows rows = rows_of("page_words.js");
    for (const std::string& key : all_found(*lists.begin(), R"re("(\w+)")re")) reported.insert(rows.at(key));
    EXPECT_GT(said.size(), 5u);
    EXPECT_EQ(reported, said);
}

/// How many {} a text has.
std::size_t places_in(const std::string& text) {
    std::size_t places = 0;
    for (std::size_t at = text.find("{}"); at != std::string::npos; at = text.find("{}", at + 2)) ++places;
    return places;
}

struct Marked {
    std::string context, id;
    bool plural;
};
/// tr("English"), trIn("context", "English"), trPlural("one", "many") of all scripts.
std::vector<Marked> marked_messages() {
    static const std::regex mark(R"re(\btr(In|Plural)?\("([^"]*)"(?:, "([^"]*)")?\))re");
    std::string all;
    for (const PageFile& file : page_files())
        if (file.name.ends_with(".js")) all += code_of(std::string(file.name));
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "report_templates/html"))
        if (entry.path().extension() == ".js") all += read_text(entry.path());
    std::vector<Marked> messages;
    for (std::sregex_iterator found(all.begin(), all.end(), mark), end; found != end; ++found) {
        const bool in_context = (*found)[1] == "In";
        messages.push_back(
            {in_context ? (*found)[2].str() : "", (*found)[in_context ? 3 : 2], (*found)[1] == "Plural"});
    }
    return messages;
}

TEST(page_words, have_french_with_the_same_places) {
    const Catalog* const french = catalog_of("fr");
    ASSERT_NE(french, nullptr);
    const std::vector<Marked> messages = marked_messages();
    EXPECT_GT(messages.size(), 300u);
    const auto ends_with_space = [](std::string_view text) {
        return text.ends_with(' ') || text.ends_with("\u00A0") || text.ends_with("\u202F");
    };
    for (const auto& [context, id, plural] : messages) {
        const auto forms = french->forms(id, context);
        EXPECT_EQ(forms.size(), plural ? 2u : 1u) << id;
        for (const std::string_view form : forms) {
            EXPECT_EQ(places_in(std::string(form)), places_in(id)) << id;
            for (std::size_t at = form.find_first_of(";?!"); at != form.npos; at = form.find_first_of(";?!", at + 1))
                EXPECT_TRUE(ends_with_space(form.substr(0, at))) << form;
        }
    }
}

/// What catalogs.js gives to the script before it.
nlohmann::json catalogs_of_pages() {
    WebServer server({});
    serve_page_files(server, "view.html");
    server.start();
    const auto reply = test::PageClient(server.address()).get("/catalogs.js");
    if (!reply || reply->status != 200) return {};
    const std::string begin = "const dynlabCatalogs = ", end = ";\n";
    EXPECT_TRUE(reply->body.starts_with(begin) && reply->body.ends_with(end));
    return nlohmann::json::parse(reply->body.substr(begin.size(), reply->body.size() - begin.size() - end.size()));
}

TEST(page_words, in_french_come_from_the_server_and_english_needs_none) {
    const nlohmann::json catalogs = catalogs_of_pages();
    EXPECT_FALSE(catalogs.contains("en"));
    const nlohmann::json& french = catalogs.at("fr");
    EXPECT_EQ(french.at("decimalSign"), ",");
    EXPECT_EQ(french.at("forms").get<std::string>().substr(0, 4), "0011") << "French has 0 and 1 in the singular";
    const nlohmann::json& texts = french.at("texts");
    EXPECT_EQ(texts.at("Undo"), "Annuler");
    EXPECT_EQ(texts.at("Run all"), "Tout exécuter");
    EXPECT_EQ(texts.at("Search:"), "Chercher\u202F:");
    EXPECT_EQ(texts.at("Choose an answer."), "Choisissez une réponse.") << "of the scripts in documents, too";
    EXPECT_EQ(texts.at("{} cell, {} s"), nlohmann::json::array({"{} cellule, {} s", "{} cellules, {} s"}));
    EXPECT_EQ(texts.at("kind of answer\4truth"), "vrai ou faux");
    EXPECT_EQ(texts.at("column of a study\4truth"), "vrai");
}

TEST(page_words, in_another_language_need_only_its_catalog) {
    add_language("vo", "msgid \"Undo\"\nmsgstr \"Sädunön <b>\"\n\nmsgid \"of no page\"\nmsgstr \"nos\"\n");
    EXPECT_EQ(catalogs_of_pages().at("vo").at("texts"), nlohmann::json::parse(R"({"Undo": "Sädunön <b>"})"));
}

}  // namespace test_page_words
