#pragma once
#include <string>
#include <vector>

#include "documents/run_record.h"

namespace dynlab::inline course {

/// A value, an answer or the cell of a table that differs between two runs.
struct ValueChange {
    std::string name;           ///< "fit", or of a table "models: SRIVC, fit (%)"
    std::string before, after;  ///< as documents show them; empty where there is none
};

struct ValueChanges {
    std::vector<ValueChange> changed;
    std::size_t compared = 0;  ///< entries of both runs together
};

/// Rows of tables belong together by their first cell.
ValueChanges value_changes(const RunRecord& before, const RunRecord& after);

}  // namespace dynlab::inline course
