#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "documents/run_record.h"

namespace dynlab::inline course {

/// What a run record shows, as far as it can be compared.
struct ShownRecord {
    std::map<std::string, RecordedValue> values;
    std::map<std::string, RecordedTable> tables;
    bool failed = false;  ///< the run ended with an error
};

/// Of the JSON text of a run record (documents/run_record.h, to_json) from anybody: what has another form than ours is
/// left out. Nothing where the text is no JSON object.
std::optional<ShownRecord> shown_record(const std::string& json);

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

/// Compares two run records. Rows of tables belong together by their first cell.
ValueChanges value_changes(const ShownRecord& before, const ShownRecord& after);

}  // namespace dynlab::inline course
