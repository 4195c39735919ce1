#include "bench/program_work.h"

#include <filesystem>
#include <stdexcept>

#include "platform/atomic_file.h"

namespace dynlab::bench {

namespace fs = std::filesystem;

void must_succeed(const ChildResult& result) {
    if (result.exit_code != 0) throw std::runtime_error(result.output + result.error_output);
}

void make_six_pages(const test::Workbench& bench) {
    const fs::path source = fs::path(DYNLAB_SOURCE_DIR) / "tests/bench/six_pages";
    for (const char* file : {"analysis.lua", "report.md"})
        bench.write(fs::path("six") / file, read_file(source / file));
    must_succeed(bench.dynlab({"report", "six"}));
}

}  // namespace dynlab::bench
