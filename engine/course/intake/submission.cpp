#include "course/intake/submission.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "base/error.h"
#include "course/intake/owners.h"
#include "course/sandbox_jobs/job_descriptions.h"
#include "course/sandbox_jobs/sandbox_work.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/text/foreign_text.h"
#include "platform/text/small_letters.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kGradescopeList[] = "submission_metadata.yml";

/// Without what is hidden and what systems add.
std::vector<fs::path> entries_of(const fs::path& folder) {
    static const std::set<std::string> kOfSystems = {"__MACOSX", "Thumbs.db", "desktop.ini"};
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with('.') && !kOfSystems.contains(name)) entries.push_back(entry.path());
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

bool is_folder(const fs::path& path) {
    return fs::symlink_status(path).type() == fs::file_type::directory;
}

bool is_plain_file(const fs::path& path) {
    return fs::symlink_status(path).type() == fs::file_type::regular;
}

std::string name_of_entry(const fs::path& entry) {
    return composed(utf8_of_name(entry.filename().string()));
}

/// Files in the folder of submissions that may be a submission in a wrong format; a message reports them by the owner's
/// name.
bool can_be_work(const std::string& name) {
    static const std::set<std::string> kEndings = {".lua",   ".pdf", ".rar", ".7z", ".docx", ".doc",
                                                   ".ipynb", ".odt", ".m",   ".py", ".gz",   ".bz2"};
    return kEndings.contains(ending_of(name)) || in_small_letters(name).ends_with(".lua.txt");
}

/// What Moodle makes for a text typed into its form, beside the files.
bool is_online_text(const fs::path& entry) {
    if (entry.filename().string().find("_assignsubmission_onlinetext") == std::string::npos) return false;
    if (!is_folder(entry)) return entry.filename().string().ends_with("onlinetext.html");
    const std::vector<fs::path> entries = entries_of(entry);
    return entries.size() == 1 && entries.front().filename() == "onlinetext.html";
}

/// Whether dynlab grade made the folder, in a run that was killed early as well: its locks come first, then its
/// course; earlier versions wrote manual.csv first and gradebook.csv last.
bool holds_results(const fs::path& folder) {
    const bool begun =
        fs::exists(folder / ".lock") && (fs::exists(folder / "manual.csv") || entries_of(folder).empty());
    return begun || fs::exists(folder / ".course.lock") ||
           (fs::exists(folder / "gradebook.csv") && fs::is_directory(folder / "results"));
}

bool is_named_by_platform(const fs::path& entry) {
    Submission submission;
    submission.name = name_of_entry(entry);
    return read_lms_name(submission).has_value();
}

/// Whether what a platform exported lies in here.
bool is_export(const fs::path& folder) {
    const std::vector<fs::path> entries = entries_of(folder);
    return std::any_of(entries.begin(), entries.end(), [](const fs::path& entry) {
        return entry.filename() == kGradescopeList || is_named_by_platform(entry);
    });
}

/// The text of a line "  :name: Ada" or "  - :name: 'Ada'" of Gradescope's list.
std::optional<std::string> value_of_line(const std::string& line, const std::string& key) {
    const std::size_t at = line.find(":" + key + ":");
    if (at == std::string::npos || line.find_first_not_of(" -") != at) return {};
    std::string value = line.substr(at + key.size() + 2);
    const std::size_t first = value.find_first_not_of(" '\""), last = value.find_last_not_of(" '\"\r");
    return first == std::string::npos ? "" : value.substr(first, last - first + 1);
}

/// By the folder's name.
std::map<std::string, std::vector<Submitter>> submitters_in(const fs::path& list) {
    static const RE2 folder_line(R"((submission_\d+):\s*)", RE2::Latin1);
    std::map<std::string, std::vector<Submitter>> all;
    if (!is_plain_file(list)) return all;
    std::istringstream lines(read_text(list));
    std::vector<Submitter>* here = nullptr;
    std::string name_of_folder;
    for (std::string line; std::getline(lines, line);) {
        if (RE2::FullMatch(line, folder_line, &name_of_folder)) {
            here = &all[name_of_folder];
        } else if (here != nullptr) {
            const auto name = value_of_line(line, "name"), id = value_of_line(line, "sid"),
                       mail = value_of_line(line, "email");
            if (name) here->push_back({*name, "", ""});
            if (id && !here->empty()) here->back().id = *id;
            if (mail && !here->empty()) here->back().mail = *mail;
        }
    }
    return all;
}

/// Reads a folder of submissions, entry by entry.
class SubmissionReader {
  public:
    SubmissionReader(const fs::path& folder, std::vector<Message>& left_out, const fs::path& results)
        : left_out_(left_out), results_(results), submitters_(submitters_in(folder / kGradescopeList)) {}

    void take(const fs::path& entry) {
        if (is_online_text(entry) || entry.filename() == kGradescopeList) return;
        const std::string name = name_of_entry(entry);
        if (is_folder(entry)) {
            take_folder(entry, name);
        } else if (!is_plain_file(entry)) {
            leave_out(name);
        } else {
            take_file(entry, name);
        }
    }

    std::vector<Submission> all() { return std::move(all_); }

  private:
    void leave_out(const std::string& name) {
        left_out_.push_back(Message("\"{}\" is neither a folder nor an archive (.zip, .tar.gz)", name));
    }

    void take_folder(const fs::path& entry, const std::string& name) {
        std::error_code ignored;
        if (!results_.empty() && fs::equivalent(entry, results_, ignored)) return;
        if (holds_results(entry)) {
            left_out_.push_back(Message("\"{}\" contains the results of dynlab grade", name));
            return;
        }
        Submission submission{name, entry};
        read_lms_name(submission);
        if (const auto found = submitters_.find(name); found != submitters_.end()) {
            submission.submitters = found->second;
            for (const Submitter& one : found->second)
                submission.person += (submission.person.empty() ? "" : ", ") + one.name;
        }
        add(std::move(submission), name);
    }

    void take_file(const fs::path& entry, const std::string& name) {
        const std::optional<std::string> stem = archive_stem(name);
        Submission submission{stem.value_or(name), entry, stem.has_value()};
        Submission sender{name, entry};
        if (const std::optional<std::string> own = read_lms_name(sender)) {
            submission.person = sender.person, submission.lms_id = sender.lms_id, submission.late = sender.late;
            join(std::move(submission), {entry, own->empty() || own->front() == '.' ? name : *own}, name);
        } else if (stem) {
            add(std::move(submission), name);
        } else if (can_be_work(name)) {
            submission.loose = {{entry, name}};
            add(std::move(submission), name);
        } else {
            leave_out(name);
        }
    }

    /// A file of a sender whom a platform names: with the others of the same sender it is one submission.
    void join(Submission&& submission, LooseFile&& file, const std::string& name) {
        const auto [place, fresh] = senders_.try_emplace({submission.person, submission.lms_id}, all_.size(), file);
        if (fresh) {
            if (!submission.archive) submission.loose = {std::move(file)};
            add(std::move(submission), name);
            return;
        }
        const auto& [index, first] = place->second;
        Submission& joint = all_[index];
        if (joint.loose.empty()) joint.loose = {first};
        joint.archive = false;
        joint.late = joint.late || submission.late;
        joint.name = fmt::format("{}_{}", submission.person, submission.lms_id);
        joint.loose.push_back(std::move(file));
    }

    void add(Submission&& submission, const std::string& whole_name) {
        const bool taken = std::any_of(all_.begin(), all_.end(),
                                       [&](const Submission& other) { return other.name == submission.name; });
        if (taken) {
            if (submission.person.empty()) submission.person = submission.name;
            submission.name = whole_name;
        }
        all_.push_back(std::move(submission));
    }

    std::vector<Message>& left_out_;
    const fs::path results_;
    std::map<std::string, std::vector<Submitter>> submitters_;
    /// By person and number: where in `all_`, and the first file.
    std::map<std::pair<std::string, std::string>, std::pair<std::size_t, LooseFile>> senders_;
    std::vector<Submission> all_;
};

}  // namespace

std::optional<std::string> archive_stem(const std::string& name) {
    const std::string lower = in_small_letters(name);
    for (const std::string ending : {".tar.gz", ".tar.xz", ".tar.bz2", ".tgz", ".tar", ".zip"})
        if (lower.ends_with(ending) && lower.size() > ending.size()) return name.substr(0, name.size() - ending.size());
    return {};
}

std::optional<std::string> read_lms_name(Submission& submission) {
    // The platform's prefix comes first; the student's own part follows and may look the same.
    static const RE2 canvas(R"(([^_]+)(_LATE)?_(\d+)_\d+_(.*))", RE2::Latin1);
    static const RE2 moodle(R"((.+?)_(\d+)_assignsubmission_(?:file|onlinetext)_?(.*))", RE2::Latin1);
    std::string person, late, id, own;
    const bool of_canvas =
        RE2::FullMatch(submission.name, canvas, &person, &late, &id, &own) && !is_word_for_group(person);
    if (!of_canvas && !RE2::FullMatch(submission.name, moodle, &person, &id, &own)) return {};
    if (of_canvas) submission.late = !late.empty();
    submission.person = person;
    submission.lms_id = id;
    return own;
}

std::vector<Submission> submissions_in(const fs::path& folder, std::vector<Message>& left_out,
                                       const fs::path& results) {
    if (!fs::is_directory(folder)) throw EnvironmentError("folder not found: '{}'", folder.string());
    const std::vector<fs::path> entries = entries_of(folder);
    const bool wrapped = entries.size() == 1 && is_folder(entries.front()) && !is_named_by_platform(entries.front());
    if (wrapped && is_export(entries.front())) return submissions_in(entries.front(), left_out, results);
    SubmissionReader reader(folder, left_out, results);
    for (const fs::path& entry : entries) reader.take(entry);
    std::vector<Submission> all = reader.all();
    if (all.empty())
        throw EnvironmentError("'{}' contains no submissions; a submission is a folder or an archive (.zip, .tar.gz)",
                               folder.string());
    return all;
}

std::vector<Message> unpack_submission(const fs::path& archive, const fs::path& to, Isolation level,
                                       const fs::path& program, const SubmissionLimits& limits) {
    fs::create_directories(to);
    Sandbox sandbox(level);
    // Times in zips have no zone: they are in the course's, which this process has, or in the machine's.
    if (const char* zone = std::getenv("TZ"))
        sandbox.set_environment("TZ", zone);
    else if (fs::exists("/etc/localtime"))
        sandbox.add("/etc/localtime", "/etc/localtime");
    UnpackJob job;
    job.archive = sandbox.add(archive, "/box/archive");
    job.to = sandbox.add_writable(to, "/box/unpacked");
    job.bytes = limits.bytes;
    job.files = limits.files;
    job.keep_times = limits.keep_times;
    const auto result = run_in_sandbox(sandbox, program, job, {std::chrono::seconds(60)});
    if (!result.output) throw SubmissionError("The archive cannot be unpacked: {}.", result.reason);
    if (result.output->error) throw SubmissionError("The file cannot be unpacked: {}.", *result.output->error);
    return result.output->left_out;
}

std::vector<Message> unpack_export(const fs::path& archive, const fs::path& to, Isolation level,
                                   const fs::path& program) {
    constexpr SubmissionLimits kOfAClass{4ull << 30, 200'000, true};
    try {
        return unpack_submission(archive, to, level, program, kOfAClass);
    } catch (const SubmissionError& error) {
        throw EnvironmentError("{}: {}", archive.string(), message_of(error));
    }
}

}  // namespace dynlab::inline course
