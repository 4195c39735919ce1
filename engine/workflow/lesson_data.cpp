#include "workflow/lesson_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "documents/text_lines.h"
#include "figures/gnuplot_renderer.h"
#include "numerics/plants/plant_catalog.h"
#include "platform/atomic_file.h"
#include "platform/cache.h"
#include "platform/error.h"
#include "platform/temporary_folder.h"
#include "scripting/interpreter/runtime.h"
#include "scripting/runtime/services.h"

namespace dynlab::inline workflow {

namespace fs = std::filesystem;

namespace {

/// The run of the reference solution as grading does it: on the course's own data, and nothing is drawn.
RunRecord run_of_solution(const PercentScript& script) {
    const TemporaryFolder out;
    RunOptions options;
    options.seed = script.header.seed;
    options.script_folder = script.file.parent_path();
    options.out_folder = out.path();
    options.graded = true;
    GnuplotRenderer renderer;
    ReportLanguage language{script.header.language};
    Runtime runtime(options, renderer);
    runtime.services().language = &language;
    return runtime.run(script);
}

/// Sorted.
std::vector<fs::path> data_files_beside(const Lesson& lesson) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(lesson.folder))
        if (entry.path().extension() == ".csv" || entry.path().extension() == ".mat") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    for (const std::string& line : lines_of(text))
        if (!line.empty()) words.push_back(line);
    return words;
}

}  // namespace

std::vector<std::string> simulated_data_of(const RunRecord& record) {
    std::set<std::string> names;
    for (const std::filesystem::path& file : record.files_read) {
        const std::filesystem::path folder = file.parent_path();
        const bool is_data_set = folder.parent_path().filename() == "data";
        if (is_data_set && find_plant(folder.filename().string())) names.insert(folder.filename().string());
    }
    return {names.begin(), names.end()};
}

std::vector<std::string> simulated_data_of(const Lesson& lesson) {
    const PercentScript script = read_percent_script(lesson.script());
    const Cache cache;
    const std::string name = EntryName("lessons").add(lesson.script().string()).add(script.source).text();
    if (const auto known = cache.load_entry(name)) return words_of(*known);
    const RunRecord record = run_of_solution(script);
    if (record.error)
        throw EnvironmentError(
            "the data of lesson {} are unknown, because its reference solution stops with an error: {}", lesson.slug,
            record.error->text());
    const std::vector<std::string> names = simulated_data_of(record);
    cache.save_entry(name, fmt::format("{}\n", fmt::join(names, "\n")));
    return names;
}

bool has_own_data(const Lesson& lesson) {
    return fs::is_directory(lesson.folder / "data") || !data_files_beside(lesson).empty();
}

void copy_own_data(const Lesson& lesson, const fs::path& data_folder) {
    fs::create_directories(data_folder);
    if (fs::is_directory(lesson.folder / "data"))
        fs::copy(lesson.folder / "data", data_folder,
                 fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    for (const fs::path& file : data_files_beside(lesson)) {
        const fs::path data_set = data_folder / file.stem();
        fs::create_directories(data_set);
        fs::copy_file(file, data_set / file.filename(), fs::copy_options::overwrite_existing);
        if (!fs::exists(data_set / "SOURCE.md"))
            write_file_atomically(data_set / "SOURCE.md", fmt::format("# {}\n\nA data set of the lesson {}.\n",
                                                                      file.stem().string(), lesson.slug));
    }
}

}  // namespace dynlab::inline workflow
