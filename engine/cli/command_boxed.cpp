#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "course/grading/boxed_document.h"
#include "course/grading/check_run.h"
#include "course/grading/graded_run.h"
#include "course/grading/unpack.h"
#include "course/review/version_reading.h"

namespace dynlab::inline cli {
namespace {

/// One piece of work on what is not trusted: a job as JSON on standard input, its result as JSON on standard output.
int boxed() {
    const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
    const nlohmann::json job = nlohmann::json::parse(text);
    const std::string work = job.at("work");
    nlohmann::json result;
    if (work == "run")
        result = run_for_grading(job);
    else if (work == "checks")
        result = try_checks(job);
    else if (work == "unpack")
        result = unpack_archive(job);
    else if (work == "document")
        result = make_boxed_document(job);
    else if (work == "version")
        result = make_version(job);
    else
        return kUsage;
    std::cout << result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::flush;
    return kDone;
}

}  // namespace

void add_boxed(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("boxed", "What grade does inside a box; not for people")->group("");
    command->callback([&action] { action = boxed; });
}

}  // namespace dynlab::inline cli
