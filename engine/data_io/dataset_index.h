#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "data_io/variable.h"

namespace dynlab {

/// A loaded data set: its variables, the file they came from, and the units a CSV file states.
struct LoadedData {
    VariableTable variables;
    std::filesystem::path file;
};

/// Finds and reads a data set or file. `name_or_path` is a name of data/ ("heat_exchanger"), a course file
/// name
/// ("heatexchanger_data.mat", misspelled ones of the course too) or a path to a .mat or .csv file. Looked for
/// in `script_folder`, then in data/NAME of the current project, then in the installed data. Within a data
/// set's folder a course's original .mat is preferred over dynlab's own record. Throws EnvironmentError that
/// lists the names that exist and suggests the nearest one.
LoadedData load_data(const std::string& name_or_path, const std::filesystem::path& script_folder);

/// Names of the data sets in data/, sorted.
std::vector<std::string> dataset_names();

}  // namespace dynlab
