#include "data_io/dataset_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

#include "data_io/csv_file.h"
#include "data_io/mat_file.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/spelling.h"

namespace dynlab {
namespace {

namespace fs = std::filesystem;

constexpr char kSourceFile[] = "SOURCE.md";
constexpr char kCourseFileKey[] = "Course file:";

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

std::string lower_case_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension;
}
bool is_mat(const fs::path& file) {
    return lower_case_extension(file) == ".mat";
}
bool is_csv(const fs::path& file) {
    return lower_case_extension(file) == ".csv";
}

/// Folders that hold data sets, in the order in which they are searched.
std::vector<fs::path> data_folders(const fs::path& script_folder) {
    return {script_folder / "data", fs::current_path() / "data", shared_folder() / "data"};
}

/// The data set folders in one data folder, sorted by name.
std::vector<fs::path> data_sets_in(const fs::path& data_folder) {
    std::vector<fs::path> sets;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(data_folder, error)) {
        if (is_file(entry.path() / kSourceFile)) sets.push_back(entry.path());
    }
    std::sort(sets.begin(), sets.end());
    return sets;
}

/// The names after "Course file:" in a data set's SOURCE.md.
std::vector<std::string> course_files(const fs::path& data_set) {
    std::ifstream source(data_set / kSourceFile);
    std::vector<std::string> names;
    for (std::string line; std::getline(source, line);) {
        if (line.rfind(kCourseFileKey, 0) != 0) continue;
        std::string list = line.substr(sizeof kCourseFileKey - 1);
        std::replace(list.begin(), list.end(), ',', ' ');
        std::istringstream words(list);
        for (std::string name; words >> name;) names.push_back(name);
    }
    return names;
}

/// The file of a data set to read; nothing when its folder holds none.
std::optional<fs::path> file_of(const fs::path& data_set) {
    std::vector<fs::path> candidates;
    for (const std::string& name : course_files(data_set)) candidates.push_back(data_set / name);
    const std::string name = data_set.filename().string();
    candidates.push_back(data_set / (name + ".csv"));
    candidates.push_back(data_set / (name + ".mat"));
    const auto found = std::find_if(candidates.begin(), candidates.end(), is_file);
    return found == candidates.end() ? std::nullopt : std::optional<fs::path>(*found);
}

bool is_course_name(const fs::path& data_set, const std::string& name) {
    const std::vector<std::string> names = course_files(data_set);
    return std::any_of(names.begin(), names.end(), [&](const std::string& course_name) {
        return course_name == name || fs::path(course_name).stem() == name;
    });
}

/// A data set called `name`, a course file of that name, or a file of that name in a data set's folder.
std::optional<fs::path> file_in_data_folder(const fs::path& data_folder, const std::string& name) {
    if (is_file(data_folder / name / kSourceFile)) return file_of(data_folder / name);
    for (const fs::path& data_set : data_sets_in(data_folder)) {
        if (is_file(data_set / name) && (is_mat(name) || is_csv(name))) return data_set / name;
        if (is_course_name(data_set, name)) return file_of(data_set);
    }
    return std::nullopt;
}

std::optional<fs::path> file_beside(const fs::path& script_folder, const std::string& name) {
    if (is_mat(name) || is_csv(name)) {
        return is_file(script_folder / name) ? std::optional<fs::path>(script_folder / name) : std::nullopt;
    }
    for (const char* extension : {".mat", ".csv"}) {
        if (is_file(script_folder / (name + extension))) return script_folder / (name + extension);
    }
    return std::nullopt;
}

[[noreturn]] void fail_unknown(const std::string& name, const fs::path& script_folder) {
    std::vector<std::string> known = dataset_names();
    std::string message = fmt::format("there is no data set \"{}\"", name);
    if (const auto nearest = nearest_word(fs::path(name).stem().string(), known)) {
        message += fmt::format(", did you mean \"{}\"?", *nearest);
    } else {
        message += ";";
    }
    message +=
        known.empty() ? " no data sets are installed" : fmt::format(" the data sets are {}", fmt::join(known, ", "));
    throw EnvironmentError(
        fmt::format("{}; files of your own are looked for in {}", message, fs::absolute(script_folder).string()));
}

fs::path find_data_file(const std::string& name_or_path, const fs::path& script_folder) {
    const fs::path path = name_or_path;
    if (path.has_parent_path()) {
        const fs::path file = script_folder / path;
        if (!is_file(file)) throw EnvironmentError(fmt::format("there is no file {}", fs::absolute(file).string()));
        return file;
    }
    if (const auto file = file_beside(script_folder, name_or_path)) return *file;
    for (const fs::path& data_folder : data_folders(script_folder)) {
        if (const auto file = file_in_data_folder(data_folder, name_or_path)) return *file;
    }
    fail_unknown(name_or_path, script_folder);
}

/// Whether the file ships with dynlab, so that its maker is known.
bool is_installed_data(const fs::path& file) {
    const fs::path folder = fs::weakly_canonical(shared_folder() / "data"), inside = fs::weakly_canonical(file);
    return std::mismatch(folder.begin(), folder.end(), inside.begin(), inside.end()).first == folder.end();
}

LoadedData from_csv(CsvTable table) {
    LoadedData data;
    for (std::size_t i = 0; i < table.names.size(); ++i) {
        const std::string& name = table.names[i];
        const auto texts = table.texts.find(name);
        if (texts == table.texts.end()) {
            data.variables[name] = {std::move(table.columns[i])};
            continue;
        }
        auto list = std::make_shared<VariableList>();
        for (std::string& text : texts->second) list->push_back({std::move(text)});
        data.variables[name] = {std::move(list)};
    }
    if (table.Ts) data.variables.insert({"Ts", {*table.Ts}});  // a column of that name comes first
    data.units = std::move(table.units);
    return data;
}

}  // namespace

LoadedData load_data(const std::string& name_or_path, const fs::path& script_folder) {
    const fs::path file = find_data_file(name_or_path, script_folder);
    LoadedData data;
    if (is_mat(file)) {
        data.variables = read_mat_file(file, !is_installed_data(file));
    } else if (is_csv(file)) {
        data = from_csv(read_csv_file(file));
    } else {
        throw EnvironmentError(fmt::format("{} is neither a .mat nor a .csv file", file.string()));
    }
    data.file = file;
    return data;
}

std::vector<std::string> dataset_names() {
    std::vector<std::string> names;
    for (const fs::path& data_set : data_sets_in(shared_folder() / "data")) {
        names.push_back(data_set.filename().string());
    }
    return names;
}

}  // namespace dynlab
