#include "cli/course/share_options.h"

namespace dynlab::inline cli {

void add_share_options(CLI::App& command, std::string& on, std::string& spool, int& lease) {
    CLI::Option* const where =
        command
            .add_option("--on", on,
                        "Who does the work: processes:N, parallel:N/HOST,HOST by ssh, or slurm[:tasks=N,partition=P,"
                        "...]; dynlab help guide-cluster")
            ->type_name("WHERE");
    command.add_option("--spool", spool, "Folder that all these machines see; else in the folder of results")
        ->type_name("FOLDER")
        ->needs(where);
    command
        .add_option("--lease", lease, "Seconds without a sign of life after which a worker's job is given to another")
        ->type_name("S")
        ->capture_default_str()
        ->check(CLI::Range(2, 3600))
        ->needs(where);
}

}  // namespace dynlab::inline cli
