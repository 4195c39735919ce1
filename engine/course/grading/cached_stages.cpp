#include "course/grading/cached_stages.h"

#include "course/checks/check_descriptions.h"
#include "data_io/values/cbor_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {

DYNLAB_DESCRIBE(CachedRuns, fingerprint, work, remark, language)

namespace fs = std::filesystem;

std::optional<Grade> earlier_grade(const fs::path& folder) {
    const fs::path file = folder / "results.json";
    if (!fs::exists(file)) return {};
    try {
        return from_results_json(read_file(file));
    } catch (const EnvironmentError&) {
        return {};
    }
}

std::optional<CachedRuns> read_cached_runs(const fs::path& file, const std::string& fingerprint) {
    if (!fs::exists(file)) return {};
    try {
        auto runs = from_cbor<CachedRuns>(read_file(file));
        if (runs.fingerprint == fingerprint) return runs;
    } catch (const EnvironmentError&) {
    }
    return {};
}

void write_cached_runs(const fs::path& file, CachedRuns runs, CachedTimes times) {
    if (times == CachedTimes::kNo)
        for (auto& [name, run] : runs.work.runs) run.seconds = 0;
    fs::create_directories(file.parent_path());
    write_file_atomically(file, cbor_of(runs));
}

CachedRuns cached(const fs::path& file, const std::string& key, bool again, const std::function<CachedRuns()>& stage) {
    if (auto kept = again ? std::nullopt : read_cached_runs(file, key)) return *std::move(kept);
    CachedRuns made = stage();
    made.fingerprint = key;
    write_cached_runs(file, made);
    return made;
}

}  // namespace dynlab::inline course
