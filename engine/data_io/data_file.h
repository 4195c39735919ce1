#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "data_io/tables/import_options.h"
#include "data_io/variable.h"

namespace dynlab::inline data_io {

/// A loaded data set: its variables, the file they came from, and what else the file says of them. Columns of a table
/// are Vectors, text columns lists of strings, a stated sampling time the number Ts.
struct LoadedData {
    VariableTable variables;
    std::filesystem::path file;
    std::map<std::string, std::string> units = {};  ///< by variable
    std::map<std::string, std::string> headers =
        {};                                 ///< of a table's file, where a column has another name -> its name
    std::vector<std::string> columns = {};  ///< of a table, in the file's order
    Index rows = 0;                         ///< of a table
    std::vector<Message> notes = {};        ///< sentences that the user should see: what was left out, what was guessed
};

/// Whether the name's ending is one of those that read_data_file() knows.
bool is_data_file(const std::filesystem::path& file);

/// Reads a .mat or .json file (json_file.h), or a table in a .csv, .tsv, .txt or .dat file (csv_file.h) or a sheet of
/// an .xlsx workbook (workbook.h). With `options.time` the variable of that name must hold increasing instants: in
/// seconds they become the variable t, and their distance, where it is even, Ts. `guarded`: as read_mat_file(). Throws
/// EnvironmentError as the readers do, for a file of another kind, a time that does not increase, and an option that
/// the kind does not know.
LoadedData read_data_file(const std::filesystem::path& file, bool guarded, const ImportOptions& options = {});

struct TimeColumn {
    std::string name;
    double seconds = 1;  ///< that its unit stands for
};
/// The vector of `samples` numbers that is most likely the time: called t or time (also t_ms, Time), else the only one
/// whose unit is one of time.
std::optional<TimeColumn> time_column(const LoadedData& data, Index samples);

/// How instants follow each other.
struct InstantSpacing {
    double step = 0;               ///< mean distance where it is even, else the median; in the unit of the instants
    bool even = false;             ///< no distance differs from the mean by more than 0.1 %
    std::vector<Index> gaps = {};  ///< i: from instant i to the next it is more than 1.5 times the step
    std::optional<Index> disorder = {};  ///< first i whose next instant is not later; then nothing else is told
};
/// Of at least two instants.
InstantSpacing spacing_of(const Vector& instants);

}  // namespace dynlab::inline data_io
