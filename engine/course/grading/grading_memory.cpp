#include "course/grading/grading_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/checks/check_descriptions.h"
#include "data_io/values/cbor_values.h"
#include "data_io/values/json_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/hash.h"

namespace dynlab::inline course {

DYNLAB_DESCRIBE(RememberedInput, name, hash)
DYNLAB_DESCRIBE(GradingMemory, lesson, lesson_checks, checks, secret, roster, owners, deadlines, keep, timezone)
DYNLAB_DESCRIBE(KeptRuns, fingerprint, work, remark, language)

namespace {

namespace fs = std::filesystem;

constexpr char kMemoryFile[] = "grading.json";

std::string shown_input(const RememberedInput& input) {
    return input.hash.empty() ? "none" : input.name;
}

std::string named_input(const RememberedInput& then, const RememberedInput& now) {
    if (then.name == now.name && !then.hash.empty() && !now.hash.empty())
        return fmt::format("({} has changed)", now.name);
    return fmt::format("({} then, {} now)", shown_input(then), shown_input(now));
}

}  // namespace

RememberedInput remembered_file(const std::optional<fs::path>& file) {
    if (!file) return {};
    return {file->string(), sha256_of_file(*file)};
}

RememberedInput remembered_folder(const std::optional<fs::path>& folder) {
    if (!folder || !fs::is_directory(*folder)) return {};
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(*folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    Sha256 hash;
    for (const fs::path& file : files) {
        const std::string name = file.lexically_relative(*folder).string();
        hash.add(fmt::format("{}:{}:{}:", name.size(), name, fs::file_size(file))).add_file(file);
    }
    return {folder->string(), hash.hex()};
}

RememberedInput remembered_text(const std::string& name, const std::string& text) {
    return text.empty() ? RememberedInput{} : RememberedInput{name, sha256_of("dynlab grade:" + text)};
}

std::optional<GradingMemory> read_grading_memory(const fs::path& out) {
    if (!fs::exists(out / kMemoryFile)) return {};
    try {
        return from_json<GradingMemory>(read_file(out / kMemoryFile));
    } catch (const EnvironmentError&) {
        return {};
    }
}

void write_grading_memory(const fs::path& out, const GradingMemory& memory) {
    write_file_atomically(out / kMemoryFile, json_of(memory, 2) + "\n");
}

std::vector<std::string> differences_of(const GradingMemory& then, const GradingMemory& now, bool all_of_the_class) {
    std::vector<std::string> clauses;
    const auto compare = [&](const char* what, const RememberedInput& a, const RememberedInput& b, bool always) {
        const bool gone = !a.hash.empty() && b.hash.empty();
        if (a.hash != b.hash && (always || gone || !all_of_the_class))
            clauses.push_back(fmt::format("{} {}", what, named_input(a, b)));
    };
    compare("the lesson's checks", then.lesson_checks, now.lesson_checks, true);
    compare("your own checks", then.checks, now.checks, true);
    compare("the secret", then.secret, now.secret, true);
    compare("the roster", then.roster, now.roster, false);
    compare("the list of owners", then.owners, now.owners, false);
    compare("the deadlines", then.deadlines, now.deadlines, true);
    if (then.keep != now.keep)
        clauses.push_back(fmt::format("which hand-in counts ({} then, {} now)", then.keep, now.keep));
    if (then.timezone != now.timezone)
        clauses.push_back(fmt::format("the time zone ({} then, {} now)",
                                      then.timezone.empty() ? "this machine's" : then.timezone,
                                      now.timezone.empty() ? "this machine's" : now.timezone));
    return clauses;
}

std::optional<KeptRuns> read_kept_runs(const fs::path& file, const std::string& fingerprint) {
    if (!fs::exists(file)) return {};
    try {
        auto runs = from_cbor<KeptRuns>(read_file(file));
        if (runs.fingerprint == fingerprint) return runs;
    } catch (const EnvironmentError&) {
    }
    return {};
}

void write_kept_runs(const fs::path& file, KeptRuns runs) {
    for (auto& [name, run] : runs.work.runs) run.seconds = 0;  // equal classes give equal files
    fs::create_directories(file.parent_path());
    write_file_atomically(file, cbor_of(runs));
}

}  // namespace dynlab::inline course
