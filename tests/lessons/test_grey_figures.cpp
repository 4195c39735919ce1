// The figures of the lessons as a black-and-white printer gives them. Oracle: poppler's greys.
#include <gtest/gtest.h>

#include "platform/temporary_folder.h"
#include "scripting/memoized_calls/memoized_call.h"
#include "support/environment_variable.h"
#include "support/grey_looks.h"
#include "support/lesson_list.h"
#include "support/program.h"
#include "workflow/lesson_catalog.h"
#include "workflow/run_script.h"

namespace dynlab::test {
namespace test_grey_figures {

class grey_figures : public testing::TestWithParam<const char*> {};

TEST_P(grey_figures, neighboring_curves_are_distinguished) {
    const std::filesystem::path file = find_lesson(GetParam()).script();
    const PercentScript script = parse_percent_script(quick_solution_of(file.parent_path().filename()), file);
    const EnvironmentVariable cache_home("XDG_CACHE_HOME", Workbench(Workbench::Memory::kShared).cache());
    const Cache cache;
    CallCache calls(cache);
    const TemporaryFolder out;
    GnuplotRenderer renderer;
    RunRequest request;
    request.script = script;
    request.out_folder = out.path();
    request.call_cache = &calls;
    const RunRecord record = run_script(request, renderer);
    ASSERT_FALSE(record.error) << record.error->text();
    EXPECT_FALSE(record.figures.empty());
    for (const auto& [name, drawn] : record.figures)
        for (std::size_t place = 0; place < drawn.figure->panels.size(); ++place) {
            for (const auto& [of, what] :
                 {std::pair(GreyLooks::Of::kNamedCurves, "named curves"), std::pair(GreyLooks::Of::kBands, "bands")}) {
                const GreyLooks looks(drawn.figure->panels[place], of);
                for (std::size_t i = 0; i + 1 < looks.size(); ++i)
                    EXPECT_GT(looks.difference(i, i + 1), kSeenInGrey)
                        << "figure " << name << ", panel " << place + 1 << ", " << what << " " << i + 1 << " and "
                        << i + 2;
            }
        }
}

INSTANTIATE_TEST_SUITE_P(all, grey_figures,
                         testing::Values("01", "02", "03_workflow", "03_crane", "04", "05", "06", "07"),
                         [](const auto& lesson) { return std::string(lesson.param); });

}  // namespace test_grey_figures
}  // namespace dynlab::test
