#pragma once
#include <string>

#include "figures/gnuplot_renderer.h"
#include "numerics/linalg/types.h"
#include "platform/temporary_folder.h"
#include "scripting/runtime/runtime.h"
#include "workflow/caches.h"

namespace dynlab::bench {

/// A Lua state as `dynlab run` makes it, in which a user's lines are run one after the other. What they save lies in a
/// folder that goes with the object.
class LuaSession {
  public:
    LuaSession();
    void run(const std::string& line);              ///< throws std::runtime_error with the script's error
    Vector numbers(const std::string& expression);  ///< of a vector

  private:
    RunOptions options();

    TemporaryFolder folder_;
    Caches memories_;
    GnuplotRenderer renderer_;
    Runtime runtime_;
};

}  // namespace dynlab::bench
