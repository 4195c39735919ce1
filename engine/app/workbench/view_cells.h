#pragma once
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data_io/values/described.h"

namespace dynlab::inline app {

inline constexpr const char* kViewCell = "workbench-views";
inline constexpr const char* kSlowViewCell = "workbench-slow-views";

template <class Names>
bool is_one_of(const nlohmann::json& name, const Names& names) {
    return std::any_of(std::begin(names), std::end(names), [&](const char* one) { return name == one; });
}

/// Views that the page requests in addition to the script. draw_workbench of views.lua gets this order.
struct ViewOrder {
    std::vector<std::string> variables;  ///< variables of the script whose values the page shows
    std::string settings;                ///< JSON: which views, of which variables, and how
    int data_until = 0;                  ///< the last line of the script on which the shown data sets depend
};
DYNLAB_DESCRIBE(ViewOrder, variables, settings, data_until)

/// Cells after a session's script: they pass its variables and the settings to views.lua, which runs before the script,
/// the quick views first.
/// Throws ValueError for invalid names and for settings that are not JSON.
std::string view_cells(const ViewOrder& order);

}  // namespace dynlab::inline app
