#include "course/grading/kept_stages.h"

#include "course/checks/check_descriptions.h"
#include "data_io/values/cbor_values.h"
#include "platform/atomic_file.h"
#include "platform/error.h"

namespace dynlab::inline course {

DYNLAB_DESCRIBE(KeptRuns, fingerprint, work, remark, language)

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

std::optional<KeptRuns> read_kept_runs(const fs::path& file, const std::string& fingerprint) {
    if (!fs::exists(file)) return {};
    try {
        auto runs = from_cbor<KeptRuns>(read_file(file));
        if (runs.fingerprint == fingerprint) return runs;
    } catch (const EnvironmentError&) {
    }
    return {};
}

void write_kept_runs(const fs::path& file, KeptRuns runs, KeptTimes times) {
    if (times == KeptTimes::kNo)
        for (auto& [name, run] : runs.work.runs) run.seconds = 0;
    fs::create_directories(file.parent_path());
    write_file_atomically(file, cbor_of(runs));
}

KeptRuns cached(const fs::path& file, const std::string& key, bool again, const std::function<KeptRuns()>& stage) {
    if (auto kept = again ? std::nullopt : read_kept_runs(file, key)) return *std::move(kept);
    KeptRuns made = stage();
    made.fingerprint = key;
    write_kept_runs(file, made);
    return made;
}

}  // namespace dynlab::inline course
