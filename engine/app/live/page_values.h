#pragma once
#include <map>
#include <string>
#include <utility>

#include "base/reader.h"
#include "scripting/runtime/function_entry.h"

namespace dynlab::inline app {

/// What page_functions() work on: what a script gives the page that runs it, by names, each as JSON.
class PageValues {
  public:
    Reader reader;  ///< of the document
    void show(const std::string& name, std::string json) { shown_[name] = std::move(json); }
    std::map<std::string, std::string> take() { return std::exchange(shown_, {}); }

  private:
    std::map<std::string, std::string> shown_;
};

/// `workbench.show(name, value)`: numbers (null for what is not finite), texts, true and false, vectors, matrices
/// (rows), tables (a list where the keys are 1, 2, ...), and figures as documents/html/plot_data.h says.
/// Texts called "error" are what pcall gave, and are shown in the document's language.
/// `workbench.label(name)`: a text for the page's own figures.
FunctionEntries page_functions();

}  // namespace dynlab::inline app
