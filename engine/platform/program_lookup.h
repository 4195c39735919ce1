#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline platform {

std::optional<std::filesystem::path> find_program(const std::string& name);  ///< in PATH, or a path as it is

/// The programs that together are dynlab, in one folder. People start the first; for a command that it lacks it goes on
/// as the second, which has all commands. The last one works in sandboxes.
inline constexpr const char* kProgram = "dynlab";
inline constexpr const char* kCourseProgram = "dynlab-course";
inline constexpr const char* kSandboxProgram = "dynlab-boxed";

/// The file of the program that runs; that of dynlab where one of the others does.
std::filesystem::path running_program();

/// Where scripts/start records the source tree from which the installed `dynlab` was built:
/// <prefix>/share/dynlab/source.
std::filesystem::path source_record(const std::filesystem::path& dynlab);

/// Those of dynlab's programs that are there, in the order above, `dynlab` being the file of the first.
std::vector<std::filesystem::path> programs_next_to(const std::filesystem::path& dynlab);

/// The folder of a program's own libraries, <prefix>/lib/dynlab beside it; those of portable builds have one.
std::optional<std::filesystem::path> library_folder_of(const std::filesystem::path& program);

/// Folder with data/, lessons/ and report_templates/: $DYNLAB_HOME, else <prefix>/share/dynlab beside the
/// running program, else the source tree that holds its build folder; with a course of one's own (DYNLAB_COURSE) what
/// this and the course hold together. Throws EnvironmentError that lists the places tried.
std::filesystem::path shared_folder();
/// The same for a given program file, without the environment.
std::filesystem::path shared_folder_of(const std::filesystem::path& program);
/// The file of one's own course that is found as this one below shared_folder(), for messages and for what is beside
/// it; any other file as it is.
std::filesystem::path own_file(const std::filesystem::path& file);

/// A program or Debian package dynlab needs at run time, for `dynlab doctor`.
struct NeededProgram {
    std::string program, package, purpose;
};
const std::vector<NeededProgram>& needed_programs();

}  // namespace dynlab::inline platform
