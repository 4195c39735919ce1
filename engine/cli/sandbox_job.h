#pragma once
#include <cstdint>
#include <iostream>
#include <iterator>
#include <string>

#include "course/sandbox_jobs/job_descriptions.h"
#include "course/sandbox_jobs/sandbox_work.h"

namespace dynlab::inline cli {

/// One piece of work on what is not trusted: a job on standard input, its result on standard output.
template <class Job>
void do_sandbox_job(typename Job::Result (*work)(const Job&)) {
    constexpr std::uint64_t kMaxJobBytes = 256u << 20;  // bytes: the answers of all runs, the files of checks
    const std::string bytes{std::istreambuf_iterator<char>(std::cin), {}};
    std::cout << cbor_of(work(from_cbor<Job>(bytes, sandbox_limits(kMaxJobBytes)))) << std::flush;
}

}  // namespace dynlab::inline cli
