#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "data_io/clock.h"
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
        {};                                         ///< of a table's file, where a column has another name -> its name
    std::vector<std::string> columns = {};          ///< of a table, in the file's order
    Index rows = 0;                                 ///< of a table
    std::map<std::string, ClockForms> clocks = {};  ///< of a table's columns of times: seconds since midnight or 1970
    ClockSearch time = {};                          ///< of the usual_length()
    std::vector<Message> notes = {};                ///< messages for the user: what was omitted, what was assumed
};

/// Whether the name's ending is one of those that read_data_file() knows.
bool is_data_file(const std::filesystem::path& file);

/// Reads a .mat or .json file (json_file.h), or a table in a .csv, .tsv, .txt, .dat or .lvm file (csv_file.h) or a
/// sheet of an .xlsx workbook (workbook.h). find_clock() looks for the time, whose notes come first. With
/// `options.time` the instants become the variable t in seconds (or their own column, where another is called t), and
/// their distance, where it is even, Ts. Rows of a table that repeat the row before them, time and all, are left out.
/// `guarded`: as read_mat_file(). Throws EnvironmentError as the readers do, for a file of another kind, an
/// `options.time` that gives no clock, and an option that the kind does not know.
LoadedData read_data_file(const std::filesystem::path& file, bool guarded, const ImportOptions& options = {});

/// Makes the clock that was found the variables t and Ts, as `options.time` does.
void use_clock(LoadedData& data);

/// The length of most vectors of a file, the longer one where two are as frequent.
Index usual_length(const LoadedData& data);

}  // namespace dynlab::inline data_io
