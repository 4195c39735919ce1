#pragma once
#include <string>

#include "app/server/web_server.h"

namespace dynlab::inline app {

/// The files of our pages, of which `first` answers at the address itself, and what their scripts say in each language
/// (catalogs.js); the style of documents; the editor's files from where Debian's libjs-codemirror puts them.
void serve_page_files(WebServer& server, const std::string& first);
bool has_editor();  ///< whether that package is installed

}  // namespace dynlab::inline app
