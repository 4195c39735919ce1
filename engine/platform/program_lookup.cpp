#include "platform/program_lookup.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "platform/error.h"
#include "platform/files/course_home.h"

namespace dynlab::inline platform {
namespace {

namespace fs = std::filesystem;

bool can_be_run(const fs::path& file) {
    std::error_code error;
    return fs::is_regular_file(file, error) && ::access(file.c_str(), X_OK) == 0;
}

bool is_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

bool is_source_tree(const fs::path& folder) {
    return is_folder(folder / "data") && is_folder(folder / "lessons") && is_folder(folder / "report_templates");
}

}  // namespace

std::optional<fs::path> find_program(const std::string& name) {
    if (name.find('/') != std::string::npos) {
        return can_be_run(name) ? std::optional<fs::path>(name) : std::nullopt;
    }
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path file = fs::path(folder.empty() ? "." : folder) / name;
        if (can_be_run(file)) return file;
    }
    return std::nullopt;
}

std::optional<fs::path> library_folder_of(const fs::path& program) {
    const fs::path folder = program.parent_path().parent_path() / "lib/dynlab";
    return is_folder(folder) ? std::optional(folder) : std::nullopt;
}

fs::path shared_folder_of(const fs::path& program) {
    const fs::path installed = program.parent_path().parent_path() / "share/dynlab";
    if (is_folder(installed / "data")) return installed;
    for (fs::path folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
        if (is_source_tree(folder)) return folder;
    }
    throw EnvironmentError(
        "data sets and lessons not found: neither in {} nor in a folder above {}. Set DYNLAB_HOME to the folder that "
        "contains the subfolders data, lessons and report_templates",
        installed.string(), program.string());
}

fs::path running_program() {
    const fs::path file = fs::read_symlink("/proc/self/exe");
    for (const char* other : {kCourseProgram, kSandboxProgram})
        if (file.filename() == other) return file.parent_path() / kProgram;
    return file;
}

fs::path source_location_file(const fs::path& dynlab) {
    return dynlab.parent_path().parent_path() / "share/dynlab/source";
}

std::vector<fs::path> programs_next_to(const fs::path& dynlab) {
    std::vector<fs::path> files = {dynlab};
    for (const char* other : {kCourseProgram, kSandboxProgram})
        if (fs::is_regular_file(dynlab.parent_path() / other)) files.push_back(dynlab.parent_path() / other);
    return files;
}

namespace {

fs::path installed_folder() {
    if (const char* home = std::getenv("DYNLAB_HOME"); home && *home) {
        if (is_folder(fs::path(home) / "data")) return home;
        throw EnvironmentError(
            "DYNLAB_HOME is {}, but that folder has no subfolder 'data'. Set DYNLAB_HOME to the folder that contains "
            "the subfolders data, lessons and report_templates",
            home);
    }
    return shared_folder_of(running_program());
}

}  // namespace

fs::path shared_folder() {
    const fs::path installed = installed_folder();
    const auto course = own_course();
    return course ? course_home(*course, installed) : installed;
}

fs::path own_file(const fs::path& file) {
    const auto course = own_course();
    if (!course) return file;
    const fs::path place = fs::absolute(file).lexically_normal().lexically_relative(shared_folder().lexically_normal());
    const fs::path own = *course / place;
    return !place.empty() && *place.begin() != ".." && fs::is_regular_file(own) ? own : file;
}

const std::vector<NeededProgram>& needed_programs() {
    static const std::vector<NeededProgram> programs = {
        {"gnuplot", "gnuplot-nox", "draws the figures"},
        {"pandoc", "pandoc", "turns templates into LaTeX and HTML"},
        {"pdflatex", "texlive-latex-base", "sets the PDF documents"},
    };
    return programs;
}

}  // namespace dynlab::inline platform
