#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "data_io/data_file.h"

namespace dynlab::inline data_io {

/// Finds and reads a data set or file. `name_or_path` is a name of data/ ("heat_exchanger"), a course file name
/// ("heatexchanger_data.mat", misspelled ones of the course too, with or without .mat) or a path to a file of
/// a kind that read_data_file() knows. A data set is a folder data/NAME with a SOURCE.md; a line `Course file:
/// NAME.mat` there (several separated by commas) says under which names a course knows it, and that is the only place
/// where such names stand; they are names of files in that folder, never paths. Looked for in `script_folder`
/// (NAME.mat, NAME.csv, data/NAME), then in data/NAME of the current folder, then in the installed data. Within a data
/// set's folder a course's original file is preferred, then NAME.csv (which states units), then NAME.mat, then what a
/// Debian package brings (packaged_record.h) according to a line `Package: NAME FILE SAMPLES samples TS s` of
/// SOURCE.md, which is believed in the installed data only. `graded`: data sets of the installed data win over files
/// beside the script, also when they are named by a path below data/, and a link that leads out of `script_folder` is
/// refused. Files of the installed data are read without guard. Throws EnvironmentError that lists the names that exist
/// and suggests the nearest one.
LoadedData load_data(const std::string& name_or_path, const std::filesystem::path& script_folder, bool graded = false,
                     const ImportOptions& options = {});

/// Tells of a data set in its folder: origin, signals, units.
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
