#include "course/similarity/class_similarity.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/intake/class_submissions.h"
#include "course/intake/staging.h"
#include "course/similarity/similarity.h"
#include "data_io/text_table.h"
#include "documents/solutions.h"
#include "platform/atomic_file.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxComparedBytes = 1u << 20;  // of a script that is compared

/// The Lua files that lie directly in a folder; none for a zip.
std::vector<fs::path> scripts_in(const fs::path& folder) {
    std::vector<fs::path> plain;
    if (!fs::is_directory(folder)) return plain;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().extension() == ".lua") plain.push_back(entry.path());
    std::sort(plain.begin(), plain.end());
    return plain;
}

/// Everything that can be compared of a class, or of Lua files alone.
void add_scripts(const fs::path& from, const std::string& prefix, bool of_class, const SimilarityRequest& request,
                 std::vector<ComparedScript>& scripts, std::vector<Message>& complaints) {
    const auto add = [&](const std::string& name, const fs::path& file) {
        if (fs::file_size(file) > kMaxComparedBytes)
            complaints.push_back(
                Message("\"{}\" is larger than {} MB and is not compared", name, kMaxComparedBytes >> 20));
        else
            scripts.push_back({prefix + name, read_file(file), of_class});
    };
    if (const std::vector<fs::path> plain = scripts_in(from); !of_class && !plain.empty()) {
        for (const fs::path& file : plain) add(file.filename().string(), file);
        return;
    }
    const ClassSubmissions submissions(from, request.isolation, request.program, request.out);
    for (const Submission& submission : submissions.all()) {
        const TemporaryFolder work;
        try {
            const StagedWork staged = stage_submission(submission, work.path(), request.isolation, request.program);
            add(submission.name, staged.folder / "analysis.lua");
        } catch (const SubmissionError& error) {
            complaints.push_back(Message("\"{}\": {}", prefix + submission.name, error.message()));
        }
    }
    for (const Message& clause : submissions.left_out()) complaints.push_back(Message("{}; left out", clause));
}

/// All pairs, those within a group of copies with its number.
TextTable table_of(const std::vector<ComparedScript>& scripts, const std::vector<SimilarPair>& pairs,
                   const std::vector<SimilarGroup>& groups) {
    TextTable table;
    table.names = {"first", "second", "code_percent", "same_lines_percent", "group"};
    for (const SimilarPair& pair : pairs) {
        std::string number;
        for (std::size_t k = 0; k < groups.size(); ++k)
            if (groups[k].members.size() > 2 && groups[k].has(pair.a) && groups[k].has(pair.b))
                number = std::to_string(k + 1);
        table.rows.push_back({scripts[pair.a].name, scripts[pair.b].name, fmt::format("{:.0f}", 100 * pair.share),
                              fmt::format("{:.0f}", 100 * pair.same_lines), number});
    }
    return table;
}

}  // namespace

SimilarityOutcome compare_class(const SimilarityRequest& request) {
    SimilarityOutcome outcome;
    const std::string solution = read_text(request.lesson.script());
    std::vector<ComparedScript> scripts;
    add_scripts(request.submissions, "", true, request, scripts, outcome.complaints);
    outcome.scripts = scripts.size();
    scripts.push_back({"the reference solution", solution, false});
    for (const fs::path& folder : request.others)
        add_scripts(folder, folder.filename().string() + "/", false, request, scripts, outcome.complaints);
    const auto pairs = similar_pairs(scripts, without_solutions(solution, request.lesson.script()), request.line);
    const std::vector<SimilarGroup> groups = similar_groups(scripts, pairs);
    for (const SimilarGroup& group : groups) ++(group.members.size() > 2 ? outcome.groups : outcome.pairs);
    fs::create_directories(request.out);
    write_file_atomically(request.out / "similarity.md", similarity_in_markdown(scripts, groups, request.line));
    write_file_atomically(request.out / "similarity.csv", csv_text(table_of(scripts, pairs, groups)));
    return outcome;
}

}  // namespace dynlab::inline course
