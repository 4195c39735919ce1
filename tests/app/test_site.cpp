// The pages of a site: made once by the program, then read as files, by tidy and in a browser. Oracles: help pages, the
// catalog of methods, HTML's rules (tidy), runs of the examples by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "app/made_site.h"
#include "numerics/estimators/method_catalog.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "support/browser.h"
#include "support/program.h"
#include "workflow/site/search_index.h"
#include "workflow/site/site_folder.h"
#include "workflow/site/site_page.h"
#include "workflow/site/table_columns.h"

namespace dynlab::test {
namespace test_site {
using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const fs::path kSource = DYNLAB_SOURCE_DIR;

/// Without what is between `begin` and `end`; pages are too long for regular expressions.
std::string without(const std::string& html, const std::string& begin, const std::string& end) {
    std::string rest;
    std::size_t at = 0;
    for (std::size_t open; (open = html.find(begin, at)) != std::string::npos; at = html.find(end, open) + end.size())
        rest.append(html, at, open - at);
    return rest.append(html, at);
}

/// Letters and digits alone, so that marks of Markdown and HTML make no difference.
std::string bare(const std::string& text) {
    std::string letters;
    for (const char c : text)
        if (std::isalnum(static_cast<unsigned char>(c))) letters += c;
    return letters;
}

std::string bare_text_of(std::string html) {
    html = without(html, "<script type=\"application/json\"", "</script>");
    std::string text;
    bool within = false;
    for (const char c : html) {
        if (c == '<') within = true;
        if (!within) text += c;
        if (c == '>') within = false;
    }
    for (const char* entity : {"&lt;", "&gt;", "&quot;", "&amp;"})
        text = std::regex_replace(text, std::regex(entity), " ");
    return bare(text);
}

/// tidy does not know foreignObject, in which SVG holds HTML and formulas.
void check_validity(const Workbench& bench, const std::map<std::string, std::string>& pages) {
    for (const auto& [file, html] : pages)
        bench.write("tidy/" + std::regex_replace(file, std::regex("/"), "+"),
                    without(html, "<foreignObject", "</foreignObject>"));
    // Nor does it know the attribute by which pictures come when they are seen, and forms that close a dialog.
    EXPECT_EQ(bench
                  .shell("cd tidy && for f in *.html; do tidy -e -q \"$f\" 2>&1 | sed \"s/^/$f: /\"; done | grep -v "
                         "-e '<img> proprietary attribute \"loading\"' -e '<form> attribute \"method\" has invalid "
                         "value \"dialog\"'")
                  .output,
              "");
}

/// Captions are typeset.
std::string without_captions(std::string html) {
    constexpr std::string_view kEnd = "</figcaption>";
    for (std::size_t at; (at = html.find("<figcaption>")) != std::string::npos;) {
        const std::size_t end = html.find(kEnd, at);
        if (end == std::string::npos) break;
        html.erase(at, end + kEnd.size() - at);
    }
    return html;
}

// Help pages are read in terminals, too: a power is written x^2. Two of them in a line would be Pandoc's raised text.
void check_powers_stay(const std::map<std::string, std::string>& pages) {
    for (const auto& [file, page] : pages) {
        if (!file.starts_with("functions/") || file == "functions/index.html") continue;
        const std::string html = without_captions(page);
        EXPECT_THAT(html, testing::AllOf(Not(HasSubstr("<sup>")), Not(HasSubstr("<sub>")))) << file;
    }
}

/// The text of the only <pre class="output"> of a page.
std::string output_on(const std::string& html) {
    const std::string begin = "<pre class=\"output\"><code>";
    const std::size_t at = html.find(begin);
    return at == std::string::npos ? "" : html.substr(at + begin.size(), html.find("</code>", at) - at - begin.size());
}

void check_examples(const Workbench& bench, const std::map<std::string, std::string>& pages) {
    int shown = 0;
    for (const auto& entry : fs::directory_iterator(kSource / "engine/scripting/reference")) {
        if (entry.path().extension() != ".md") continue;
        const std::string name = entry.path().stem().string() + ".html";  // of a function or of a topic
        const auto page = pages.find((pages.contains("guides/" + name) ? "guides/" : "functions/") + name);
        ASSERT_NE(page, pages.end()) << entry.path();
        shown += page->second.find("<pre class=\"output\">") != std::string::npos ||
                 page->second.find("<figure") != std::string::npos;
    }
    EXPECT_GT(shown, 155);
    for (const auto& entry : fs::directory_iterator(kSource / "engine/scripting/reference/guides")) {
        const std::string name = entry.path().stem();
        EXPECT_TRUE(pages.count("guides/" + name + ".html")) << name;
    }
    const std::string page = read_file(kSource / "engine/scripting/reference/load.md");
    const std::size_t code = page.find("```lua\n") + 7;
    bench.write("example.lua", page.substr(code, page.find("\n```", code) - code) + "\n");
    const std::string printed = bench.dynlab({"run", "example.lua"}).output;
    EXPECT_THAT(printed, HasSubstr("1896"));
    EXPECT_EQ(bare(output_on(pages.at("functions/load.html"))), bare(printed));
    for (const MethodEntry& method : method_catalog())
        EXPECT_THAT(bare_text_of(pages.at("guides/methods.html")), HasSubstr(bare(method.reference))) << method.file;
    EXPECT_THAT(bare_text_of(pages.at("guides/methods.html")), HasSubstr(bare("taught in: 06_physics")));
    EXPECT_GT(attributes(pages.at("gallery/index.html"), "src").size(), 60u);
    for (const auto& [file, html] : pages)
        if (file.starts_with("functions/") && html.find("<figure") != std::string::npos) {
            EXPECT_THAT(pages.at("gallery/index.html"), HasSubstr("href=\"../" + file)) << "its figures";
        }
    // Formulas in captions stay formulas.
    EXPECT_THAT(pages.at("gallery/index.html"), HasSubstr("<math"));
    const std::string& contents = pages.at("index.html");
    EXPECT_LT(contents.find("lessons/03_workflow/"), contents.find("lessons/03_crane/"));
}

class Reader {
  public:
    explicit Reader(const fs::path& site) : site_(site) {}
    Browser& open(const std::string& file) {
        browser_.open("file://" + (site_ / file).string());
        return browser_;
    }
    json value(const std::string& expression) { return json::parse(browser_.evaluate("return " + expression)); }
    void begin_search() {
        browser_.evaluate("window.dynlabLoadSearch().then(() => { window.ready = true })");
        EXPECT_TRUE(browser_.becomes_true("window.ready"));
    }
    /// Files that the search gives, best first.
    std::vector<std::string> found(const std::string& words) {
        return value("dynlabSearch(" + json(words).dump() + ").map(found => found.href)");
    }
    Browser& browser() { return browser_; }

  private:
    fs::path site_;
    Browser browser_;
};

void check_search(Reader& reader) {
    reader.open("index.html");
    reader.begin_search();
    EXPECT_EQ(reader.found("srivc").at(0), "functions/srivc.html");
    EXPECT_EQ(reader.found("tfsr").at(0), "functions/tfsrivc.html");
    EXPECT_EQ(reader.found("report.value").at(0), "functions/report.value.html");
    EXPECT_EQ(reader.found("Peer REVIEW").at(0), "guides/guide-peer-review.html");
    EXPECT_THAT(reader.found("olympic games"), Contains(HasSubstr("lessons/02/index.html")));
    EXPECT_THAT(reader.found("trolley crane").at(0), HasSubstr("lessons/03_crane/index.html"));
    EXPECT_THAT(reader.found("isolation sandbox"), Contains(HasSubstr("guides/guide-instructor.html")));
    EXPECT_THAT(reader.found("zzyzx"), testing::IsEmpty());
    EXPECT_THAT(reader.found("..."), testing::IsEmpty());
    // By keyboard and mouse: the key that leads to the field, the list, the way to the page.
    reader.browser().evaluate(
        "document.dispatchEvent(new KeyboardEvent('keydown', {key: '/', bubbles: true}));"
        "const field = document.getElementById('search'); window.there = document.activeElement === field;"
        "field.value = 'bode'; field.dispatchEvent(new Event('input'))");
    EXPECT_EQ(reader.value("window.there"), true);
    ASSERT_TRUE(reader.browser().becomes_true("document.querySelectorAll('#found a').length > 2"));
    EXPECT_THAT(reader.value("document.querySelector('#found a').innerText").get<std::string>(), HasSubstr("Function"));
    reader.browser().evaluate("document.getElementById('search').form.requestSubmit()");
    EXPECT_TRUE(reader.browser().becomes_true("location.href.endsWith('functions/bode.html')"));
}

void check_pages_in_browser(Reader& reader) {
    // Figures are alive, from files and under the page's own policy.
    reader.browser().evaluate("document.querySelector('script.plot-data').previousElementSibling.scrollIntoView()");
    EXPECT_TRUE(reader.browser().becomes_true("document.querySelectorAll('.plot canvas').length > 0"));
    EXPECT_EQ(reader.value("document.querySelectorAll('nav.site .theme').length"), 1);
    reader.browser().click("nav.site .theme");
    EXPECT_NE(reader.value("getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)");
    reader.browser().click("nav.site .theme");
    for (const char* file : {"index.html", "functions/index.html", "guides/methods.html", "gallery/index.html",
                             "lessons/04/index.html", "fr/index.html", "fr/lessons/06/index.html",
                             "demonstrations/delays.html", "guides/guide-commands.html", "functions/srivc.html"}) {
        for (const int width : {400, 800, 1280}) {
            reader.browser().devtools("Emulation.setDeviceMetricsOverride",
                                      fmt::format("{{\"width\": {}, \"height\": 900, \"deviceScaleFactor\": 1, "
                                                  "\"mobile\": false}}",
                                                  width));
            reader.open(file);
            EXPECT_LE(reader.value("document.documentElement.scrollWidth").get<int>(), width) << file;
        }
        EXPECT_EQ(reader.value("document.querySelectorAll('main h1, header h1').length >= 1"), true) << file;
    }
}

TEST(site, pages_are_valid_and_found_by_words) {
    const MadeSite& site = made_site();
    ASSERT_EQ(site.made.exit_code, 0) << site.made.error_output;
    EXPECT_THAT(site.made.output, HasSubstr(site.bench.path("site/index.html").string()));
    EXPECT_GT(site.pages.size(), 190u);
    check_validity(site.bench, site.pages);
    check_powers_stay(site.pages);
    check_examples(site.bench, site.pages);
    Reader reader(site.folder);
    check_search(reader);
    check_pages_in_browser(reader);
}

TEST(site, refuses_wrong_folders_at_once) {
    const Workbench bench;
    bench.write("thesis/chapter.tex", "years of work");
    bench.write("file", "text");
    for (const char* folder : {"thesis", "file"}) {
        const ChildResult refused = bench.dynlab({"site", folder});
        EXPECT_EQ(refused.exit_code, 1);
        EXPECT_THAT(refused.error_output, AllOf(HasSubstr(std::string(folder) + " was not changed, because "),
                                                HasSubstr("; give a new or an empty folder")));
    }
    EXPECT_EQ(bench.read("thesis/chapter.tex"), "years of work");
    const ChildResult lacks = bench.dynlab({"site", "new", "--engine", "thesis"});
    EXPECT_EQ(lacks.exit_code, 1);
    EXPECT_THAT(lacks.error_output, HasSubstr("thesis has no dynlab.js"));
    EXPECT_FALSE(fs::exists(bench.path("new")));
    EXPECT_EQ(bench.dynlab({"site"}).exit_code, 2);
    const ChildResult old_name = bench.dynlab({"manual", "thesis"});
    EXPECT_EQ(old_name.exit_code, 1);
    EXPECT_THAT(old_name.error_output, HasSubstr("dynlab manual is now dynlab site"));
}

TEST(site, replaces_its_own_files_alone) {
    const TemporaryFolder folder;
    const fs::path site = folder.path() / "site";
    fs::create_directories(site / "pictures");  // as a run leaves it that was killed before it wrote a file
    write_site_folder(site, {{"index.html", "one"}, {"old.html", "old"}, {"pictures/a.svg", "picture"}});
    write_file_atomically(site / "notes.txt", "mine");
    write_site_folder(site, {{"index.html", "two"}, {"new.html", "new"}});
    EXPECT_EQ(read_file(site / "index.html"), "two");
    EXPECT_FALSE(fs::exists(site / "old.html"));
    EXPECT_EQ(read_file(site / "notes.txt"), "mine");
    // The site command preserves files that the user changed or added.
    EXPECT_THROW(write_site_folder(site, {{"index.html", "three"}, {"notes.txt", "manual's"}}), EnvironmentError);
    EXPECT_EQ(read_file(site / "index.html"), "two");
    write_file_atomically(site / "index.html", "with my remarks");
    EXPECT_THROW(write_site_folder(site, {{"index.html", "three"}}), EnvironmentError);
    EXPECT_EQ(read_file(site / "index.html"), "with my remarks");
    // A list that leads out of the folder.
    write_file_atomically(folder.path() / "outside.txt", "outside");
    write_file_atomically(site / "site-files.txt", std::string(64, '0') + "  ../outside.txt\n");
    EXPECT_THROW(write_site_folder(site, {{"x.html", "x"}}), EnvironmentError);
    EXPECT_TRUE(fs::exists(folder.path() / "outside.txt"));
}

TEST(site, pages_lead_to_what_their_code_names) {
    const std::map<std::string, std::string> pages = {{"srivc", "functions/srivc.html"}, {"lua", "guides/lua.html"}};
    SitePage page;
    page.file = "lessons/02/index.html";
    const auto linked = [&](const std::string& html) {
        page.body = html;
        return with_links_to_pages(page, pages);
    };
    EXPECT_EQ(linked("<p><code>srivc(data)</code></p>"),
              "<p><a href=\"../../functions/srivc.html\"><code>srivc(data)</code></a></p>");
    EXPECT_EQ(linked("<code>dynlab help lua</code>"),
              "<a href=\"../../guides/lua.html\"><code>dynlab help lua</code></a>");
    for (const char* same : {"<pre><code>srivc</code></pre>", "<code>srivcs</code>", "<code>y = srivc</code>",
                             "<div class=\"choice\"><code>srivc</code></div>"})
        EXPECT_EQ(linked(same), same);
    page.file = "guides/lua.html";
    EXPECT_EQ(linked("<code>lua</code>"), "<code>lua</code>");
}

// Oracle: 90 characters a line, shared by hand.
TEST(site, columns_of_wide_tables_are_as_wide_as_their_content) {
    const std::string words(60, 'w'), more(120, 'm');
    const auto rule = [](const std::string& table) {
        return table.substr(table.find("\n|-"), table.rfind("\n| ") - table.find("\n|-"));
    };
    const auto dashes = [](int a, int b, int c) {
        return "\n|" + std::string(a + 2, '-') + "|" + std::string(b + 2, '-') + "|" + std::string(c + 2, '-') + "|";
    };
    // 10 and 20 characters fit, 60 are left for the third.
    const std::string table =
        "| route | wants | done |\n|---|---|---|\n| `" + std::string(10, 'r') + "` | " + std::string(20, 'x') + " | ";
    EXPECT_EQ(rule(with_fitted_columns(table + more + " |\n")), dashes(10, 20, 60));
    // 60 and 120 characters for the 80 that are left: one third and two.
    EXPECT_EQ(
        rule(with_fitted_columns("| a | b | c |\n|---|---|---|\n| 1234567890 | " + words + " | " + more + " |\n")),
        dashes(10, 27, 53));
    EXPECT_EQ(
        with_fitted_columns("| a | b |\n|:--|--:|\n| \\| `|` | " + more + " |\n"),
        "| a | b |\n|:" + std::string(4, '-') + "-|-" + std::string(86, '-') + ":|\n| \\| `|` | " + more + " |\n");
    for (const std::string& as_it_is :
         {std::string("| a | b |\n|---|---|\n| 1 | 2 |\n"), "```\n" + table + more + " |\n```\n"})
        EXPECT_EQ(with_fitted_columns(as_it_is), as_it_is);
}

TEST(site, words_are_what_readers_type) {
    EXPECT_THAT(words_in_text("The “Bode” plot – bode_values(G), R², 3.5\u00a0rad/s, Broïda"),
                ElementsAre("3", "5", "bode", "broïda", "g", "plot", "rad", "r²", "s", "the", "values"));
    EXPECT_EQ(text_in_html("<p>a&lt;b</p><script>x</script><span class=\"k\">c</span>d"), " a<b  cd");
    EXPECT_EQ(text_in_html("to <math><mi>K</mi></math>, <em>then</em><br>on"), "to K, then on");
}

}  // namespace test_site
}  // namespace dynlab::test
