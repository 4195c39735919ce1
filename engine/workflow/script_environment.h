#pragma once
#include "scripting/interpreter/runtime.h"
#include "scripting/runtime/services.h"
#include "workflow/run_script.h"

namespace dynlab::inline workflow {

/// What a script of a request runs in: its functions and their services. The request's `written` must outlive it.
struct ScriptEnvironment {
    ReportLanguage language;
    SliderValues sliders;
    Runtime runtime;

    ScriptEnvironment(const RunRequest& request, GnuplotRenderer& renderer);
    ScriptEnvironment(const ScriptEnvironment&) = delete;
    ScriptEnvironment& operator=(const ScriptEnvironment&) = delete;
};

}  // namespace dynlab::inline workflow
