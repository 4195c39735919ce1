#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "data_io/data_file.h"

namespace dynlab::inline data_io {

/// Finds and reads a data set or file. `name_or_path` is a name of data/ ("heat_exchanger"), a course file name
/// ("heatexchanger_data.mat", including the course's misspelled ones, with or without .mat) or a path to a file of a
/// kind that read_data_file() knows. A data set is a folder data/NAME with a SOURCE.md. A line `Course file: NAME.mat`
/// there (several separated by commas) lists the names under which a course knows the data set. Only this line defines
/// such names; they are names of files in that folder, never paths. The search order is `script_folder` (NAME.mat,
/// NAME.csv, data/NAME), then data/NAME of the current folder, then the installed data. Within a data set's folder a
/// course's original file is preferred, then NAME.csv (which states units), then NAME.mat, then the file of a Debian
/// package (packaged_data.h) according to a line `Package: NAME FILE SAMPLES samples TS s` of SOURCE.md, which is
/// valid in the installed data only. `graded`: data sets of the installed data win over files next to the script, also
/// if a path below data/ names them, and a link that leads out of `script_folder` is refused. Files of the installed
/// data are read without guard. Throws EnvironmentError that suggests the nearest data
/// set or file of the script's folder, or lists the data sets if none is near.
LoadedData load_data(const std::string& name_or_path, const std::filesystem::path& script_folder, bool graded = false,
                     const ImportOptions& options = {});

/// Describes a data set in its folder: origin, signals, units.
inline constexpr char kSourceFile[] = "SOURCE.md";

/// The refusal to read files of others where scripts are graded.
Message refusal_outside(const std::string& file);
/// Whether a message is that refusal or quotes it.
bool is_refusal_outside(const Message& message);

/// Names of the data sets in the installed data/, sorted.
std::vector<std::string> dataset_names();

/// The Debian package an installed data set is read from, when that package's file is not there.
std::optional<std::string> missing_package(const std::string& name);

}  // namespace dynlab::inline data_io
