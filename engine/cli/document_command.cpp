#include "cli/document_command.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <iostream>

#include "cli/commands.h"
#include "cli/say.h"
#include "platform/terminal/activity_line.h"

namespace dynlab::inline cli {
namespace {

constexpr double kMinShownTime = 0.01;  // s

void show_time(double seconds, const std::string& of, const char* indent = "") {
    std::cout << fmt::format("{:>8.0f} ms  {}{}\n", 1e3 * seconds, indent, of);
}

void show_use(const std::optional<CacheUse>& use, const char* of, const char* made) {
    if (use && use->from_cache + use->made > 0)
        std::cout << fmt::format("{:>11}  {} {}, {} from the cache\n", use->made, of, made, use->from_cache);
}

void show(const ReportResult& result) {
    double total = 0;
    for (const auto& [step, seconds] : result.timings) {
        show_time(seconds, step);
        total += seconds;
        if (step != kRunStep) continue;
        for (const auto& [cell, seconds_of_cell] : result.cells)
            if (seconds_of_cell >= kMinShownTime) show_time(seconds_of_cell, "cell " + cell, "  ");
    }
    show_time(total, "in total");
    show_use(result.long_calls, "long calls", "computed");
    show_use(result.figures, "figures", "drawn");
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    std::cout << fmt::format("{:>8.1f} MB  peak memory of dynlab itself\n", static_cast<double>(used.ru_maxrss) / 1024);
}

ReportResult make_showing_activity(ReportRequest& request) {
    ActivityLine activity;
    request.step = [&activity](const Message& step) { activity.begin_step(message_text(step, user())); };
    request.enter_cell = [&activity](const Message& cell) { activity.begin_part(message_text(cell, user())); };
    if (request.print)
        request.print = [&activity, print = std::move(request.print)](const std::string& text) {
            activity.print(text, print);
        };
    return make_report(request);
}

}  // namespace

int make_document(ReportRequest request, bool show_timings) {
    speak(request.script.header.language);
    const ReportResult result = make_showing_activity(request);
    const std::string file = std::filesystem::absolute(request.output).lexically_normal().string();
    if (result.error) complain(*result.error);
    if (!result.gaps.empty()) complain(Message("{}", MessageList{result.gaps, Join::kLines}));
    for (const Message& remark : result.notes) note(remark);
    for (const UnplacedEntries& entries : result.unplaced) note(entries.message());
    say(result.up_to_date      ? Message("{} (up to date)", file)
        : result.error         ? Message("{} (up to the error)", file)
        : !result.gaps.empty() ? Message("{} (draft: \"??\" marks the missing parts)", file)
                               : Message("{}", file));
    if (show_timings) show(result);
    return result.error || !result.gaps.empty() ? kFailed : kDone;
}

}  // namespace dynlab::inline cli
