#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "data_io/values/described.h"

namespace dynlab::inline app {

/// A signal of a data file as it is offered.
struct DataColumn {
    std::string name, unit;
    std::string role;  ///< what it probably is: "input", "output", "time" or ""
    double smallest = 0, largest = 0;
    std::string trouble;  ///< "text", "constant", "3 of 200 values", "3 missing"; else empty
    bool usable = true;   ///< as a signal: a constant input may be a step from zero
};
DYNLAB_DESCRIBE(DataColumn, name, unit, role, smallest, largest, trouble, usable)

/// A data file as it is offered: which column is what, how it is sampled.
struct DataChoice {
    std::string data;  ///< file or data set, as load() takes it
    std::vector<DataColumn> columns;
    std::string look;  ///< what `dynlab inspect` says
};
DYNLAB_DESCRIBE(DataChoice, data, columns, look)

/// Summarizes `data`, a file or a data set. With false as the second argument, `look` stays empty. Throws
/// EnvironmentError as load_data() does.
DataChoice describe_data(const std::string& data, bool with_summary = true);

/// What was chosen of it.
struct DataSelection {
    std::string data;
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;
    std::string time;                          ///< none when empty
    double Ts = 0;                             ///< s; 0: as the file says
    std::string name;                          ///< of the variable for the data
    std::map<std::string, std::string> units;  ///< of signals, instead of the file's
};
DYNLAB_DESCRIBE(DataSelection, data, inputs, outputs, time, Ts, name, units)

/// The lines that load it: `NAME_file = load(...)`, `NAME = iddata(...)`. Throws EnvironmentError as Recording, and for
/// a name that no variable can have, no input or no output.
std::string loading_lines(const DataSelection& order);
/// The same, with advice for the user of the page about a file without a sampling time.
std::string loading_lines_for_page(const DataSelection& order);

/// The order that the roles of a choice's columns suggest. Throws EnvironmentError where there are no two signals.
DataSelection suggested_order(const DataChoice& choice);

/// Returns the script with the data set of the order; `lines` is the result of loading_lines(). The lines replace those
/// of its cell "record" if that cell assigns the data set's name, else they form a separate cell after it. A script
/// without any code becomes that of a new session.
std::string with_data(const std::string& script, const DataSelection& order, const std::string& lines);

/// Throws EnvironmentError for control characters in the name of a file, by which it might end a line of the script.
void expect_plain_name(const std::string& name);

/// The name of a file that is dropped on the page, without folders. Throws EnvironmentError as expect_plain_name(), and
/// for a name that is not that of a data file.
std::filesystem::path name_of_data_file(const std::string& requested);

/// The script of a new session; `lines` of loading_lines() for the name "data", or empty.
std::string new_session(const std::string& title, const std::string& lines, const std::string& language);

}  // namespace dynlab::inline app
