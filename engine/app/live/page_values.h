#pragma once
#include <map>
#include <string>
#include <utility>

#include "scripting/runtime/function_entry.h"

namespace dynlab::inline app {

/// What page_functions() work on: what a script gives the page that runs it, by names, each as JSON.
class PageValues {
  public:
    bool decimal_comma = false;  ///< numbers and sentences are written as French writes them
    void show(const std::string& name, std::string json) { shown_[name] = std::move(json); }
    std::map<std::string, std::string> take() { return std::exchange(shown_, {}); }

  private:
    std::map<std::string, std::string> shown_;
};

/// `workbench.show(name, value)`: numbers (null for what is not finite), texts, true and false, vectors, matrices
/// (rows), tables (a list where the keys are 1, 2, ...), and figures as documents/html/plot_data.h says.
/// Where the document is French, texts called "words" and "error" are told in French.
FunctionEntries page_functions();

}  // namespace dynlab::inline app
