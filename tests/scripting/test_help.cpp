// What help answers. Oracles: the outputs written by hand behind the guide's lines, the widths asked for, the names of
// the toolboxes' documentation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>

#include "numerics/error.h"
#include "platform/atomic_file.h"
#include "platform/utf8.h"
#include "script_run.h"
#include "scripting/interpreter/catalog.h"
#include "scripting/runtime/help.h"
#include "scripting/runtime/help_layout.h"

namespace test_help {

using namespace dynlab;
using dynlab::test::printed;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<const FunctionEntry*> functions() {
    std::vector<const FunctionEntry*> all;
    for (const FunctionEntry& entry : catalog_of_functions()) all.push_back(&entry);
    return all;
}

std::vector<std::string> code_blocks(const std::string& page) {
    std::vector<std::string> blocks;
    constexpr std::string_view kBegin = "```lua\n";
    for (auto at = page.find(kBegin); at != std::string::npos; at = page.find(kBegin, at + 1)) {
        const auto begin = at + kBegin.size();
        blocks.push_back(page.substr(begin, page.find("```", begin) - begin));
    }
    return blocks;
}

TEST(help, guide_to_lua_prints_what_it_says) {
    const std::vector<std::string> blocks = code_blocks(std::string(find_help_page("lua")->text));
    EXPECT_GE(blocks.size(), 8u);
    for (const std::string& block : blocks) {
        std::string expected, line;
        for (std::istringstream lines(block); std::getline(lines, line);)
            if (const auto at = line.find("--> "); at != std::string::npos) expected += line.substr(at + 4) + '\n';
        EXPECT_EQ(printed(block), expected) << block;
        EXPECT_FALSE(expected.empty()) << block;
    }
}

TEST(help, guides_to_reports_and_from_other_programs_run) {
    for (const char* guide : {"guide-report", "guide-lab-report", "guide-contsid"})
        for (const std::string& block : code_blocks(std::string(find_help_page(guide)->text)))
            EXPECT_THAT(printed(block), Not(HasSubstr("ERROR"))) << guide << '\n' << block;
}

/// Every line of the table from CONTSID is a line of the script below it, which is run.
TEST(help, guide_from_contsid_runs_what_its_table_says) {
    const std::string guide(find_help_page("guide-contsid")->text);
    const std::string code = code_blocks(guide).at(0);
    static const std::regex row("\n\\| `[^|]*` \\| `([^`]*)` \\|");
    int rows = 0;
    for (std::sregex_iterator it(guide.begin(), guide.end(), row), end; it != end; ++it, ++rows)
        EXPECT_THAT("\n" + code + "\n", HasSubstr("\n" + (*it)[1].str() + "\n"));
    EXPECT_EQ(rows, 16);
}

TEST(help, guide_to_notebooks_shows_what_it_says) {
    const std::vector<std::string> blocks = code_blocks(std::string(find_help_page("guide-notebook")->text));
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_THAT(printed(blocks[0]), HasSubstr("4.66"));  // (1 + 4 + 9)/3
}

TEST(help, fits_the_width_and_shows_no_marks) {
    const auto all = functions();
    for (const HelpPage& page : help_pages()) {
        for (const std::size_t width : {60u, 80u, 100u}) {
            const std::string text = help_text(std::string(page.name), all, width);
            bool code = false;
            std::string line;
            for (std::istringstream lines(text); std::getline(lines, line);) {
                code = line.starts_with("    ");  // stays as it is, as do words that are longer than a line
                if (code) continue;
                const bool one_word = line.find(' ', line.find_first_not_of("- ")) == std::string::npos;
                if (page.text.find("\n|") == std::string_view::npos) {  // a table keeps its columns
                    EXPECT_TRUE(columns_of(line) <= width || one_word) << page.name << ", " << width << ": " << line;
                }
                EXPECT_THAT(line, AllOf(Not(StartsWith("# ")), Not(StartsWith("## ")))) << page.name;
                EXPECT_THAT(line, Not(HasSubstr("**"))) << page.name;
                EXPECT_THAT(line, Not(StartsWith("|"))) << page.name;
            }
            EXPECT_THAT(text, Not(HasSubstr("```lua"))) << page.name;
        }
    }
    std::string line;
    for (std::istringstream lines(help_overview(all, 70)); std::getline(lines, line);)
        EXPECT_TRUE(columns_of(line) <= 70 || line.find("help(") != std::string::npos) << line;
}

TEST(help, lays_out_the_forms_of_a_page) {
    EXPECT_EQ(
        laid_out("# name\n\nSome `code` and *words* that\nare 2*3 long.\n\n## Part\n\n- `a`: first\n  goes on\n- b\n",
                 20),
        "name\n====\n\nSome code and words\nthat are 2*3 long.\n\nPart\n----\n\n- a: first goes on\n- b\n");
    EXPECT_EQ(
        laid_out("| x | y |\n|---|---|\n| `a \\|\\| b` | 1 |\n| c | two |\n\n```lua\nlocal x = `y`\n\n  z\n```\n", 40),
        "x       y\n------  ---\na || b  1\nc       two\n\n    local x = `y`\n\n      z\n");
    EXPECT_EQ(laid_out("| a | b |\n|---|---|\n| one | a text of many words |\n", 20),
              "a    b\n---  ---------------\none  a text of many\n     words\n");
    EXPECT_EQ(laid_out("List:\n\n* **One** is\n  a mark\n* two\nlazy\n\nEnd\n", 20),
              "List:\n\n- One is a mark\n- two lazy\n\nEnd\n");
    EXPECT_EQ(laid_out("So:\n\n> **A** – 0 of 3\\\n> B is biased by the noise.\\\n> *Why?*\n\nEnd\n", 24),
              "So:\n\n    A – 0 of 3\n    B is biased by the\n    noise.\n    Why?\n\nEnd\n");
    EXPECT_EQ(laid_out("> one\ntwo\n>\n> three\n", 40), "    one two\n\n    three\n");
    EXPECT_EQ(filled("one two three", 7, 2), "one\n  two\n  three");
}

TEST(help, guides_and_subjects_begin_with_their_summary) {
    const auto all = functions();
    EXPECT_THAT(help_text("checks", all),
                StartsWith("checks\n======\n\nHow the check file of a lesson grades answers.\n\nThe check file"));
    EXPECT_THAT(help_text("guide-first-hour", all), HasSubstr("\n\nThe first hour.\n\n"));
    for (const HelpPage& page : help_pages())
        EXPECT_THAT(help_text(std::string(page.name), all),
                    AllOf(Not(HasSubstr("\nsubject: ")), Not(HasSubstr("\nguide: "))))
            << page.name;
}

TEST(help, numbered_items_and_formulas_keep_their_lines) {
    EXPECT_EQ(laid_out("Steps:\n\n1. Make a folder\n   first.\n2. Write.\n\n10. Read all of it.\n\nEnd\n", 14),
              "Steps:\n\n1. Make a\n   folder\n   first.\n2. Write.\n\n10. Read\n    all of it.\n\nEnd\n");
    EXPECT_EQ(laid_out("A sentence of lesson\n2. It goes on.\n", 40), "A sentence of lesson 2. It goes on.\n");
    EXPECT_EQ(laid_out("Then\n\n    d = a * b        percent\n    mark = `d`\n\nEnd\n", 20),
              "Then\n\n    d = a * b        percent\n    mark = `d`\n\nEnd\n");
}

TEST(help, leads_on_from_toolboxes_methods_and_lua) {
    const auto all = functions();
    EXPECT_THAT(help_text("tfest", all),
                AllOf(HasSubstr("tfest is a name of another program: use tfsrivc"), HasSubstr("\n  tfsrivc  ")));
    EXPECT_THAT(help_text("CARX", all), AllOf(HasSubstr("\n  lssvf  "), HasSubstr("\n  ivsvf  ")));
    EXPECT_THAT(help_text("CBJ", all), HasSubstr("\n  rivc  "));
    EXPECT_EQ(help_text("COE", all), help_text("coe", all));
    EXPECT_THAT(help_text("legend", all), HasSubstr("name the curves: plot(x1"));
    for (const char* name : {"procest", "ssest", "polyest", "idpoly", "disp", "fprintf", "roots"})
        EXPECT_THAT(help_text(name, all), HasSubstr("is a name of another program: ")) << name;
    EXPECT_THAT(help_text("iddata.split", all),
                StartsWith("data:split(0.6): two data objects, the first 60 % of the samples (rounded to an\n"));
    EXPECT_THAT(help_text("data:shift", all), StartsWith("data:shift(n): input delayed by n samples"));
    EXPECT_THAT(help_text("fig.add", all), StartsWith("fig:add(x, y, {label =, style =, ...}): adds a curve\n"));
    EXPECT_THAT(help_text("pairs", all), AllOf(HasSubstr("is part of Lua"), HasSubstr("Tables\n------")));
    EXPECT_THAT(help_text("pcall", all), HasSubstr("local ok, message = pcall("));
    EXPECT_THAT(help_text("string.format", all), HasSubstr("%.1f"));
    EXPECT_THAT(help_text("for", all), HasSubstr("for k = 1, 3 do"));
    EXPECT_THAT(help_text("math", all), HasSubstr("is part of Lua"));
}

TEST(help, finds_pages_by_words) {
    const auto all = functions();
    EXPECT_THAT(help_search("logo", all), HasSubstr("guide-own-course"));
    const std::string delay = help_search("delay", all);
    EXPECT_LT(delay.find("delayest"), delay.find("tfsrivc"));  // names come before pages
    for (const char* word : {"report", "cells", "noise", "csv", "color", "Young"})
        EXPECT_THAT(help_text(word, all), AllOf(HasSubstr("These pages contain it:\n\n  "), HasSubstr("help NAME")))
            << word;
    EXPECT_THAT(help_text("cells", all), HasSubstr("guide-report"));
    EXPECT_THAT(help_text("color", all), HasSubstr("\n  plot  "));
    for (const char* words : {"prediction interval", "interval prediction"})
        EXPECT_THAT(help_text(words, all), AllOf(HasSubstr("\n  forecast  "), HasSubstr("\n  measures  "))) << words;
    EXPECT_THROW(help_search("delay zzzz", all), InvalidArgument);
    EXPECT_THROW(help_search("zzzz", all), InvalidArgument);
    EXPECT_THROW(help_search("", all), InvalidArgument);
    EXPECT_THROW(help_text("", all), InvalidArgument);
}

// oracle: what the terms mean in textbooks and in MATLAB
TEST(help, finds_functions_by_terms_of_other_programs) {
    const auto all = functions();
    for (const auto& [term, name] :
         std::initializer_list<std::pair<const char*, const char*>>{{"pole-zero map", "pzmap"},
                                                                    {"Pole zero map", "pzmap"},
                                                                    {"dead time", "delayest"},
                                                                    {"transport delay", "delayest"},
                                                                    {"PID", "simloop"},
                                                                    {"root locus", "pole"},
                                                                    {"spike", "filloutliers"},
                                                                    {"psd", "spa"},
                                                                    {"ode", "greyest"},
                                                                    {"overfitting", "crossvalidate"},
                                                                    {"curve fitting", "polyfit"},
                                                                    {"moving average", "idfilt"},
                                                                    {"plot two curves", "plot"},
                                                                    {"procest", "procsrivc"},
                                                                    {"idtf", "tf"},
                                                                    {"variant", "plant"},
                                                                    {"simulated plant", "plant"}})
        EXPECT_THAT(help_search(term, all), HasSubstr("  " + std::string(name) + " ")) << term;
}

/// The names in calls of help, and in commands `dynlab help NAME`, that a text advises.
std::vector<std::string> advised_in(const std::string& text) {
    static const std::regex call(R"re(help\(\\?"([^"\\]+)\\?"\))re"),
        command(R"(dynlab help ([a-z][a-z_0-9-]*(?:\.[a-z]\w*)?))");
    std::vector<std::string> names;
    for (const std::regex& advice : {call, command})
        for (std::sregex_iterator found(text.begin(), text.end(), advice), end; found != end; ++found)
            names.push_back((*found)[1].str());
    return names;
}

TEST(help, is_there_for_every_object_that_has_no_elements) {
    const std::string objects = R"(rng(1)
local u = prbs(6, 4)
local d = iddata(lsim(tf({1}, {1, 1}), u, 0.1) + 0.01*randn(#u), u, 0.1)
local m = idgrey(function(t, x, u, p) return {-p.k*x[1] + u[1]} end, {k = 1}, {states = 1})
local lssvf_of = function(d) return lssvf(d, {1, 1, 0}, 1) end
for _, object in ipairs{tf({1}, {1, 1}), pole(tf({1}, {1, 1}))[1], m, greyest(d, m), idproc("P1"),
    ss({{-1}}, {{1}}, {{1}}, {{0}}), lsq(matrix{{1}, {2}}, {1, 2}), idfrd(freqresp(tf({1}, {1, 1}), {1, 2}), {1, 2}),
    plot(u, u), narx(d, {1, 1, 1}), arxstruc(d, {na = {1, 1}, nb = {1, 1}, nk = {1, 1}}),
    srivcstruc(d, {poles = {1, 1}, zeros = {0, 0}}),
    montecarlo{system = tf({1}, {1, 1}), input = u, Ts = 0.1, sigma = 0.1, runs = 3, estimators = {a = lssvf_of}}} do
    print(select(2, pcall(function() return object[1] end)))
end
)";
    const std::string said = printed(objects);
    const std::vector<std::string> names = advised_in(said);
    EXPECT_EQ(names.size(), 13u) << said;
    for (const std::string& name : names) EXPECT_TRUE(find_help_page(name)) << name;
}

TEST(help, is_there_wherever_sources_advise_it) {
    int count = 0;
    const std::filesystem::path engine = std::filesystem::path(DYNLAB_SOURCE_DIR) / "engine";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(engine)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".cpp" && extension != ".md" && extension != ".js") continue;
        for (const std::string& name : advised_in(read_text(entry.path()))) {
            if (name == "{}" || name == "delay") continue;  // put together; a word that pages speak of
            ++count;
            EXPECT_TRUE(find_help_page(name)) << name << " in " << entry.path();
        }
    }
    EXPECT_GT(count, 5);
}

}  // namespace test_help
