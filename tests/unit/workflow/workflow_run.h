#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "figures/gnuplot_renderer.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"
#include "support/environment_variable.h"
#include "workflow/run_script.h"

namespace dynlab::test {

struct ScriptRun {
    RunRecord record;
    std::string printed;
};

/// A folder for scripts and their data, and a cache that is empty when the test starts.
class WorkFolder {
  public:
    std::filesystem::path path(const std::string& name = "") const { return folder_.path() / "work" / name; }
    std::filesystem::path cache() const { return folder_.path() / "cache/dynlab"; }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories(path(name).parent_path());
        write_file_atomically(path(name), text);
    }
    std::string read(const std::string& name) const { return read_file(path(name)); }
    /// Runs code as a script of this folder, which saves its files beside itself.
    ScriptRun run(const std::string& code, const std::string& name = "script.lua") const {
        return run(parse_percent_script(code, path(name)));
    }
    ScriptRun run(const PercentScript& script) const {
        ScriptRun run;
        GnuplotRenderer renderer;
        RunRequest request;
        request.script = script;
        request.out_folder = path();
        request.print = [&run](const std::string& text) { run.printed += text; };
        run.record = run_script(request, renderer);
        renderer.finish();
        return run;
    }

    WorkFolder() { std::filesystem::create_directories(path()); }

  private:
    TemporaryFolder folder_;
    EnvironmentVariable cache_home_{"XDG_CACHE_HOME", (folder_.path() / "cache").string()};
    EnvironmentVariable no_cache_{"DYNLAB_NO_CACHE", std::nullopt};
};

/// The message of the exception that `call` throws; empty when it throws none.
template <class Call>
std::string error_of(Call call) {
    try {
        call();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace dynlab::test
