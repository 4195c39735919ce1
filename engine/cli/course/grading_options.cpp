#include "cli/course/grading_options.h"

#include <algorithm>
#include <thread>

#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/program_lookup.h"

namespace dynlab::inline cli {

CLI::Option* add_secret_option(CLI::App& command, std::string& secret) {
    return command.add_option("--secret", secret, "File that determines the hidden data sets")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
}

CLI::Option* add_timeout_option(CLI::App& command, int& seconds) {
    return command
        .add_option("--timeout", seconds,
                    "Processor time of each run of a script, in seconds; the elapsed time may be 20 times as long")
        ->type_name("S")
        ->capture_default_str()
        ->check(CLI::Range(1, 3600));
}

GradingSetup trial_setup(const Lesson& lesson, const std::string& secret, int timeout_seconds) {
    GradingSetup setup;
    setup.lesson = lesson;
    setup.isolation = strongest_isolation();
    setup.time.processor = std::chrono::seconds(timeout_seconds);
    setup.program = running_program();
    setup.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (!secret.empty()) setup.secret = read_file(secret);
    if (const Cache cache; cache.lasting()) setup.call_memory = cache.root();
    return setup;
}

}  // namespace dynlab::inline cli
