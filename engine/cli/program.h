#pragma once
#include <string>

#include "cli/commands.h"

namespace dynlab::inline cli {

/// One of the programs that together are dynlab (platform/program_lookup.h): what its command line can be.
class Program {
  public:
    /// `view` is called for each --view.
    Program(const Commands& commands, FigureView view);
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    bool has_command(const std::string& name) const;
    /// Does what the words of main() ask for; what goes wrong is one line on standard error. Returns the exit code.
    int run(int count, char** args);

  private:
    CLI::App app_{"dynlab runs a laboratory course on data-driven learning of dynamical systems.", "dynlab"};
    Action action_;
    FigureView view_;
    bool shows_figures_ = false;
};

/// Continues as another of dynlab's programs with the arguments of main(). Where that program is missing, prints the
/// command that builds it and exits with kMissingProgram.
[[noreturn]] void go_on_as(const std::string& program, char** args);

}  // namespace dynlab::inline cli
