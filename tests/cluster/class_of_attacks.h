#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <span>
#include <string>

#include "course/attacks.h"
#include "course/grading_bench.h"

namespace dynlab::test {

/// The class's submissions: `count` honest ones that count to `turns` first, two in three right, and these attacks.
inline void submit_class(GradingBench& bench, int count, int turns, std::span<const Attack> attacks) {
    bench.bench().write("secret", "the course's secret");
    for (const Attack& attack : attacks) bench.submit_file(attack.name, attack.script);
    for (int i = 0; i < count; ++i)
        bench.submit_file(fmt::format("s{:03}", i),
                          fmt::format("local k = 0\nfor i = 1, {} do k = k + i % 7 end\nanswer('x', {})\n", turns,
                                      i % 3 == 0 ? i : 42));
}

/// Of two folders of results: the gradebook, and each submission's result and feedback. The kept run of the worked
/// solution says how long it took.
inline void expect_equal_results(const Workbench& work, const std::string& one, const std::string& other) {
    EXPECT_EQ(work.read(one + "/gradebook.csv"), work.read(other + "/gradebook.csv"));
    EXPECT_EQ(
        work.shell(fmt::format("diff -rq {0}/results {1}/results; diff -rq -x .worked_solution.cbor {0}/runs {1}/runs",
                               one, other))
            .output,
        "");
}

/// Processes that grade a part in this bench.
inline std::string workers_of(const Workbench& work) {
    return work
        .shell(
            "for p in $(pgrep -f '[d]ynlab.* --part'); do "
            "[ \"$(readlink /proc/$p/cwd)\" = \"$PWD\" ] && echo $p; done")
        .output;
}

}  // namespace dynlab::test
