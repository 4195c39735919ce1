#include <iostream>

#include "app/kernel/kernel.h"
#include "app/kernel/kernel_spec.h"
#include "cli/commands.h"
#include "platform/program_lookup.h"

namespace dynlab::inline cli {
namespace {

struct KernelArguments {
    std::string prefix, connection;
};

int install_it(const KernelArguments& args) {
    std::cout << install_kernel(kernels_folder(args.prefix), running_program()).string()
              << "\nNext: run jupyter notebook, and select New, dynlab (Lua).\n";
    return kDone;
}

int remove_it(const KernelArguments& args) {
    const auto folder = kernels_folder(args.prefix);
    if (remove_kernel(folder)) return kDone;
    std::cerr << "dynlab: no kernel of dynlab in " << folder.string() << '\n';
    return kFailed;
}

}  // namespace

void add_kernel(CLI::App& app, Action& action) {
    auto args = std::make_shared<KernelArguments>();
    CLI::App* command = app.add_subcommand("kernel", "Manage the Jupyter kernel of dynlab");
    command->require_subcommand(1);
    const auto add_one = [&](const char* name, const char* what, int (*work)(const KernelArguments&)) {
        CLI::App* one = command->add_subcommand(name, what);
        one->add_option("--prefix", args->prefix,
                        "Folder to install to, such as /usr/local for all users of the machine")
            ->type_name("DIR");
        one->callback([args, work, &action] { action = [args, work] { return work(*args); }; });
    };
    add_one("install", "Register the kernel with Jupyter", install_it);
    add_one("remove", "Remove the kernel from Jupyter", remove_it);
    CLI::App* run = command->add_subcommand("run", "Run the kernel (called by Jupyter)");
    run->add_option("FILE", args->connection, "Connection file written by Jupyter")->required();
    run->callback([args, &action] {
        action = [args] {
            serve_kernel(args->connection, DYNLAB_VERSION);
            return int(kDone);
        };
    });
    command->footer("Example:  dynlab kernel install\n          jupyter notebook\nMore: dynlab help guide-notebook");
}

}  // namespace dynlab::inline cli
