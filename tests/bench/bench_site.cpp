#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include "bench/bench.h"
#include "bench/program_work.h"
#include "support/browser.h"

namespace dynlab::bench {
namespace {

/// Processor time of all processes that this one has started and waited for.
double seconds_of_children() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Of what readers type, the one that its index page takes longest for.
double slowest_search(const std::filesystem::path& index) {
    test::Browser browser;
    browser.open("file://" + index.string());
    browser.evaluate("window.dynlabLoadSearch().then(() => { window.ready = true })");
    browser.becomes_true("window.ready");
    const std::string milliseconds = browser.evaluate(
        "let most = 0; for (const asked of ['s', 'identification of a system', 'a b c d e', 'delay', 'th']) {"
        "  const begin = performance.now(); dynlabSearch(asked); most = Math.max(most, performance.now() - begin); }"
        "return most");
    return 1e-3 * nlohmann::json::parse(milliseconds).get<double>();
}

}  // namespace

void measure_site(Report& report) {
    const test::Workbench bench;
    const double before = seconds_of_children();
    must_succeed(bench.dynlab({"site", "site"}));
    report.results.push_back(
        {"dynlab site, nothing recalled (processor s)", "60 s", seconds_of_children() - before, 60, 1, 0});
    report.results.push_back({"search of the site, the slowest words (s)", "50 ms",
                              slowest_search(bench.path("site/index.html")), 0.050, 1, 0});
}

}  // namespace dynlab::bench
