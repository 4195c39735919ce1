#include <sys/resource.h>

#include <fmt/format.h>
#include <filesystem>
#include <stdexcept>

#include "bench/bench.h"
#include "bench/program_work.h"
#include "support/program.h"

namespace dynlab::bench {
namespace {

namespace fs = std::filesystem;
using test::Workbench;

constexpr int kGroups = 300;

/// A course of 300 groups, and class.zip with a report of six pages by each. The reports differ in one remark.
void prepare(const Workbench& bench) {
    make_six_pages(bench);
    const std::string report = bench.read("six/report.pdf");
    const std::size_t end = report.rfind("startxref");
    std::string roster = "id,name,group,mail\n";
    for (int i = 1; i <= kGroups; ++i) {
        roster += fmt::format("s{0:03}1,Given{0:03} Sur{0:03}name,group-{0:03},s{0:03}1@course.example\n", i);
        bench.write(fmt::format("in/group-{:03}.pdf", i),
                    report.substr(0, end) + fmt::format("% copy {}\n", i) + report.substr(end));
    }
    bench.write("roster.csv", roster);
    must_succeed(bench.shell("cd in && zip -q ../class.zip *.pdf"));
    must_succeed(bench.dynlab({"course", "init", "k"}));
    must_succeed(bench.dynlab({"course", "--course", "k", "import", "roster.csv"}));
    must_succeed(bench.dynlab({"course", "--course", "k", "assignment", "crane", "--first", "2026-03-01 12:00",
                               "--review", "2026-03-08 12:00", "--final", "2026-03-15 12:00"}));
}

}  // namespace

void measure_course(Report& report) {
    const Workbench bench;
    prepare(bench);
    const double received = median_seconds(1, [&] {
        must_succeed(bench.dynlab({"course", "--course", "k", "receive", "class.zip", "--at", "2026-03-01 10:00"}));
    });
    const double assigned = median_seconds(1, [&] {
        must_succeed(bench.dynlab({"course", "--course", "k", "review", "assign", "--at", "2026-03-02 10:00"}));
    });
    rusage used{};
    ::getrusage(RUSAGE_CHILDREN, &used);
    report.results.push_back({"course, receive 300 reports with findings (s)", "5 s", received, 5, 1, 0.6});
    report.results.push_back({"course, allot 300 groups' reviews (s)", "0.2 s", assigned, 0.2, 1, 0});
    report.results.push_back({"course, memory of the largest process (MB)", "200 MB",
                              static_cast<double>(used.ru_maxrss) / 1024, 200, 1, 0});
}

}  // namespace dynlab::bench
