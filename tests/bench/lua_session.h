#pragma once
#include <string>

#include "figures/gnuplot_renderer.h"
#include "numerics/linalg/types.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/memoized_calls/memoized_call.h"

namespace dynlab::bench {

/// A Lua state as `dynlab run` makes it, in which a user's lines are run one after the other. What they save, and what
/// is kept of long calls, lies in a folder that goes with the object.
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
