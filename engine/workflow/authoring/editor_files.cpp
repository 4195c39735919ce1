#include "workflow/authoring/editor_files.h"

#include <map>
#include <nlohmann/json.hpp>

#include "platform/atomic_file.h"
#include "scripting/lint/type_stubs.h"

namespace dynlab::inline workflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kStubs = ".dynlab/types.lua";  // contains no user's lines: it is always written again

constexpr const char* kEditorConfig = R"(root = true

[*]
charset = utf-8
end_of_line = lf
insert_final_newline = true

[*.lua]
indent_style = space
indent_size = 2
trim_trailing_whitespace = true

[*.md]
trim_trailing_whitespace = false
)";

/// Settings of LuaLS, by its documented names.
json language_server_settings() {
    return {{"$schema", "https://raw.githubusercontent.com/LuaLS/vscode-lua/master/setting/schema.json"},
            {"runtime.version", "Lua 5.4"},
            {"runtime.builtin",
             {{"debug", "disable"},
              {"ffi", "disable"},
              {"io", "disable"},
              {"jit", "disable"},
              {"os", "disable"},
              {"package", "disable"}}},
            {"workspace.library", {".dynlab"}},
            {"workspace.checkThirdParty", false},
            // A script's variables are global unless it says otherwise, as in the lessons.
            {"diagnostics.disable", {"lowercase-global"}}};
}

/// A line that dynlab prints about a script: "dynlab: my-work/analysis.lua:12: what", with a column where `lint` knows
/// it.
json problem_matcher() {
    return {{"owner", "dynlab"},
            {"fileLocation", {"autoDetect", "${workspaceFolder}"}},
            {"pattern",
             {{"regexp", "^(?:dynlab: )?(.+?\\.(?:lua|md)):(\\d+)(?::(\\d+))?: (.*)$"},
              {"file", 1},
              {"line", 2},
              {"column", 3},
              {"message", 4}}}};
}

json task(const char* label, std::vector<std::string> words, bool of_build) {
    json made = {{"label", label},
                 {"type", "process"},
                 {"command", "dynlab"},
                 {"args", std::move(words)},
                 {"options", {{"cwd", "${workspaceFolder}"}}},
                 {"problemMatcher", problem_matcher()}};
    if (of_build) made["group"] = {{"kind", "build"}, {"isDefault", true}};
    return made;
}

json tasks() {
    return {
        {"version", "2.0.0"},
        {"tasks",
         {task("dynlab: look for mistakes", {"lint", "${file}"}, false), task("dynlab: run", {"run", "${file}"}, true),
          task("dynlab: report", {"report", "."}, false), task("dynlab: check", {"check", "."}, false)}}};
}

}  // namespace

std::vector<std::string> write_editor_files(const fs::path& folder) {
    const std::map<std::string, std::string> files = {{kStubs, type_stubs()},
                                                      {".luarc.json", language_server_settings().dump(2) + "\n"},
                                                      {".vscode/tasks.json", tasks().dump(2) + "\n"},
                                                      {".editorconfig", kEditorConfig}};
    std::vector<std::string> kept;
    for (const auto& [name, text] : files) {
        const fs::path file = folder / name;
        const bool there = fs::exists(file);
        if (there && name != kStubs) {
            if (read_text(file) != text) kept.push_back(name);
            continue;
        }
        fs::create_directories(file.parent_path());
        write_file_atomically(file, text);
    }
    return kept;
}

}  // namespace dynlab::inline workflow
