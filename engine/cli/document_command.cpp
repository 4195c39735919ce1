#include "cli/document_command.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <iostream>

#include "cli/commands.h"

namespace dynlab {
namespace {

/// What is being done, on a line of the terminal that is cleared before anything else is written there.
class StatusLine {
  public:
    void show(const std::string& step) {
        if (!on_terminal_) return;
        std::cerr << "\r\033[K" << step << " ..." << std::flush;
        shown_ = true;
    }
    void clear() {
        if (shown_) std::cerr << "\r\033[K" << std::flush;
        shown_ = false;
    }

  private:
    const bool on_terminal_ = isatty(STDERR_FILENO) != 0;
    bool shown_ = false;
};

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
    StatusLine status;
    request.step = [&status](const std::string& step) { status.show(step); };
    if (request.print) {
        request.print = [&status, print = std::move(request.print)](const std::string& text) {
            status.clear();
            print(text);
        };
    }
    ReportResult result;
    try {
        result = make_report(request);
    } catch (...) {
        status.clear();
        throw;
    }
    status.clear();
    const std::string file = std::filesystem::absolute(request.output).lexically_normal().string();
    const char* const state = result.up_to_date ? " (up to date)" : result.error ? " (up to the error)" : "";
    if (result.error) std::cerr << "dynlab: " << *result.error << std::endl;
    std::cout << file << state << '\n';
    if (show_timings) show(result.timings);
    return result.error ? kFailed : kDone;
}

}  // namespace dynlab
