#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dynlab::test {
class Browser;
}

namespace dynlab::bench {

/// One line of the table of ratios: what was measured, against what, and the bar it must stay under.
struct Result {
    std::string what, against;
    double measured = 0, reference = 0;  ///< seconds (or MB), medians of one run of the program
    double bar = 0, goal = 0;            ///< of measured/reference; goal 0 when there is none
};

struct Report {
    std::vector<Result> results;
    std::vector<std::string> left_out;  ///< rows that this machine cannot measure, a line each
};

double median(std::vector<double> values);
std::vector<double> repeated_seconds(int repetitions, const std::function<void()>& work);
double median_seconds(int repetitions, const std::function<void()>& work);
/// Both in turn, A B A B ..., so that a drift of the machine's speed hits both alike.
std::pair<double, double> paired_medians(int repetitions, const std::function<void()>& a,
                                         const std::function<void()>& b);

void measure_numerics(Report& report);
void measure_estimators(Report& report);
void measure_irregular(Report& report);
void measure_program(Report& report);
void measure_grading(Report& report);
void measure_course(Report& report);
void measure_live(Report& report);       ///< needs Chromium and its driver
void measure_workbench(Report& report);  ///< as well
void measure_site(Report& report);       ///< as well
void measure_web(Report& report);        ///< as well, and the engine for browsers (scripts/build web) and Node
void measure_lua(Report& report);
void measure_searches(Report& report);
void measure_advice(Report& report);
void measure_grey_box(Report& report);
void measure_cluster(Report& report);  ///< Slurm's row needs slurmctld and slurmd, and root

/// A session of the workbench: SRIVC on 1500 samples.
extern const char* const kDraggedSession;
/// Drags lambda of that session, which the browser shows, for five seconds. `where` is part of the row's name.
void measure_dragging(Report& report, test::Browser& browser, const std::string& where);

}  // namespace dynlab::bench
