#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace dynlab::inline course {

struct FolderRequest;

/// The options that a folder of results was made with: a later run goes on with those that it is not given. Files are
/// named as they are seen from the current folder; texts are empty where the option was not given.
struct RememberedOptions {
    std::string lesson, checks, secret, roster, owners, deadlines, keep, timezone, isolation, times;
    int timeout = 0;  ///< s
};
std::optional<RememberedOptions> remembered_options(const std::filesystem::path& out);

/// Writes what the results in the folder `out` are made with: it is beside them as grading.json, so that no later
/// run mixes marks of two kinds. Throws EnvironmentError that names the differences where those that are there were
/// made with something else and are not to be made again. A roster or a list of owners, which say whose work it is, may
/// be given or corrected when all of the class is graded, as the gradebook is then made again from all of it; one that
/// is missing now counts. Deadlines take points: other ones always count.
void remember_inputs(const FolderRequest& request);

}  // namespace dynlab::inline course
