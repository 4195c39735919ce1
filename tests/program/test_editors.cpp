// What a copy leaves for editors, and `dynlab lint`. Oracles: the settings that LuaLS and the tasks that VS Code
// document, by name; messages of the program itself, found by the problem matcher as an editor finds them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "support/program.h"

namespace dynlab::test {
namespace test_editors {
using nlohmann::json;
using testing::HasSubstr;
using testing::IsSupersetOf;

constexpr const char* kWrong =
    "local data = iddata({1, 2}, {1, 2}, 1)\nlocal model = 2\nlocal G = srivc(data, {1, 2, 0}, {Lamda = "
    "3})\nprint(modle)\n";

const Workbench& copy_of_a_lesson() {
    static const Workbench bench;
    static const int made = bench.dynlab({"new", "02", "mine"}).exit_code;
    EXPECT_EQ(made, 0);
    return bench;
}

// oracle: the schemas of LuaLS (setting/schema.json) and of VS Code's tasks (version 2.0.0), read once
TEST(editors, find_settings_that_they_document) {
    const Workbench& bench = copy_of_a_lesson();
    const json settings = json::parse(bench.read("mine/.luarc.json"));
    const std::set<std::string> documented = {"$schema",           "runtime.version",           "runtime.builtin",
                                              "workspace.library", "workspace.checkThirdParty", "diagnostics.disable"};
    for (const auto& [key, value] : settings.items()) EXPECT_TRUE(documented.contains(key)) << key;
    const std::set<std::string> libraries = {"basic", "bit",  "bit32", "builtin", "coroutine", "debug", "ffi", "io",
                                             "jit",   "math", "os",    "package", "string",    "table", "utf8"};
    for (const auto& [library, how] : settings.at("runtime.builtin").items()) {
        EXPECT_TRUE(libraries.contains(library)) << library;
        EXPECT_EQ(how, "disable");
    }
    EXPECT_EQ(settings.at("workspace.checkThirdParty"), false);
    EXPECT_EQ(settings.at("workspace.library"), json({".dynlab"}));
    EXPECT_EQ(settings.at("runtime.version"), "Lua 5.4");
    EXPECT_THAT(bench.read("mine/.dynlab/types.lua"), HasSubstr("\nfunction srivc("));
    EXPECT_THAT(bench.read("mine/.editorconfig"), testing::StartsWith("root = true\n"));
}

TEST(editors, mark_the_lines_that_messages_name) {
    const Workbench& bench = copy_of_a_lesson();
    const json tasks = json::parse(bench.read("mine/.vscode/tasks.json"));
    EXPECT_EQ(tasks.at("version"), "2.0.0");
    const std::set<std::string> documented = {"label", "type", "command", "args", "options", "problemMatcher", "group"};
    bench.write("wrong.lua", kWrong);
    bench.write("stops.lua", "local a = 1\nprint(zzz)\n");
    const std::string reported = bench.dynlab({"lint", "wrong.lua"}).output +
                                 bench.dynlab({"run", "stops.lua"}).error_output +
                                 bench.dynlab({"run", bench.path("stops.lua")}).error_output;
    for (const json& task : tasks.at("tasks")) {
        for (const auto& [key, value] : task.items()) EXPECT_TRUE(documented.contains(key)) << key;
        EXPECT_EQ(task.at("type"), "process");
        const json &problems = task.at("problemMatcher"), &pattern = problems.at("pattern");
        for (const auto& [key, value] : problems.items())
            EXPECT_TRUE(std::set<std::string>({"owner", "fileLocation", "pattern"}).contains(key)) << key;
        for (const auto& [key, value] : pattern.items())
            EXPECT_TRUE(std::set<std::string>({"regexp", "file", "line", "column", "message"}).contains(key)) << key;
        EXPECT_EQ(problems.at("fileLocation"), json({"autoDetect", "${workspaceFolder}"}));
        const json usual = {{"kind", "build"}, {"isDefault", true}};
        EXPECT_EQ(task.value("group", usual), usual);
        const std::regex matcher(pattern.at("regexp").get<std::string>());
        std::vector<std::string> places;
        std::istringstream lines(reported);
        std::smatch found;
        for (std::string line; std::getline(lines, line);)
            if (std::regex_match(line, found, matcher))
                places.push_back(found[pattern.at("file")].str() + " " + found[pattern.at("line")].str() + " " +
                                 found[pattern.at("column")].str());
        EXPECT_THAT(places, testing::ElementsAre("wrong.lua 3 35", "wrong.lua 4 7", "stops.lua 2 ",
                                                 bench.path("stops.lua").string() + " 2 "))
            << reported;
    }
}

TEST(editors, keep_what_a_user_has_changed) {
    const Workbench bench;
    std::filesystem::create_directories(bench.path("work"));
    EXPECT_EQ(bench.dynlab({"new", "editor", "nowhere"}).exit_code, 1);
    ASSERT_EQ(bench.dynlab({"new", "editor", "work"}).exit_code, 0);
    bench.write("work/.editorconfig", "root = false\n");
    bench.write("work/.dynlab/types.lua", "of an older program");
    const ChildResult again = bench.dynlab({"new", "editor", "work"});
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_THAT(again.output, HasSubstr(".editorconfig already exists and was not changed\n"));
    EXPECT_THAT(again.output, testing::Not(HasSubstr(".luarc.json")));
    EXPECT_EQ(bench.read("work/.editorconfig"), "root = false\n");
    EXPECT_THAT(bench.read("work/.dynlab/types.lua"), testing::StartsWith("---@meta\n"));
}

TEST(lint_command, reports_files_lines_and_columns) {
    const Workbench& bench = copy_of_a_lesson();
    bench.write("wrong.lua", kWrong);
    bench.write("right.lua", "print(1)\n");
    const ChildResult wrong = bench.dynlab({"lint", "right.lua", "wrong.lua"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_EQ(wrong.output,
              "wrong.lua:3:35: srivc: unknown option 'Lamda'; did you mean 'lambda'?\nwrong.lua:4:7: unknown function "
              "or variable 'modle'; did you mean 'model'?\n");
    EXPECT_THAT(bench.dynlab({"help", "guide-editors"}).output,
                HasSubstr("wrong.lua:3:35: srivc: unknown option 'Lamda'"));
    const json reported = json::parse(bench.dynlab({"lint", "--json", "wrong.lua"}).output).at("findings");
    ASSERT_EQ(reported.size(), 2u);
    EXPECT_EQ(reported[1], json({{"file", "wrong.lua"},
                                 {"line", 4},
                                 {"column", 7},
                                 {"kind", "unknown-name"},
                                 {"message", "unknown function or variable 'modle'; did you mean 'model'?"}}));
    EXPECT_EQ(bench.dynlab({"lint", "right.lua"}).exit_code, 0);
    EXPECT_EQ(bench.dynlab({"lint", "right.lua"}).output, "");
    const ChildResult piped = bench.shell("printf 'x = 1\\nprint(yy)\\n' | \"$DYNLAB\" lint -");
    EXPECT_EQ(piped.exit_code, 1);
    EXPECT_THAT(piped.output, HasSubstr("-:2:7: unknown function or variable 'yy'"));
    EXPECT_THAT(bench.dynlab({"lint", "mine"}).output, HasSubstr("mine/analysis.lua:"));
    for (const char* missing : {"nowhere.lua", "."}) EXPECT_EQ(bench.dynlab({"lint", missing}).exit_code, 2) << missing;
    EXPECT_EQ(bench.dynlab({"lint"}).exit_code, 2);
}

TEST(lsp_command, speaks_in_framed_messages_until_the_editor_ends_it) {
    const Workbench bench;
    const auto framed = [](const json& message) {
        const std::string text = message.dump();
        return "Content-Length: " + std::to_string(text.size()) + "\r\n\r\n" + text;
    };
    const json opened = {{"method", "textDocument/didOpen"},
                         {"params", {{"textDocument", {{"uri", "file:///a.lua"}, {"text", "print(zzz)"}}}}}};
    bench.write("asked", framed({{"id", 1}, {"method", "initialize"}}) + framed(opened) +
                             framed({{"id", 2}, {"method", "shutdown"}}) + framed({{"method", "exit"}}));
    const ChildResult spoken = bench.shell("$DYNLAB lsp < asked");
    EXPECT_EQ(spoken.exit_code, 0) << spoken.error_output;
    std::string rest = spoken.output;
    std::vector<json> answers;
    std::smatch head;
    while (std::regex_search(rest, head, std::regex("^Content-Length: (\\d+)\r\n\r\n"))) {
        const std::size_t begin = head[0].length(), length = std::stoul(head[1]);
        answers.push_back(json::parse(rest.substr(begin, length)));
        rest.erase(0, begin + length);
    }
    EXPECT_EQ(rest, "");
    ASSERT_EQ(answers.size(), 3u);
    EXPECT_EQ(answers[1].at("params").at("diagnostics").at(0).at("code"), "unknown-name");
    for (const char* broken : {"", "Content-Length: 99999999999999\r\n\r\n", "Content-Length: 500\r\n\r\n{"}) {
        bench.write("asked", broken);
        EXPECT_EQ(bench.shell("$DYNLAB lsp < asked").exit_code, 1) << broken;
    }
}

}  // namespace test_editors
}  // namespace dynlab::test
