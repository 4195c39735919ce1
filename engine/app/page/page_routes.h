#pragma once
#include <map>
#include <string>

#include "app/server/web_server.h"

namespace dynlab::inline app {

/// The files of our pages, of which `first` answers at the address itself, and what their scripts say in each language
/// (catalogs.js); the style of documents; the editor's files from where Debian's libjs-codemirror puts them.
void serve_page_files(WebServer& server, const std::string& first);
/// Scripts and styles of the pages of a site (workflow/site), by their place in it: page/NAME, sw.js, and the
/// workbench. Of two files with one name, that of engine/web/page counts. Without libjs-codemirror the editor is
/// missing.
std::map<std::string, std::string> page_files_of_site();
bool has_editor();  ///< whether that package is installed

}  // namespace dynlab::inline app
