// Submitted archives, in a guarded copy that is confined as the unpacking process is. No file is written beside the
// target folder, and no more data than allowed in it.
#include "course/sandbox_jobs/unpack.h"
#include "fuzz/fuzz_input.h"
#include "platform/guarded_call.h"

using namespace dynlab;

namespace fs = std::filesystem;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMaxByteCount = 1u << 20;
    constexpr int kMaxFiles = 50;
    const fs::path place = fuzz::work_folder() / "place", to = place / "to";
    fs::remove_all(place);
    fs::create_directories(to);
    UnpackJob job;
    job.archive = fuzz::file_of(fuzz::text_of(data, size), "input.zip");
    job.to = to;
    job.bytes = kMaxByteCount;
    job.files = kMaxFiles;
    const ChildResult child = run_guarded([&job] { return unpack_archive(job), std::string("done"); }, {});
    fuzz::demand(child.exit_code == 0 || child.exit_code == 1 || child.timed_out);
    fuzz::demand(std::distance(fs::directory_iterator(place), fs::directory_iterator()) == 1);
    std::uint64_t bytes = 0;
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(to)) {
        fuzz::demand(!entry.is_symlink() && (entry.is_directory() || entry.is_regular_file()));
        files += entry.is_regular_file();
        bytes += entry.is_regular_file() ? entry.file_size() : 0;
    }
    fuzz::demand(files <= kMaxFiles && bytes <= 2 * kMaxByteCount);
    return 0;
}
