#include "app/workbench/view_cells.h"

#include <fmt/format.h>

#include "data_io/values/json_values.h"
#include "data_io/values/value_limits.h"
#include "documents/lua_text.h"
#include "documents/text_lines.h"

namespace dynlab::inline app {
namespace {

using nlohmann::json;

constexpr const char* kSlowViews[] = {"spectrum", "correlation", "advice"};

/// A value of JSON as Lua writes it.
std::string lua_of(const json& value) {
    if (value.is_string()) return lua_text(value.get<std::string>());
    if (value.is_null()) return "nil";
    if (!value.is_structured()) return value.dump();
    std::string text = "{";
    for (const auto& [key, item] : value.items()) {
        if (value.is_object()) text += "[" + lua_text(key) + "] = ";
        text += lua_of(item) + ", ";
    }
    return text + "}";
}

}  // namespace

std::string view_cells(const ViewOrder& order) {
    json quick = parsed_json(order.settings);
    if (!quick.is_object()) throw ValueError("the view settings must be a JSON object");
    std::string variables;
    for (const std::string& name : order.variables) {
        if (!is_name(name) || name.find('-') != std::string::npos)
            throw ValueError("'{}' is not a valid name of a variable", name);
        variables += fmt::format("{0} = value_or_nil(function() return {0} end), ", name);
    }
    const json views = quick.value("views", json::array());
    json slow = quick;
    quick["views"] = slow["views"] = json::array();
    for (const json& view : views) (is_one_of(view, kSlowViews) ? slow : quick)["views"].push_back(view);
    slow.erase("save");
    const auto cell = [&](const char* id, const json& settings) {
        return fmt::format("\n-- %% id={}\ndraw_workbench({}, {{{}}})\n", id, lua_of(settings), variables);
    };
    return cell(kViewCell, quick) + (slow["views"].empty() ? "" : cell(kSlowViewCell, slow));
}

}  // namespace dynlab::inline app
