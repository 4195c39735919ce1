// The words of our pages in English and French. Oracle: the sources of the pages, which name their words by key.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "documents/percent_script.h"
#include "documents/text_lines.h"
#include "platform/atomic_file.h"

namespace test_page_words {
using namespace dynlab;
namespace fs = std::filesystem;

struct Row {
    std::string english, french;
};
using Rows = std::map<std::string, Row>;

std::string source_of(const std::string& file) {
    return read_text(fs::path(DYNLAB_SOURCE_DIR) / "engine/app/page" / file);
}

/// Without its remarks; addresses have no blank before their //.
std::string code_of(const std::string& file) {
    return std::regex_replace(source_of(file), std::regex(R"((^|\s)//[^\n]*)"), "$1");
}

/// key: ["English", "French"]
void add_rows(const std::string& file, Rows& rows) {
    static const std::regex row(R"re((?:"([^"]+)"|(\w+)): \["([^"]*)",\s*"([^"]*)"\])re");
    const std::string all = code_of(file), text = all.substr(0, all.find("const VIEWS"));  // these are names of views
    for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
        const std::string key = (*found)[1].str() + (*found)[2].str();
        EXPECT_TRUE(rows.emplace(key, Row{(*found)[3], (*found)[4]}).second) << key << " stands twice";
    }
}

/// The page's own rows, and those of all pages.
Rows rows_of(const std::string& file) {
    Rows rows;
    add_rows("words.js", rows);
    add_rows(file, rows);
    return rows;
}

/// From behind an opening bracket to its closing one.
std::string until_closed(const std::string& text, std::size_t begin) {
    int depth = 1;
    std::size_t end = begin;
    for (; end < text.size() && depth > 0; ++end) depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    return text.substr(begin, end - begin);
}

/// Keys that stand whole in say(...) and counted(...), other values in them aside, and those that the HTML names.
std::set<std::string> keys_shown(const std::string& text) {
    static const std::regex call(R"(\b(say|counted)\()"), key(R"re("(\w+)"(?! *\+))re"),
        other(R"re((===|!==|\+) *"[^"]*")re"), named(R"re(data-say(?:-title|-label)?="(\w+)")re");
    std::set<std::string> keys;
    for (std::sregex_iterator found(text.begin(), text.end(), call), end; found != end; ++found) {
        const auto behind = static_cast<std::size_t>(found->position() + found->length());
        const std::string arguments = std::regex_replace(until_closed(text, behind), other, "");
        for (std::sregex_iterator word(arguments.begin(), arguments.end(), key); word != end; ++word)
            keys.insert((*word)[1]);
    }
    for (std::sregex_iterator found(text.begin(), text.end(), named), end; found != end; ++found)
        keys.insert((*found)[1]);
    return keys;
}

/// The pages whose words stand in page_words.js: of live documents, and of a prompt's figures.
const std::vector<std::string> kPreview = {"index.html", "page.js",    "editor.js", "drafts.js", "findings.js",
                                           "hand_in.js", "sliders.js", "view.html", "view.js"};

std::vector<std::string> workbench_files() {
    std::vector<std::string> files = {"workbench.html", "workbench.js"};
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "engine/app/page")) {
        const std::string name = entry.path().filename();
        if (name.starts_with("bench_") && name != "bench_words.js") files.push_back(name);
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
    static const std::regex put_together("(no_|shape|letter)?(.*?)(About|Part|Step)?");
    for (const auto& [key, row] : rows) {
        std::smatch parts;
        ASSERT_TRUE(std::regex_match(key, parts, put_together));
        std::string name = parts[2];
        if (parts[1] == "shape") name.front() = static_cast<char>(std::tolower(name.front()));
        const bool put = parts[1].matched || parts[3].matched, entry = code.find(name + ":") != std::string::npos;
        EXPECT_TRUE(names(code, key) || parts[1] == "letter" || (put && (entry || names(code, name)))) << key;
    }
}

TEST(page_words, are_written_in_the_tables_alone) {
    static const std::regex quoted(R"re("([^"\n]*)"|`([^`\n]*)`)re"), words("[A-Za-z']{2,} [a-z']{2,} [a-z']{2,}"),
        given(R"re((textContent|title|ariaLabel|innerText)(:|\s=)\s*["`][A-Za-z])re");
    for (const std::string& file : kPreview) {
        if (!file.ends_with(".js")) continue;
        for (const std::string& line : lines_of(code_of(file))) {
            EXPECT_FALSE(std::regex_search(line, given)) << file << ": " << line;
            for (std::sregex_iterator found(line.begin(), line.end(), quoted), end; found != end; ++found)
                EXPECT_FALSE(std::regex_search(found->str(), words)) << file << ": " << found->str();
        }
    }
    for (const char* file : {"index.html", "workbench.html", "view.html"}) {
        const std::string body = std::regex_replace(
            source_of(file), std::regex(R"(<title>[^<]*</title>|<option [^>]*lang=[^>]*>[^<]*</option>)"), "");
        std::smatch text;
        EXPECT_FALSE(std::regex_search(body, text, std::regex(R"(>\s*[A-Za-z][^<>]*<)"))) << file << text.str();
        EXPECT_FALSE(std::regex_search(body, text, std::regex(R"re((aria-label|\stitle)="(?!Ctrl-S"))re")))
            << file << text.str();
    }
}

/// What the first group of a pattern finds.
std::set<std::string> all_found(const std::string& text, const std::string& pattern) {
    const std::regex wanted(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator one(text.begin(), text.end(), wanted), end; one != end; ++one) found.insert((*one)[1]);
    return found;
}

/// The editor's own words are looked up by their English. Oracle: the sources of CodeMirror that our pages load.
TEST(page_words, tell_all_that_the_editor_s_search_says) {
    const fs::path package = "/usr/share/javascript/codemirror";
    ASSERT_TRUE(fs::exists(package)) << "libjs-codemirror, which scripts/test installs";
    std::set<std::string> said, told;
    for (const std::string& file :
         all_found(source_of("page_routes.cpp"), R"re(\{"/codemirror[^"]*", "([^"]*\.js)"\})re"))
        said.merge(all_found(read_text(package / file), R"re(\bphrase\("([^"]*)"\))re"));
    const std::set<std::string> lists = all_found(source_of("editor.js"), R"re(const kPhrases = \[([^\]]*)\])re");
    ASSERT_EQ(lists.size(), 1u);
    const Rows rows = rows_of("page_words.js");
    for (const std::string& key : all_found(*lists.begin(), R"re("(\w+)")re")) told.insert(rows.at(key).english);
    EXPECT_GT(said.size(), 5u);
    EXPECT_EQ(told, said);
}

/// How many %1, %2, ... a text has.
std::set<std::string> places_in(const std::string& text) {
    static const std::regex place(R"(%\d)");
    std::set<std::string> places;
    for (std::sregex_iterator found(text.begin(), text.end(), place), end; found != end; ++found)
        places.insert(found->str());
    return places;
}

TEST(page_words, are_told_in_both_languages) {
    const std::set<std::string> alike = {"bar", "pdf", "onPage", "table", "script", "options"};
    for (const char* file : {"page_words.js", "bench_words.js"})
        for (const auto& [key, row] : rows_of(file)) {
            EXPECT_FALSE(row.english.empty() || row.french.empty()) << key;
            EXPECT_EQ(places_in(row.english), places_in(row.french)) << key;
            const bool sentence = row.english.find(' ') != std::string::npos && row.english.size() > 12;
            EXPECT_TRUE(!sentence || alike.contains(key) || row.english != row.french) << key;
            // words.js makes the blanks before these signs narrow: where there is none it cannot.
            for (std::size_t i = 1; i < row.french.size(); ++i)
                EXPECT_TRUE(std::string(";?!").find(row.french[i]) == std::string::npos || row.french[i - 1] == ' ')
                    << key << ": " << row.french;
        }
}

}  // namespace test_page_words
