#include "course/grading/submission.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "course/grading/boxed_work.h"
#include "course/grading/folder_copy.h"
#include "course/grading/job_descriptions.h"
#include "platform/error.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kScript[] = "analysis.lua";

std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder))
        if (!entry.path().filename().string().starts_with('.')) entries.push_back(entry.path());
    std::sort(entries.begin(), entries.end());
    return entries;
}

bool is_folder(const fs::path& path) {
    return fs::symlink_status(path).type() == fs::file_type::directory;
}

bool is_plain_file(const fs::path& path) {
    return fs::symlink_status(path).type() == fs::file_type::regular;
}

/// The folder with the script: this one, or the only one below, not deeper than two folders.
std::optional<fs::path> folder_with_script(const fs::path& folder, int depth = 0) {
    if (is_plain_file(folder / kScript)) return folder;
    if (depth == 2) return {};
    std::optional<fs::path> found;
    for (const fs::path& entry : entries_of(folder)) {
        if (!is_folder(entry)) continue;
        const auto here = folder_with_script(entry, depth + 1);
        if (here && found) throw SubmissionError("There are several folders with an analysis.lua; hand in one.");
        if (here) found = here;
    }
    return found;
}

/// The folder that Moodle makes for a text typed into its form, beside that of the files.
bool is_online_text(const fs::path& folder) {
    const std::vector<fs::path> entries = entries_of(folder);
    return folder.filename().string().find("_assignsubmission_onlinetext") != std::string::npos &&
           entries.size() == 1 && entries.front().filename() == "onlinetext.html";
}

}  // namespace

std::optional<std::string> archive_stem(const std::string& name) {
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const std::string ending : {".tar.gz", ".tar.xz", ".tar.bz2", ".tgz", ".tar", ".zip"})
        if (lower.ends_with(ending) && lower.size() > ending.size()) return name.substr(0, name.size() - ending.size());
    return {};
}

void read_lms_name(Submission& submission) {
    // What the platform wrote stands first; what comes after it is the student's own and may look the same.
    static const std::regex canvas(R"(^([^_]+)(_LATE)?_(\d+)_(\d+)_.*$)");
    static const std::regex moodle(R"(^(.+?)_(\d+)_assignsubmission_(?:file|onlinetext)_?.*$)");
    std::smatch parts;
    if (std::regex_match(submission.name, parts, canvas)) {
        submission.person = parts[1];
        submission.late = parts[2].matched;
        submission.lms_id = parts[3];
    } else if (std::regex_match(submission.name, parts, moodle)) {
        submission.person = parts[1];
        submission.lms_id = parts[2];
    }
}

std::vector<Submission> submissions_in(const fs::path& folder, std::vector<std::string>& left_out) {
    std::vector<Submission> all;
    if (!fs::is_directory(folder)) throw EnvironmentError(fmt::format("there is no folder '{}'", folder.string()));
    for (const fs::path& entry : entries_of(folder)) {
        Submission submission;
        submission.path = entry;
        const std::string name = entry.filename().string();
        if (is_folder(entry)) {
            if (is_online_text(entry)) continue;
            submission.name = name;
        } else if (const auto stem = archive_stem(name); stem && is_plain_file(entry)) {
            submission.name = *stem;
            submission.archive = true;
        } else {
            left_out.push_back(fmt::format("\"{}\" is neither a folder nor an archive (.zip, .tar.gz)", name));
            continue;
        }
        read_lms_name(submission);
        const bool taken =
            std::any_of(all.begin(), all.end(), [&](const auto& other) { return other.name == submission.name; });
        if (taken) {
            if (submission.person.empty()) submission.person = submission.name;
            submission.name = name;
        }
        all.push_back(std::move(submission));
    }
    if (all.empty())
        throw EnvironmentError(
            fmt::format("'{}' holds no submissions: folders or archives (.zip, .tar.gz)", folder.string()));
    return all;
}

std::vector<std::string> unpack_submission(const fs::path& archive, const fs::path& to, Isolation level,
                                           const fs::path& program, const SubmissionLimits& limits) {
    fs::create_directories(to);
    Box box(level);
    UnpackJob job;
    job.archive = box.add(archive, "/box/archive");
    job.to = box.add_writable(to, "/box/unpacked");
    job.bytes = limits.bytes;
    job.files = limits.files;
    job.keep_times = limits.keep_times;
    const auto result = run_boxed(box, program, job, std::chrono::seconds(60));
    if (!result.output) throw SubmissionError("The archive cannot be unpacked: " + result.reason + ".");
    if (result.output->error)
        throw SubmissionError(fmt::format("The file cannot be unpacked: {}.", *result.output->error));
    return result.output->left_out;
}

std::vector<std::string> unpack_export(const fs::path& archive, const fs::path& to, Isolation level,
                                       const fs::path& program) {
    constexpr SubmissionLimits kOfAClass{4ull << 30, 200'000, true};
    try {
        return unpack_submission(archive, to, level, program, kOfAClass);
    } catch (const SubmissionError& error) {
        throw EnvironmentError(fmt::format("{}: {}", archive.string(), error.what()));
    }
}

fs::path stage_submission(const Submission& submission, const fs::path& to, Isolation level, const fs::path& program,
                          const SubmissionLimits& limits) {
    if (submission.archive) {
        unpack_submission(submission.path, to / "unpacked", level, program, limits);
    } else {
        fs::create_directories(to / "unpacked");
        if (copy_folder(submission.path, to / "unpacked", limits.bytes, limits.files).too_large)
            throw SubmissionError(fmt::format("The folder is too large: at most {} files and {} MB are looked at.",
                                              limits.files, limits.bytes >> 20));
    }
    if (const auto folder = folder_with_script(to / "unpacked")) return *folder;
    // An LMS puts the archive that was handed in into a folder of its own.
    std::vector<fs::path> archives;
    for (const fs::path& entry : entries_of(to / "unpacked"))
        if (is_plain_file(entry) && archive_stem(entry.filename().string())) archives.push_back(entry);
    if (archives.size() == 1) {
        unpack_submission(archives.front(), to / "inner", level, program, limits);
        if (const auto folder = folder_with_script(to / "inner")) return *folder;
    }
    throw SubmissionError("There is no analysis.lua in it; hand in the folder that dynlab new made.");
}

}  // namespace dynlab::inline course
