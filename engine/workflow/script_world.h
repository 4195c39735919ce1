#pragma once
#include "scripting/interpreter/runtime.h"
#include "scripting/runtime/services.h"
#include "workflow/run_script.h"

namespace dynlab::inline workflow {

/// What a script of a request runs in: its functions and their services. The request's `written` must outlive it.
struct ScriptWorld {
    ReportLanguage language;
    SliderValues sliders;
    Runtime runtime;

    ScriptWorld(const RunRequest& request, GnuplotRenderer& renderer);
    ScriptWorld(const ScriptWorld&) = delete;
    ScriptWorld& operator=(const ScriptWorld&) = delete;
};

}  // namespace dynlab::inline workflow
