#include "cli/document_command.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <iostream>

#include "cli/commands.h"

namespace dynlab {
namespace {

void show(const std::vector<std::pair<std::string, double>>& timings) {
    double total = 0;
    for (const auto& [step, seconds] : timings) {
        std::cout << fmt::format("{:>8.0f} ms  {}\n", 1e3 * seconds, step);
        total += seconds;
    }
    std::cout << fmt::format("{:>8.0f} ms  in total\n", 1e3 * total);
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    std::cout << fmt::format("{:>8.1f} MB  peak memory of dynlab itself\n", static_cast<double>(used.ru_maxrss) / 1024);
}

}  // namespace

int make_document(ReportRequest request, bool show_timings) {
    const bool on_terminal = isatty(STDERR_FILENO) != 0;
    if (on_terminal) {
        request.step = [](const std::string& step) { std::cerr << "\r\033[K" << step << " ..." << std::flush; };
    }
    const auto clear_line = [on_terminal] {
        if (on_terminal) std::cerr << "\r\033[K" << std::flush;
    };
    ReportResult result;
    try {
        result = make_report(request);
    } catch (...) {
        clear_line();
        throw;
    }
    clear_line();
    const std::string file = std::filesystem::absolute(request.output).lexically_normal().string();
    std::cout << file << (result.up_to_date ? " (up to date)" : "") << '\n';
    if (show_timings) show(result.timings);
    return kDone;
}

}  // namespace dynlab
