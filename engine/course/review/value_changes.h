#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dynlab::inline course {

/// A value or the cell of a table in a run record that is not what it was.
struct ValueChange {
    std::string name;           ///< "fit", or of a table "models: SRIVC, fit (%)"
    std::string before, after;  ///< as documents show them; empty where there was none
    std::string change;         ///< "+12.5 %", "new", "gone", or "other text"
};

struct ValueChanges {
    std::vector<ValueChange> changed;
    int compared = 0;  ///< values and cells of both records together
};

/// Compares two run records (documents/run_record.h, to_json). Rows of tables belong together by their first cell.
ValueChanges value_changes(const nlohmann::json& before, const nlohmann::json& after);

}  // namespace dynlab::inline course
