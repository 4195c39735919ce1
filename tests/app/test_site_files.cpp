// The files of a site. Oracles: the folder that `dynlab new` makes, the lessons' sources, sha256sum, the files
// themselves, and the text that Chromium prints of a page without scripts.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "app/made_site.h"
#include "data_io/dataset_index.h"
#include "support/browser.h"

namespace dynlab::test {
namespace test_site {
using nlohmann::json;
using testing::HasSubstr;

const fs::path kLessons = fs::path(DYNLAB_SOURCE_DIR) / "lessons";

/// The lines of a lesson's solutions, and the other lines with their replacement in the student's copy.
struct LessonLines {
    std::vector<std::string> solution;
    std::string open;
};

/// Letters and digits alone, so that marks of Markdown, HTML and JSON make no difference.
std::string letters_of(const std::string& text) {
    std::string letters;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == 'n')
            ++i;
        else if (std::isalnum(static_cast<unsigned char>(text[i])))
            letters += text[i];
    }
    return letters;
}

LessonLines lines_of_lesson(const std::string& script) {
    LessonLines lines;
    bool solution = false;
    std::istringstream stream(script);
    for (std::string line; std::getline(stream, line);) {
        if (line.find("-- BEGIN SOLUTION") != std::string::npos) solution = true;
        if (!solution || line.find("STARTER:") != std::string::npos)
            lines.open += letters_of(line);
        else
            lines.solution.push_back(letters_of(line));
        if (line.find("-- END SOLUTION") != std::string::npos) solution = false;
    }
    return lines;
}

/// HTML and JSON as their readers see them, in letters alone.
std::string readable_letters(std::string content) {
    for (const auto& [entity, letter] : {std::pair{"&lt;", " "}, {"&gt;", " "}, {"&quot;", " "}, {"&amp;", " "}})
        for (std::size_t at = 0; (at = content.find(entity, at)) != std::string::npos;)
            content.replace(at, std::string_view(entity).size(), letter);
    return letters_of(content);
}

TEST(site, links_lead_to_files_of_the_site) {
    const MadeSite& site = made_site();
    ASSERT_EQ(site.made.exit_code, 0) << site.made.error_output;
    std::map<std::string, std::set<std::string>> ids;
    for (const auto& [file, html] : site.pages)
        for (const std::string& id : attributes(html, "id"))
            EXPECT_TRUE(ids[file].insert(id).second) << file << " has " << id << " twice";
    std::size_t links = 0;
    for (const auto& [file, html] : site.pages) {
        const bool based = file == "workbench/index.html";
        if (!based) {
            EXPECT_THAT(html, testing::ContainsRegex("<html lang=\"(en|fr)\"")) << file;
        }
        const fs::path folder = based ? "page" : fs::path(file).parent_path();
        const auto target_of = [&](const std::string& link) {
            return (folder / link.substr(0, link.find('#'))).lexically_normal().generic_string();
        };
        for (const std::string& source : attributes(html, "src"))
            if (source != "data:,") {
                EXPECT_TRUE(site.files.count(target_of(source))) << file << ": " << source;
            }
        for (const std::string& link : attributes(html, "href")) {
            if (link.starts_with("https://") || link.starts_with("http://") || link == "data:,") continue;
            if (based && link == "../page/") continue;
            const std::string target = link.starts_with("#") ? file : target_of(link);
            EXPECT_TRUE(site.files.count(target)) << file << ": " << link;
            if (link.find('#') == std::string::npos) continue;
            EXPECT_TRUE(ids[target].count(link.substr(link.find('#') + 1))) << file << ": " << link;
            ++links;
        }
        // Scripts are files: a strict policy of a server refuses those in a page.
        for (std::size_t at = 0; (at = html.find("<script", at)) != std::string::npos; ++at) {
            const std::string tag = html.substr(at, html.find('>', at) - at);
            EXPECT_THAT(tag, testing::AnyOf(HasSubstr(" src=\""), HasSubstr("application/json"))) << file;
        }
    }
    EXPECT_GT(links, 50u);
}

TEST(site, files_json_lists_every_file_with_its_hash) {
    const MadeSite& site = made_site();
    ASSERT_EQ(site.made.exit_code, 0) << site.made.error_output;
    const json list = json::parse(site.files.at("files.json"));
    std::istringstream sums(
        site.bench.shell("cd site && find . -type f | sed 's,^./,,' | xargs -d '\\n' sha256sum").output);
    std::map<std::string, std::string> hashes;
    for (std::string line; std::getline(sums, line);) hashes[line.substr(66)] = line.substr(0, 16);
    for (const char* other : {"files.json", "site-files.txt", "sw.js"}) hashes.erase(other);
    EXPECT_EQ(list["files"].size(), hashes.size());
    for (const json& file : list["files"]) {
        const std::string path = file["path"];
        EXPECT_EQ(file["sha256"], hashes[path]) << path;
        EXPECT_EQ(file["bytes"].get<std::size_t>(), site.files.at(path).size()) << path;
    }
    EXPECT_EQ(list["version"].get<std::string>().size(), 16u);
    for (const char* file : {"engine/dynlab.js", "engine/dynlab.wasm", "page/catalogs.js", "page/codemirror.js",
                             "manifest.webmanifest", "data/crane/SOURCE.md"})
        EXPECT_TRUE(hashes.count(file)) << file;
    const json data = json::parse(site.files.at("data/index.json"));
    EXPECT_EQ(data.size(), dataset_names().size());
    for (const auto& [name, files] : data.items())
        for (const json& file : files)
            EXPECT_EQ(site.files.at("data/" + name + "/" + file["file"].get<std::string>()).size(),
                      file["bytes"].get<std::size_t>());
    // The measured data of a Debian package, with every digit. The program reads the same data from both places.
    site.bench.write("both.lua",
                     "local a, b = load(\"hairdryer\"), load(\"site/data/hairdryer/hairdryer.csv\")\n"
                     "local same = a.Ts == b.Ts and #a.y == #b.y\n"
                     "for i = 1, #a.y do same = same and a.y[i] == b.y[i] and a.u[i] == b.u[i] end\n"
                     "print(same, #a.y)\n");
    EXPECT_THAT(site.bench.dynlab({"run", "both.lua"}).output, HasSubstr("true\t1000"));
}

TEST(site, lesson_json_has_what_dynlab_new_writes) {
    const MadeSite& site = made_site();
    ASSERT_EQ(site.made.exit_code, 0) << site.made.error_output;
    std::size_t compared = 0;
    for (const auto& [name, content] : site.files) {
        if (!name.ends_with("/lesson.json")) continue;
        const json lesson = json::parse(content);
        const std::string slug = lesson["lesson"], language = lesson["language"], copy = slug + "-" + language;
        std::vector<std::string> words = {"new", slug, copy};
        if (language != "en") words.insert(words.end(), {"--lang", language});
        ASSERT_EQ(site.bench.dynlab(words).exit_code, 0) << slug;
        std::map<std::string, std::string> files = files_in(site.bench.path(copy)), described;
        std::erase_if(files, [](const auto& file) { return file.first.starts_with('.'); });
        for (const json& file : lesson["files"]) {
            const std::string copied = copy + "+" + file["name"].get<std::string>();
            site.bench.write(copied, file.value("base64", ""));
            described[file["name"]] = file.contains("text") ? file["text"].get<std::string>()
                                                            : site.bench.shell("base64 -d " + copied).output;
        }
        EXPECT_EQ(described.size(), files.size()) << name;
        for (const auto& [file, text] : files) EXPECT_TRUE(described[file] == text) << name << ": " << file;
        for (const auto& [file, text] : lesson["checks"].items()) EXPECT_EQ(text, read_file(kLessons / slug / file));
        EXPECT_TRUE(lesson["checks"].contains("checks.lua")) << name;
        // The page shows each code cell of that script as it is.
        const std::string& page = site.pages.at((fs::path(name).parent_path() / "index.html").generic_string());
        std::vector<std::string> lines;
        std::istringstream script(files.at("analysis.lua"));
        for (std::string line; std::getline(script, line);) lines.push_back(line);
        const std::vector<std::string> first = attributes(page, "data-first"), last = attributes(page, "data-last");
        std::size_t cells = 0;
        for (const std::string& line : lines) cells += line.starts_with("-- %%");
        EXPECT_GE(first.size(), cells) << name;
        for (std::size_t at = 0; (at = page.find("<section class=\"cell\"", at)) != std::string::npos; ++at) {
            const std::string cell = page.substr(at, page.find("</pre>", at) - at);
            const int begin = std::stoi(attributes(cell, "data-first")[0]),
                      end = std::stoi(attributes(cell, "data-last")[0]);
            std::string code;
            for (int line = begin; line <= end; ++line) code += lines[static_cast<std::size_t>(line) - 1] + "\n";
            const std::size_t pre = cell.find("<pre class=\"code\"");
            EXPECT_EQ(readable_letters(cell.substr(cell.find('>', pre) + 1)), letters_of(code)) << name;
            ++compared;
        }
    }
    EXPECT_GT(compared, 100u);
}

TEST(site, contains_no_line_of_a_solution) {
    const MadeSite& site = made_site();
    ASSERT_EQ(site.made.exit_code, 0) << site.made.error_output;
    std::string all;
    for (const auto& [name, content] : site.files) all += readable_letters(content) + " ";
    // Lines that readers of any lesson, check, hint, demonstration or help page get anyhow.
    std::string open;
    std::map<std::string, LessonLines> lessons;
    for (const auto& entry : fs::recursive_directory_iterator(kLessons)) {
        const std::string file = entry.path().filename();
        if (file == "lesson.lua") {
            LessonLines& lines = lessons[entry.path().parent_path().filename()];
            lines = lines_of_lesson(read_file(entry.path()));
            open += lines.open;
        }
        if (entry.path().parent_path().filename() == "demos" || file == "checks.lua" || file == "hints.md")
            open += letters_of(read_file(entry.path()));
    }
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "engine/scripting/reference"))
        if (entry.is_regular_file()) open += letters_of(read_file(entry.path()));
    // The workbench also writes scripts.
    for (const auto& entry : fs::directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / "engine/app/workbench"))
        open += letters_of(read_file(entry.path()));
    std::size_t searched = 0;
    for (const auto& [name, lines] : lessons)
        for (const std::string& line : lines.solution) {
            if (line.size() < 20 || open.find(line) != std::string::npos) continue;
            EXPECT_EQ(all.find(line), std::string::npos) << name << ": " << line;
            ++searched;
        }
    EXPECT_GT(searched, 300u);
    // Questions after talks and model answers are for instructors.
    for (const auto& [name, lines] : lessons)
        for (const char* file : {"talk.md", "report.en.md", "report.fr.md"}) {
            if (!fs::exists(kLessons / name / file)) continue;
            std::istringstream stream(read_file(kLessons / name / file));
            for (std::string line; std::getline(stream, line);) {
                const std::string words = letters_of(line);
                if (words.size() <= 50 || open.find(words) != std::string::npos) continue;
                EXPECT_EQ(all.find(words), std::string::npos) << name << "/" << file << ": " << line;
            }
        }
}

// The oracle is the text of the page as Chromium prints it without scripts, and what `dynlab run` prints.
TEST(site, lessons_can_be_read_without_scripts) {
    const MadeSite& site = made_site();
    ASSERT_EQ(site.made.exit_code, 0) << site.made.error_output;
    Browser browser;
    browser.devtools("Emulation.setScriptExecutionDisabled", "{\"value\": true}");
    browser.open("file://" + (site.folder / "lessons/02/index.html").string());
    const json printed = json::parse(browser.devtools("Page.printToPDF", "{}"));
    site.bench.write("page.base64", printed["data"]);
    const std::string text =
        letters_of(site.bench.shell("base64 -d page.base64 > page.pdf; pdftotext -layout page.pdf -").output);
    browser.devtools("Emulation.setScriptExecutionDisabled", "{\"value\": false}");
    for (const char* words : {"Olympic", "load(\"winning_times\")", "-- YOUR CODE HERE", "Figure 1. Winning times"})
        EXPECT_THAT(text, HasSubstr(letters_of(words)));
    ASSERT_EQ(site.bench.dynlab({"new", "02", "to-run"}).exit_code, 0);
    std::istringstream lines(site.bench.dynlab({"run", "to-run/analysis.lua"}).output);
    std::size_t shown = 0, all = 0;
    for (std::string line; std::getline(lines, line);) {
        const std::string words = letters_of(line);
        if (words.size() < 12 || line.find("analysis_out") != std::string::npos) continue;
        ++all;
        shown += text.find(words) != std::string::npos;
    }
    EXPECT_GT(all, 3u);
    EXPECT_EQ(shown, all);
}

}  // namespace test_site
}  // namespace dynlab::test
