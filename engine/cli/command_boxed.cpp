#include <iostream>
#include <iterator>
#include <memory>

#include "cli/commands.h"
#include "course/grading/boxed_work.h"
#include "course/grading/job_descriptions.h"

namespace dynlab::inline cli {
namespace {

constexpr std::uint64_t kMostOfJob = 256u << 20;  // bytes: the answers of all runs, the files of checks

/// One piece of work on what is not trusted: a job on standard input, its result on standard output.
template <class Job>
void work(typename Job::Result (*function)(const Job&)) {
    const std::string bytes{std::istreambuf_iterator<char>(std::cin), {}};
    std::cout << cbor_of(function(from_cbor<Job>(bytes, boxed_limits(kMostOfJob)))) << std::flush;
}

int boxed(const std::string& name) {
    if (name == RunJob::kWork)
        work(run_for_grading);
    else if (name == ChecksJob::kWork)
        work(try_checks);
    else if (name == UnpackJob::kWork)
        work(unpack_archive);
    else if (name == DocumentJob::kWork)
        work(make_boxed_document);
    else if (name == VersionJob::kWork)
        work(make_version);
    else
        return kUsage;
    return kDone;
}

}  // namespace

void add_boxed(CLI::App& app, Action& action) {
    CLI::App* command = app.add_subcommand("boxed", "What grade does inside a box; not for people")->group("");
    const auto name = std::make_shared<std::string>();
    command->add_option("work", *name, "run, checks, unpack, document or version")->required();
    command->callback([&action, name] { action = [name] { return boxed(*name); }; });
}

}  // namespace dynlab::inline cli
