#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>

#include "workflow/parts/machines.h"
#include "workflow/parts/part.h"

namespace dynlab::inline cli {

/// --part, --join and --on of commands whose work may be done in parts.
struct PartOptions {
    std::string part, on;
    bool join = false;

    void add_to(CLI::App& command);
    bool any() const { return join || !part.empty() || !on.empty(); }
    std::optional<WorkPart> chosen() const { return part_in(part); }
};

/// Has the parts of some work done by the machines that --on names; `missing` gives those that are not complete when
/// the work is split into so many. True once nothing is missing, so that they can be joined here; false where Slurm has
/// them and joins them, too.
bool done_on(const std::string& on, const std::filesystem::path& folder,
             const std::function<MissingParts(int parts)>& missing);

/// Parts that are to be joined and are not complete. Throws EnvironmentError that says how to make them.
void refuse_missing_parts(const std::set<int>& missing, int parts);

}  // namespace dynlab::inline cli
