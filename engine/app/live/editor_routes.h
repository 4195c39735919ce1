#pragma once
#include "app/live/live_document.h"
#include "app/live/live_page.h"
#include "app/live/script_runner.h"
#include "app/live/source_files.h"
#include "app/server/web_server.h"

namespace dynlab::inline app {

/// Serves the requests of the page's editor while the user types, by POST: completion and help from the functions and
/// the state of the executed part of the script, its variables, mistakes in a text, and the run of a cell.
void serve_editor(WebServer& server, ScriptRunner& runner, LiveDocument& document, LivePage& page,
                  SourceFiles& sources);

}  // namespace dynlab::inline app
