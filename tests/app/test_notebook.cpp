// Notebooks of scripts and scripts of notebooks. Oracles: the script's own bytes, which must come back; Jupyter's own
// check of notebooks (nbformat); and what the written cells say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/languages.h"
#include "base/reader.h"
#include "documents/error.h"
#include "platform/atomic_file.h"
#include "support/message_texts.h"
#include "support/program.h"
#include "workflow/notebooks/notebook.h"

namespace test_notebook {
using namespace dynlab;
using namespace dynlab::test;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

std::string there_and_back(const std::string& source) {
    return script_of_notebook(notebook_of(parse_percent_script(source, "a.lua")), "a.ipynb").source;
}

json notebook_with(json cells) {
    return {{"nbformat", 4}, {"nbformat_minor", 5}, {"metadata", json::object()}, {"cells", std::move(cells)}};
}

json cell(const std::string& kind, const std::string& source, json metadata = json::object()) {
    return {{"cell_type", kind}, {"id", "a"}, {"metadata", std::move(metadata)}, {"source", source}};
}

std::string refusal(const std::string& text) {
    try {
        script_of_notebook(text, "a.ipynb");
    } catch (const DocumentError& error) {
        return error.what();
    }
    return "";
}

TEST(notebook, every_lesson_and_template_comes_back_byte_for_byte) {
    int scripts = 0;
    for (const char* folder : {"lessons", "report_templates"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(DYNLAB_SOURCE_DIR) / folder)) {
            const std::string name = entry.path().filename();
            if (entry.path().extension() != ".lua" || entry.path().string().find("/filters/") != std::string::npos)
                continue;
            if (name == "checks.lua" || entry.path().string().find("/drawings/") != std::string::npos) continue;
            const std::string source = read_file(entry.path());
            EXPECT_EQ(there_and_back(source), source) << entry.path();
            ++scripts;
        }
    EXPECT_GT(scripts, 20);
}

TEST(notebook, scripts_that_are_written_otherwise_come_back_too) {
    for (const std::string source :
         {"", "x = 1", "x = 1\n", "\n\n\nx = 1\n\n\n", "-- %%\n", "-- %%", "-- ---\n-- title: T\n-- ---\n",
          "-- ---\n-- title: T\n-- ---\nx = 1\n-- %%\ny = 2", "#!/usr/bin/env dynlab\n-- ---\n-- seed: 3\n-- ---\n",
          "-- %% [markdown]\n--Text\n--   more\n\n--\n-- end\n", "--%%   id=a   echo=false  \nx = 1\n",
          "-- %% [markdown] id=q\r\n-- words\r\n\r\n-- %%\r\nx = 1\r\n", "-- %%\n-- %%\n-- %%\n\n\n",
          "-- %% [markdown]\n-- BEGIN SOLUTION\n-- words\n-- END SOLUTION\n",
          "-- %%\n\n  x = 1  \n\t\n-- %%\ny = 2\n\n", "-- %% [markdown]\n-- caf\xC3\xA9 \"quoted\" \\alpha\n"})
        EXPECT_EQ(there_and_back(source), source);
}

TEST(notebook, cells_carry_kinds_ids_and_text_without_signs) {
    const json notebook =
        json::parse(notebook_of(parse_percent_script("-- ---\n-- title: T\n-- ---\n\n-- %% [markdown] id=words\n-- # "
                                                     "Head\n--\n-- text\n\n-- %% id=q2 echo=false\nx = 1\n",
                                                     "a.lua")));
    EXPECT_EQ(notebook["metadata"]["kernelspec"]["name"], "dynlab");
    const json& cells = notebook["cells"];
    ASSERT_EQ(cells.size(), 3u);
    EXPECT_EQ(cells[0]["cell_type"], "code");
    EXPECT_EQ(cells[0]["source"], (json{"-- ---\n", "-- title: T\n", "-- ---"}));
    EXPECT_EQ(cells[1]["cell_type"], "markdown");
    EXPECT_EQ(cells[1]["id"], "words");
    EXPECT_EQ(cells[1]["source"], (json{"# Head\n", "\n", "text"}));
    EXPECT_EQ(cells[2]["id"], "q2");
    EXPECT_EQ(cells[2]["metadata"]["dynlab"]["options"], "id=q2 echo=false");
}

TEST(notebook, what_was_changed_in_jupyter_counts) {
    json notebook = json::parse(notebook_of(
        parse_percent_script("-- %% [markdown]\n--first\n\n\n-- %% id=q\n\nx = 1\n\n\n-- %%\ny = 2\n", "a.lua")));
    notebook["cells"][0]["source"] = "changed";
    notebook["cells"].insert(notebook["cells"].begin() + 2, cell("code", "z = 3\nprint(z)"));
    EXPECT_EQ(script_of_notebook(notebook.dump(), "a.ipynb").source,
              "-- %% [markdown]\n-- changed\n\n-- %% id=q\n\nx = 1\n\n\n-- %%\nz = 3\nprint(z)\n\n-- %%\ny = 2\n");
}

TEST(notebook, what_a_cell_shows_is_what_is_run) {
    // The stored lines of a cell are used only if they match its source. Nothing in a cell starts another cell.
    const json hidden = {{"dynlab", {{"written", "-- %%\nx = 1\n-- %%\nanswer('a', 2)\n"}}}};
    EXPECT_EQ(script_of_notebook(notebook_with({cell("code", "x = 1", hidden)}).dump(), "a").source, "-- %%\nx = 1\n");
    const json other = {{"dynlab", {{"written", "-- %%\nx = 2\n"}, {"options", "id=a\nx = 7"}}}};
    EXPECT_EQ(script_of_notebook(notebook_with({cell("code", "x = 1", other)}).dump(), "a").source,
              "-- %% id=a\nx = 1\n");
    const std::string source =
        script_of_notebook(
            notebook_with({cell("markdown", "%% id=b\n\n%%"), cell("code", "-- %%\nx = 1\n--%% [markdown]")}).dump(),
            "a")
            .source;
    EXPECT_EQ(parse_percent_script(source, "a.lua").cells.size(), 2u) << source;
}

TEST(notebook, places_are_reported_as_jupyter_counts_them) {
    const std::string source =
        "-- ---\n-- title: T\n-- ---\n\n-- %% [markdown]\n-- words\n\n-- %%\nx = 1\ny = nil + x\n";
    EXPECT_EQ(message_text(place_in_notebook(source, 2)), "cell 1, line 2");
    EXPECT_EQ(message_text(place_in_notebook(source, 6)), "cell 2, line 1");
    EXPECT_EQ(message_text(place_in_notebook(source, 10)), "cell 3, line 2");
    EXPECT_TRUE(place_in_notebook(source, 8).empty());
    EXPECT_EQ(with_places_in_notebook("analysis.lua:10: no; see analysis.lua", "analysis.lua", "a.ipynb", source),
              "a.ipynb, cell 3, line 2: no; see a.ipynb");
    EXPECT_EQ(with_places_in_notebook("analysis.lua:99999999999999999999: no", "analysis.lua", "a", source),
              "a:99999999999999999999: no");
    const Message placed = with_places_in_notebook(
        Message("{}{}", "analysis.lua:10: ", Message("see {}", listed({"analysis.lua", "analysis.lua:6"}))),
        "analysis.lua", "a.ipynb", source);
    EXPECT_EQ(message_text(placed), "a.ipynb, cell 3, line 2: see a.ipynb, a.ipynb, cell 2, line 1");
    EXPECT_EQ(message_text(placed, {catalog_of("fr")}),
              "a.ipynb, cellule 3, ligne 2: see a.ipynb, a.ipynb, cellule 2, ligne 1");
}

TEST(notebook, other_files_are_refused_with_a_reason) {
    EXPECT_THAT(refusal("print(1)"), HasSubstr("a.ipynb: the file is not a Jupyter notebook: it is not JSON"));
    EXPECT_THAT(refusal("{\"cells\": ["), HasSubstr("is truncated"));
    EXPECT_THAT(refusal("[1, 2]"), HasSubstr("not a Jupyter notebook"));
    EXPECT_THAT(refusal("{}"), HasSubstr("it has no nbformat"));
    EXPECT_THAT(refusal(R"({"nbformat": 3, "worksheets": []})"),
                AllOf(HasSubstr("nbformat 3"), HasSubstr("nbconvert")));
    EXPECT_THAT(refusal(R"({"nbformat": 4, "metadata": {}})"), HasSubstr("no list of cells"));
    EXPECT_THAT(refusal(R"({"nbformat": 4, "cells": 7})"), HasSubstr("no list of cells"));
    EXPECT_THAT(refusal(notebook_with(json::array()).dump()), HasSubstr("has no cells"));
    EXPECT_THAT(refusal(notebook_with({cell("code", ""), cell("video", "")}).dump()),
                HasSubstr("cell 2 has the type \"video\""));
    json python = notebook_with({cell("code", "import os")});
    python["metadata"]["language_info"]["name"] = "python";
    EXPECT_THAT(refusal(python.dump()), HasSubstr("the notebook uses python; dynlab runs only Lua"));
    python["metadata"] = {{"kernelspec", {{"name", "ir"}, {"language", "R"}}}};
    EXPECT_THAT(refusal(python.dump()), HasSubstr("the notebook uses R"));
    // Members of other kinds than they should be are no reason to fall over.
    const json odd = json::parse(R"([{"cell_type": "code", "metadata": 3, "source": {"a": 1}},
                                     {"cell_type": "code", "metadata": {"dynlab": [1]}, "source": [1, "x = 1"]}])");
    EXPECT_EQ(script_of_notebook(notebook_with(odd).dump(), "a").source, "-- %%\n\n-- %%\nx = 1\n");
    EXPECT_THAT(refusal(std::string(1 << 20, '[')), HasSubstr("not a Jupyter notebook"));
    const json pasted = {{"cell_type", "markdown"}, {"source", "x"}, {"attachments", {{"a.png", json::object()}}}};
    EXPECT_THAT(test::texts_of(script_of_notebook(notebook_with({pasted}).dump(), "a.ipynb").losses),
                ::testing::ElementsAre(HasSubstr("a.ipynb: cell 1 contains a pasted picture")));
}

// Field case 17: a line of a string that reads as a marker, and cells that a script does not have.
TEST(notebook, lines_that_read_as_markers_come_back_and_are_reported) {
    for (const char* line : {"-- %% [markdown]", "--%%", "-- %% id=x", "--- %%", "---- %% a"}) {
        const std::string code = std::string("local s = [[\n") + line + "\ninside]]\nprint(s)";
        const NotebookScript script = script_of_notebook(
            notebook_with({cell("code", code), cell("markdown", "%% not a cell\n\\%% nor this")}).dump(), "a.ipynb");
        const json back = json::parse(notebook_of(parse_percent_script(script.source, "a.lua")))["cells"];
        ASSERT_EQ(back.size(), 2u) << script.source;
        std::string source;
        for (const auto& part : back[0]["source"]) source += part.get<std::string>();
        EXPECT_EQ(source, code);
        EXPECT_EQ(back[1]["source"], (json{"%% not a cell\n", "\\%% nor this"}));
        const bool is_marker = std::string(line).substr(0, 3) != "---";
        EXPECT_EQ(script.losses.size(), is_marker ? 1u : 0u);
        if (is_marker) {
            EXPECT_THAT(test::texts_of(script.losses).front(),
                        HasSubstr("a.ipynb: cell 1, line 2: \"" + std::string(line) +
                                  "\" would start a cell of the script, so the script contains \"-" + line + "\""));
        }
    }
}

TEST(notebook, raw_cells_are_left_out_and_reported) {
    const NotebookScript script = script_of_notebook(
        notebook_with({cell("code", "x = 1"), cell("raw", "raw \\newpage"), cell("code", "print(x)")}).dump(),
        "a.ipynb");
    EXPECT_THAT(script.source, ::testing::Not(HasSubstr("newpage")));
    EXPECT_THAT(test::texts_of(script.losses), ::testing::ElementsAre(HasSubstr("a.ipynb: cell 2 is a raw cell")));
    const int line =
        static_cast<int>(std::ranges::count(script.source.substr(0, script.source.find("print(x)")), '\n')) + 1;
    EXPECT_EQ(message_text(place_in_notebook(script.source, line)), "cell 3, line 1");
}

TEST(notebook, the_command_goes_both_ways_and_keeps_what_others_wrote) {
    const Workbench bench;
    const std::string source =
        "-- ---\n-- title: T\n-- ---\n\n-- %% [markdown]\n-- # Words\n\n-- %%\nprint(6 * 7)\n"
        "plot({1, 2, 3}, {1, 4, 9})\n\n-- %%\nerror(\"stop here\")\n";
    bench.write("a.lua", source);
    EXPECT_EQ(bench.dynlab({"notebook", "a.lua"}).output, "a.ipynb\n");
    bench.write("a.lua", "");
    EXPECT_THAT(bench.dynlab({"notebook", "a.ipynb"}).error_output, HasSubstr("a.lua"));  // the user's file
    EXPECT_EQ(bench.read("a.lua"), "");
    EXPECT_EQ(bench.dynlab({"notebook", "a.ipynb", "--force"}).output, "a.lua\n");
    EXPECT_EQ(bench.read("a.lua"), source);
    const ChildResult run = bench.dynlab({"notebook", "a.lua", "--run", "-o", "b.ipynb"});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.error_output, HasSubstr("stop here"));
    const json cells = json::parse(bench.read("b.ipynb"))["cells"];
    ASSERT_EQ(cells.size(), 4u);
    EXPECT_EQ(cells[2]["outputs"][0]["text"], json{"42\n"});
    EXPECT_THAT(cells[2]["outputs"][1]["data"]["image/svg+xml"].get<std::string>(), HasSubstr("<svg"));
    EXPECT_THAT(cells[3]["outputs"][0]["evalue"].get<std::string>(), HasSubstr("stop here"));
    // Jupyter's own reading of both.
    const ChildResult valid = bench.shell(
        "/usr/bin/python3 -W error -c 'import nbformat\nfor f in (\"a.ipynb\", \"b.ipynb\"):\n"
        "  nbformat.validate(nbformat.read(f, as_version=4))'");
    EXPECT_EQ(valid.exit_code, 0) << valid.error_output;
    EXPECT_EQ(bench.dynlab({"notebook", "none.ipynb"}).exit_code, 1);
    EXPECT_EQ(bench.dynlab({"run", "b.ipynb"}).output.substr(0, 3), "42\n");
}

}  // namespace test_notebook
