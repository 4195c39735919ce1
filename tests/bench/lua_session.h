#pragma once
#include <string>

#include "figures/gnuplot_renderer.h"
#include "numerics/linalg/types.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"

namespace dynlab::bench {

/// A Lua state as `dynlab run` makes it, which runs a user's lines in sequence. Saved files and cached long calls are
/// in a folder that the destructor removes.
class LuaSession {
  public:
    LuaSession();
    void run(const std::string& line);              ///< throws std::runtime_error with the script's error
    void clear_results();                           ///< of long calls, so that each is a first one
    Vector numbers(const std::string& expression);  ///< of a vector

  private:
    static Cache cache_below(const std::filesystem::path& folder);
    RunOptions options();

    TemporaryFolder folder_;
    Cache cache_{cache_below(folder_.path())};
    CallCache calls_{cache_};
    GnuplotRenderer renderer_;
    Runtime runtime_;
};

}  // namespace dynlab::bench
