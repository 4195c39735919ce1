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

/// The file in which scripts/start notes the source tree from which the installed `dynlab` was built:
/// <prefix>/share/dynlab/source.
std::filesystem::path source_location_file(const std::filesystem::path& dynlab);

/// Those of dynlab's programs that are there, in the order above, `dynlab` being the file of the first.
std::vector<std::filesystem::path> programs_next_to(const std::filesystem::path& dynlab);

/// The folder of a program's own libraries, <prefix>/lib/dynlab beside it; those of portable builds have one.
std::optional<std::filesystem::path> library_folder_of(const std::filesystem::path& program);

/// The folder with data/, lessons/ and report_templates/: $DYNLAB_HOME, else <prefix>/share/dynlab next to the running
/// program, else the source tree that contains its build folder. With a user's course (DYNLAB_COURSE), the folder
/// merges this folder and the course. Throws EnvironmentError that lists the searched places.
std::filesystem::path shared_folder();
/// The same for a given program file, without the environment.
std::filesystem::path shared_folder_of(const std::filesystem::path& program);
/// The file of the user's course that appears as this file below shared_folder(), for messages and for finding related
/// files; any other file unchanged.
std::filesystem::path own_file(const std::filesystem::path& file);

/// A program or Debian package dynlab needs at run time, for `dynlab doctor`.
struct NeededProgram {
    std::string program, package, purpose;
};
const std::vector<NeededProgram>& needed_programs();

}  // namespace dynlab::inline platform
