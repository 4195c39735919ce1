#include "data_io/dataset_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <variant>

#include "data_io/packaged_data.h"
#include "platform/error.h"
#include "platform/program_lookup.h"
#include "platform/spelling.h"

namespace dynlab::inline data_io {
namespace {

namespace fs = std::filesystem;

constexpr char kCourseFileKey[] = "Course file:";
constexpr char kPackageKey[] = "Package:";

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
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

/// The words after `key`, separated by blanks and commas, in the lines of a data set's SOURCE.md that begin with it.
std::vector<std::string> words_after(const std::string& key, const fs::path& data_set) {
    std::ifstream source(data_set / kSourceFile);
    std::vector<std::string> words;
    for (std::string line; std::getline(source, line);) {
        if (line.rfind(key, 0) != 0) continue;
        std::string list = line.substr(key.size());
        std::replace(list.begin(), list.end(), ',', ' ');
        std::istringstream stream(list);
        for (std::string word; stream >> word;) words.push_back(word);
    }
    return words;
}

/// Whether `path`, links resolved, is `folder` or lies below it.
bool lies_in(const fs::path& folder, const fs::path& path) {
    const fs::path whole = fs::weakly_canonical(folder), inside = fs::weakly_canonical(path);
    return std::mismatch(whole.begin(), whole.end(), inside.begin(), inside.end()).first == whole.end();
}

/// Whether the path belongs to what ships with dynlab, so that its maker is known.
bool is_installed_data(const fs::path& path) {
    return lies_in(shared_folder() / "data", path);
}

/// Names of files in the data set's folder. The author of a submitted data set must not name files outside it.
std::vector<std::string> course_files(const fs::path& data_set) {
    std::vector<std::string> names = words_after(kCourseFileKey, data_set);
    for (const std::string& name : names)
        if (fs::path(name).has_parent_path())
            throw EnvironmentError(
                "{}: \"{}\" must be followed by names of files in the folder of the data set, but the path \"{}\" was "
                "given",
                (data_set / kSourceFile).string(), kCourseFileKey, name);
    return names;
}

/// What `Package: NAME FILE SAMPLES samples TS s` says, if an installed data set has that line.
std::optional<PackagedData> packaged_data(const fs::path& data_set) {
    if (!is_installed_data(data_set)) return std::nullopt;
    std::istringstream words(fmt::format("{}", fmt::join(words_after(kPackageKey, data_set), " ")));
    PackagedData packaged;
    std::string file, unit;
    words >> packaged.package >> file >> packaged.samples >> unit >> packaged.Ts;
    if (!words || packaged.samples < 1) return std::nullopt;
    packaged.file = file;
    return packaged;
}

/// A file of variables, or a data set of a package.
struct Source {
    fs::path file;
    std::optional<PackagedData> packaged = {};
};

/// The file of a data set to read; nothing when it has none.
std::optional<Source> source_of(const fs::path& data_set) {
    std::vector<fs::path> candidates;
    for (const std::string& name : course_files(data_set)) candidates.push_back(data_set / name);
    const std::string name = data_set.filename().string();
    candidates.push_back(data_set / (name + ".csv"));
    candidates.push_back(data_set / (name + ".mat"));
    const auto found = std::find_if(candidates.begin(), candidates.end(), is_file);
    if (found != candidates.end()) return Source{*found};
    if (const auto packaged = packaged_data(data_set)) return Source{packaged->file, packaged};
    return std::nullopt;
}

bool is_course_name(const fs::path& data_set, const std::string& name) {
    const std::vector<std::string> names = course_files(data_set);
    return std::any_of(names.begin(), names.end(), [&](const std::string& course_name) {
        return course_name == name || fs::path(course_name).stem() == name;
    });
}

/// A data set called `name`, a course file of that name, or a file of that name in a data set's folder.
std::optional<Source> source_in_data_folder(const fs::path& data_folder, const std::string& name) {
    if (is_file(data_folder / name / kSourceFile)) return source_of(data_folder / name);
    for (const fs::path& data_set : data_sets_in(data_folder)) {
        if (is_file(data_set / name) && is_data_file(name)) return Source{data_set / name};
        if (is_course_name(data_set, name)) return source_of(data_set);
    }
    return std::nullopt;
}

std::optional<fs::path> file_beside(const fs::path& script_folder, const std::string& name) {
    if (is_data_file(name)) {
        return is_file(script_folder / name) ? std::optional<fs::path>(script_folder / name) : std::nullopt;
    }
    for (const char* extension : {".mat", ".csv"}) {
        if (is_file(script_folder / (name + extension))) return script_folder / (name + extension);
    }
    return std::nullopt;
}

/// In full, without the /. or / that names the folder a script runs in.
std::string full_path(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).string();
}

/// Words that can be compared with what a script asks for, and the name under which load() finds each of them.
class LoadableNames {
  public:
    void add(const std::string& word, const std::string& name) {
        words_.push_back(word);
        names_.push_back(name);
    }
    void add_files(const fs::path& folder, const fs::path& prefix) {
        std::vector<fs::path> files;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error))
            if (is_file(entry.path()) && is_data_file(entry.path())) files.push_back(entry.path().filename());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) add(file.stem().string(), (prefix / file).string());
    }
    void add_data_sets(const fs::path& data_folder) {
        for (const fs::path& data_set : data_sets_in(data_folder)) {
            add(data_set.filename().string(), data_set.filename().string());
            if (!is_installed_data(data_set)) continue;
            for (const std::string& name : course_files(data_set)) add(fs::path(name).stem().string(), name);
        }
    }
    /// Compared without the ending, so that a wrong ending does not hide the file and equal endings do not count.
    std::optional<std::string> nearest(const std::string& requested) const {
        const auto word = nearest_word(fs::path(requested).stem().string(), words_);
        if (!word) return std::nullopt;
        return names_[static_cast<std::size_t>(std::find(words_.begin(), words_.end(), *word) - words_.begin())];
    }

  private:
    std::vector<std::string> words_, names_;
};

/// Only the script's own folder is searched for similar names: a script must not learn the names of other files.
[[noreturn]] void fail_missing_file(const fs::path& path, const fs::path& script_folder) {
    const fs::path file = script_folder / path;
    LoadableNames names;
    if (lies_in(script_folder, file.parent_path())) names.add_files(file.parent_path(), path.parent_path());
    if (const auto nearest = names.nearest(path.filename().string()))
        throw EnvironmentError("file not found: {}; did you mean \"{}\"?", full_path(file), *nearest);
    throw EnvironmentError("file not found: {}", full_path(file));
}

[[noreturn]] void fail_unknown(const std::string& name, const fs::path& script_folder) {
    LoadableNames names;
    names.add_files(script_folder, {});
    for (const fs::path& data_folder : data_folders(script_folder)) names.add_data_sets(data_folder);
    if (const auto nearest = names.nearest(name))
        throw is_data_file(name)
            ? EnvironmentError("file not found: {}; did you mean \"{}\"?", full_path(script_folder / name), *nearest)
            : EnvironmentError("unknown data set \"{}\"; did you mean \"{}\"?", name, *nearest);
    const std::string folder = full_path(script_folder);
    const std::vector<std::string> known = dataset_names();
    if (known.empty())
        throw EnvironmentError(
            "unknown data set \"{}\": no data sets are installed. dynlab searches {} for your own files", name, folder);
    throw EnvironmentError("unknown data set \"{}\"; the data sets are {}. dynlab searches {} for your own files", name,
                           listed(known), folder);
}

/// A data set of the installed data, by its name, a course file's, or a path that ends in one of its files.
std::optional<Source> installed_source(const fs::path& path) {
    return source_in_data_folder(shared_folder() / "data", path.filename().string());
}

Source find_source(const std::string& name_or_path, const fs::path& script_folder) {
    const fs::path path = name_or_path;
    if (path.has_parent_path()) {
        if (!is_file(script_folder / path)) fail_missing_file(path, script_folder);
        return {script_folder / path};
    }
    if (const auto file = file_beside(script_folder, name_or_path)) return {*file};
    if (path.has_extension() && is_file(script_folder / path)) return {script_folder / path};  // of another kind
    for (const fs::path& data_folder : data_folders(script_folder)) {
        if (const auto source = source_in_data_folder(data_folder, name_or_path)) return *source;
    }
    fail_unknown(name_or_path, script_folder);
}

/// Of a script that is graded: installed data come first, and no link leads from its folder to files of others.
Source find_graded_source(const std::string& name_or_path, const fs::path& script_folder) {
    if (const auto source = installed_source(name_or_path)) return *source;
    Source source = find_source(name_or_path, script_folder);
    if (!lies_in(script_folder, source.file)) throw EnvironmentError(refusal_outside(source.file.string()));
    return source;
}

}  // namespace

Message refusal_outside(const std::string& file) {
    return Message(
        "\"{}\" is outside the folder of the script; a graded script can load only the course's data and files in its "
        "own folder",
        file);
}

bool is_refusal_outside(const Message& message) {
    static const std::string id = refusal_outside("").id();
    return message.id() == id || std::ranges::any_of(message.arguments(), [](const MessageArgument& argument) {
               const auto* const list = std::get_if<MessageList>(&argument);
               return list != nullptr && std::ranges::any_of(list->items, is_refusal_outside);
           });
}

LoadedData load_data(const std::string& name_or_path, const fs::path& script_folder, bool graded,
                     const ImportOptions& options) {
    const auto [file, packaged] =
        graded ? find_graded_source(name_or_path, script_folder) : find_source(name_or_path, script_folder);
    if (!packaged) return read_data_file(file, !is_installed_data(file), options);
    LoadedData data;
    data.variables = read_packaged_data(*packaged);
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

std::optional<std::string> missing_package(const std::string& name) {
    const auto source = source_of(shared_folder() / "data" / name);
    if (!source || !source->packaged || is_file(source->file)) return std::nullopt;
    return source->packaged->package;
}

}  // namespace dynlab::inline data_io
