#include "support/program.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::test {

namespace fs = std::filesystem;
namespace {

constexpr char kFormats[] = "dynlab/latex-formats";

fs::path memory_of_tests() {
    return fs::path(DYNLAB_PROGRAM).parent_path().parent_path() / "memory_of_tests";
}

}  // namespace

void lend_formats(const fs::path& cache) {
    std::error_code error;
    fs::create_directories(cache / kFormats);
    for (fs::directory_iterator format(memory_of_tests() / kFormats, error), end; !error && format != end;
         format.increment(error))
        fs::create_directory_symlink(format->path(), cache / kFormats / format->path().filename());
}

void keep_formats(const fs::path& cache) {
    const fs::path memory = memory_of_tests() / "dynlab", unfinished = memory / (".new-" + std::to_string(::getpid()));
    std::error_code error;
    fs::create_directories(memory_of_tests() / kFormats, error);
    for (fs::directory_iterator format(cache / kFormats, error), end; !error && format != end;
         format.increment(error)) {
        std::error_code failed;
        if (format->is_symlink(failed) || !format->is_directory(failed)) continue;
        fs::copy(format->path(), unfinished, fs::copy_options::recursive, failed);
        if (!failed) fs::rename(unfinished, memory_of_tests() / kFormats / format->path().filename(), failed);
        fs::remove_all(unfinished, failed);
    }
}

Workbench::Workbench(Memory memory)
    : path_variable_(std::getenv("PATH")),
      cache_(memory == Memory::kShared ? memory_of_tests() : folder_.path() / "cache") {
    fs::create_directory(path());
    if (memory == Memory::kOwn) lend_formats(cache_);
}

Workbench::~Workbench() {
    if (cache_ != memory_of_tests()) keep_formats(cache_);
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

std::filesystem::path shared_document(const std::vector<std::string>& command, const std::string& name) {
    const fs::path document = memory_of_tests() / "pages" / name;
    fs::create_directories(document.parent_path());
    std::string words;
    for (const std::string& word : command) words += "'" + word + "' ";
    const std::string file = "'" + document.string();
    const ChildResult made = Workbench(Workbench::Memory::kShared)
                                 .shell("flock " + file + ".lock' \"$DYNLAB\" " + words + "-o " + file + "'");
    if (made.exit_code != 0) throw EnvironmentError(made.error_output);
    return document;
}

std::filesystem::path page_of_lesson(const std::string& lesson) {
    return shared_document({"report", lesson}, lesson + ".html");
}

}  // namespace dynlab::test
