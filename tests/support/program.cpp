#include "support/program.h"

#include <algorithm>
#include <cstdlib>

#include "platform/atomic_file.h"

namespace dynlab::test {

namespace fs = std::filesystem;

Workbench::Workbench(Memory memory)
    : path_variable_(std::getenv("PATH")),
      cache_(memory == Memory::kShared ? fs::path(DYNLAB_PROGRAM).parent_path().parent_path() / "memory_of_tests"
                                       : folder_.path() / "cache") {
    fs::create_directory(path());
}

void Workbench::write(const std::string& name, const std::string& text) const {
    fs::create_directories(path(name).parent_path());
    write_file_atomically(path(name), text);
}

std::string Workbench::read(const std::string& name) const {
    return read_file(path(name));
}

std::vector<std::string> Workbench::files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path())) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

void Workbench::hide_program(const std::string& name) {
    const fs::path programs = folder_.path() / "programs";
    fs::create_directories(programs);
    for (const char* place : {"/usr/bin", "/bin"}) {
        for (const auto& entry : fs::directory_iterator(place)) {
            std::error_code exists_already;
            if (entry.path().filename() != name) {
                fs::create_symlink(entry.path(), programs / entry.path().filename(), exists_already);
            }
        }
    }
    path_variable_ = programs;
}

ChildResult Workbench::run(std::vector<std::string> command) const {
    ChildOptions options;
    options.command = std::move(command);
    options.folder = path();
    options.environment = {{"PATH", path_variable_},
                           {"DYNLAB", DYNLAB_PROGRAM},
                           {"DYNLAB_HOME", home_.empty() ? DYNLAB_SOURCE_DIR : home_},
                           {"XDG_CACHE_HOME", cache_.string()},
                           {"XDG_STATE_HOME", (folder_.path() / "state").string()}};
    options.timeout = std::chrono::seconds(DYNLAB_SECONDS_OF_A_PROGRAM);
    return run_child(options, "dynlab");
}

ChildResult Workbench::dynlab(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), DYNLAB_PROGRAM);
    return run(std::move(arguments));
}

ChildResult Workbench::shell(const std::string& command) const {
    return run({"/bin/bash", "-c", command});
}

}  // namespace dynlab::test
