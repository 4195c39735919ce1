#pragma once
#include <filesystem>
#include <string>

#include "data_io/values/described.h"

namespace dynlab::inline web {

/// A call of a page: try the checks of a lesson that students may read on a script.
struct ChecksOrder {
    std::string source, file;  ///< the script, and its place in the folder of the work
    std::string lesson;        ///< its folder's name, which determines the reruns' data
    std::string checks;        ///< checks.lua
    std::string authors;       ///< checks.LANGUAGE.po: what its author says, translated; empty where there is none
};
DYNLAB_DESCRIBE(ChecksOrder, source, file, lesson, checks, authors)

/// Runs the script as `dynlab check` does, with its reruns on generated data sets, and sends CheckedNews. Checks of a
/// document are left to the program that makes it.
void try_checks_of_page(const ChecksOrder& order);

/// Makes the pack of a folder as `dynlab pack` does.
void pack_of_page(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace dynlab::inline web
