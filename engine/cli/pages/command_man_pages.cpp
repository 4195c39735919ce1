#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/pages/manual_page.h"
#include "platform/atomic_file.h"

namespace dynlab::inline cli {
namespace {

/// FOLDER/dynlab.1 and a page for each command.
int write_pages(const CLI::App& program, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const auto write = [&](const CLI::App& command, const std::string& name) {
        write_file_atomically(folder / (name + ".1"), manual_page(command, name, program.version()));
    };
    write(program, program.get_name());
    for (const CLI::App* command :
         program.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
        write(*command, program.get_name() + "-" + command->get_name());
    return kDone;
}

}  // namespace

void add_man_pages(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("man-pages", "Internal: write the manual pages of man(1), for packages")->group("");
    const auto folder = std::make_shared<std::string>();
    command->add_option("folder", *folder, "Output folder")->required();
    command->callback([&app, &action, folder] { action = [&app, folder] { return write_pages(app, *folder); }; });
}

}  // namespace dynlab::inline cli
