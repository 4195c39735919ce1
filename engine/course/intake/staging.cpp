#include "course/intake/staging.h"

#include <fmt/format.h>
#include <re2/re2.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <map>
#include <set>

#include "course/intake/folder_copy.h"
#include "course/intake/notebooks.h"
#include "course/intake/owners.h"
#include "data_io/tables/text_decoding.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "platform/files/zip_file.h"
#include "platform/temporary_folder.h"
#include "platform/text/foreign_text.h"
#include "platform/text/small_letters.h"
#include "workflow/given_script.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

constexpr char kScript[] = "analysis.lua";
constexpr int kMaxArchives = 8, kMaxNesting = 3;
constexpr auto kSameTime = std::chrono::seconds(2);  // the step of times in a zip

/// A place where a script was found.
struct FoundScript {
    fs::path folder;
    std::string shown;  ///< "work_v2.zip", "lab4/final"
    fs::file_time_type written;
};

std::string shown_place(const fs::path& file, const fs::path& from) {
    return utf8_of_name(file.lexically_relative(from).string());
}

/// A name without its numbers, and the last of these: versions of one work have equal words.
struct VersionName {
    std::vector<std::string> words;
    long number = 0;
};

VersionName version_of(const std::string& shown) {
    static const std::set<std::string> kVersion = {"v", "version", "copy", "vers"};
    VersionName version;
    for (const std::string& word : name_words(archive_stem(shown).value_or(shown))) {
        const bool number = word.front() >= '0' && word.front() <= '9';
        if (number && word.size() < 10) version.number = std::stol(word);
        if (!number && !kVersion.contains(word)) version.words.push_back(word);
    }
    return version;
}

/// The newest script; nothing if the versions cannot be ordered.
std::optional<FoundScript> newest_of(const std::vector<FoundScript>& found) {
    std::vector<VersionName> versions;
    for (const FoundScript& script : found) versions.push_back(version_of(script.shown));
    const bool one_work = std::all_of(versions.begin(), versions.end(),
                                      [&](const VersionName& v) { return v.words == versions.front().words; });
    const auto newest_by = [&](const auto& newer) -> std::optional<FoundScript> {
        for (std::size_t i = 0; i < found.size(); ++i) {
            bool newest = true;
            for (std::size_t k = 0; k < found.size(); ++k) newest = newest && (k == i || newer(i, k));
            if (newest) return found[i];
        }
        return {};
    };
    const auto by_number = newest_by([&](auto i, auto k) { return versions[i].number > versions[k].number; });
    if (one_work && by_number) return by_number;
    return newest_by([&](auto i, auto k) { return found[i].written > found[k].written + kSameTime; });
}

/// PowerShell's > writes UTF-16. Only a byte order mark at the start of the file shows this encoding.
void make_utf8(const fs::path& script) {
    constexpr std::uintmax_t kMaxTextBytes = 4u << 20;
    if (fs::file_size(script) > kMaxTextBytes) return;
    const std::string bytes = read_file(script), mark = bytes.substr(0, 2);
    if (mark != "\xFF\xFE" && mark != "\xFE\xFF") return;
    const fs::file_time_type written = fs::last_write_time(script);
    std::vector<Message> notes;
    try {
        write_file_atomically(script, decoded_text(script, bytes, notes));
    } catch (const EnvironmentError&) {
        throw SubmissionError("The file analysis.lua is not text: save it in UTF-8 and submit it again.");
    }
    fs::last_write_time(script, written);
}

/// "my%20analysis.lua" as "my analysis.lua".
std::string without_percent_signs(const std::string& name) {
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        unsigned code = 0;
        const char* const digits = name.data() + i + 1;
        const bool encoded =
            name[i] == '%' && i + 2 < name.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        plain += encoded ? static_cast<char>(code) : name[i];
        if (encoded) i += 2;
    }
    return plain;
}

/// A PDF or another file of bytes under a script's name would be graded as a script without answers.
void refuse_other_content(const fs::path& script) {
    constexpr std::size_t kStart = 1024;
    std::ifstream in(script, std::ios::binary);
    std::string start(kStart, '\0');
    in.read(start.data(), static_cast<std::streamsize>(kStart));
    start.resize(static_cast<std::size_t>(in.gcount()));
    if (start.starts_with("%PDF-"))
        throw SubmissionError("The file analysis.lua is a PDF, despite its extension: submit the script.");
    if (start.find('\0') != std::string::npos)
        throw SubmissionError("The file analysis.lua is not text: submit the script, saved in UTF-8.");
}

MessageList listed_places(const std::vector<FoundScript>& found) {
    std::vector<std::string> shown;
    for (const FoundScript& script : found) shown.push_back(fmt::format("\"{}\"", script.shown));
    return listed(shown);
}

[[noreturn]] void refuse_size(const SubmissionLimits& limits) {
    throw SubmissionError("The submission is too large: dynlab examines at most {} files and {} MB.", limits.files,
                          limits.bytes >> 20);
}

void copy_loose(const LooseFile& file, const fs::path& folder, const SubmissionLimits& limits) {
    static const RE2 of_platform(R"((?:.*_)?analysis(?:-\d+)?(\.lua|\.ipynb))", RE2::Latin1);
    if (fs::file_size(file.path) > limits.bytes) refuse_size(limits);
    std::string ending;
    fs::path to = folder / (RE2::FullMatch(file.name, of_platform, &ending) ? "analysis" + ending : file.name);
    for (int i = 2; fs::exists(to); ++i) to = folder / fmt::format("{} {}", i, file.name);
    fs::copy_file(file.path, to);
    fs::last_write_time(to, fs::last_write_time(file.path));
}

class Stager {
  public:
    Stager(const Submission& submission, const fs::path& to, Isolation level, const fs::path& program,
           const SubmissionLimits& limits)
        : submission_(submission), to_(to), root_(to / "unpacked"), level_(level), program_(program), limits_(limits) {
        limits_.keep_times = true;  // they show which version is the newest
    }

    StagedWork stage() {
        fill_root();
        take_notebooks_in(root_);
        std::vector<FoundScript> found = scripts_in(root_, "");
        if (found.empty()) open_archives(root_, "", 1, found);
        if (found.empty() && take_other_names()) found = scripts_in(root_, "");
        if (found.empty()) throw SubmissionError(obstacle());
        if (found.size() == 1) return staged(found.front(), renamed_);
        const std::optional<FoundScript> newest = newest_of(found);
        if (!newest)
            throw SubmissionError(
                "Several folders contain an analysis.lua, and dynlab cannot determine the newest file: {}. Submit only "
                "one of these folders.",
                listed_places(found));
        return staged(*newest, Message("of the files {}, dynlab used \"{}\", the newest file", listed_places(found),
                                       newest->shown));
    }

  private:
    StagedWork staged(const FoundScript& script, const Message& remark) const {
        make_utf8(script.folder / kScript);
        refuse_other_content(script.folder / kScript);
        return {script.folder, remark, "", of_notebooks_.contains(script.folder)};
    }

    void take_notebooks_in(const fs::path& folder) {
        for (const fs::path& place : take_notebooks(folder)) of_notebooks_.insert(place);
    }

    /// Where no file has the name itself: files whose name was changed on their way, one a folder at most.
    bool take_other_names() {
        std::map<fs::path, std::vector<fs::path>> meant;
        for (const fs::path& file : files_below(root_))
            if (!script_name_meant_by(file.filename().string()).empty()) meant[file.parent_path()].push_back(file);
        for (const auto& [folder, files] : meant) {
            if (files.size() > 1) continue;
            const std::string name = script_name_meant_by(files.front().filename().string());
            renamed_ = Message("\"{}\" was used as {}", shown_place(files.front(), root_), name);
            fs::rename(files.front(), folder / name);
        }
        if (!renamed_.empty()) take_notebooks_in(root_);
        return !renamed_.empty();
    }

    void fill_root() {
        if (submission_.archive) {
            note_left_out(unpack_submission(submission_.path, root_, level_, program_, limits_), "");
            return;
        }
        fs::create_directories(root_);
        for (const std::string& name : copy_submission(submission_, root_, limits_))
            note_left_out({Message("\"{}\" is a link or not a regular file", utf8_of_name(name))}, "");
    }

    void note_left_out(const std::vector<Message>& clauses, const std::string& archive) {
        for (const Message& clause : clauses)
            left_out_.push_back(archive.empty() ? clause : Message("in \"{}\", {}", archive, clause));
    }

    std::vector<FoundScript> scripts_in(const fs::path& folder, const std::string& archive) const {
        std::vector<FoundScript> found;
        for (const fs::path& file : files_below(folder)) {
            if (file.filename() != kScript) continue;
            const std::string place = file.parent_path() == folder ? "" : shown_place(file.parent_path(), folder);
            found.push_back({file.parent_path(), archive + (archive.empty() || place.empty() ? "" : "/") + place,
                             fs::last_write_time(file)});
        }
        return found;
    }

    void open_archives(const fs::path& folder, const std::string& shown, int depth, std::vector<FoundScript>& found) {
        for (const fs::path& file : files_below(folder)) {
            if (!archive_stem(file.filename().string()) || ++opened_ > kMaxArchives) continue;
            const fs::path to = to_ / fmt::format("archive-{}", opened_);
            const std::string name = shown + (shown.empty() ? "" : "/") + shown_place(file, folder);
            try {
                note_left_out(unpack_submission(file, to, level_, program_, limits_), name);
                take_notebooks_in(to);
            } catch (const SubmissionError& error) {
                damage_ = Message("\"{}\": {}", name, error.message());
                continue;
            }
            const std::vector<FoundScript> here = scripts_in(to, name);
            found.insert(found.end(), here.begin(), here.end());
            if (here.empty() && depth < kMaxNesting) open_archives(to, name, depth + 1, found);
        }
    }

    /// What is there instead of a script.
    Message obstacle() const {
        std::vector<std::string> near, others;
        bool notebook = false;
        for (const auto& entry : fs::directory_iterator(to_))
            for (const fs::path& file : files_below(entry.path())) {
                const std::string name = shown_place(file, entry.path()), lower = in_small_letters(name);
                if (lower.ends_with(".ipynb")) notebook = true;
                const bool script =
                    lower.ends_with(".lua") || lower.ends_with(".ipynb") || lower.find(".lua.") != std::string::npos;
                (script ? near : others).push_back(fmt::format("\"{}\"", name));
            }
        std::sort(near.begin(), near.end());
        std::sort(others.begin(), others.end());
        if (near.empty() && others.empty())
            return left_out_.empty()
                       ? Message("The submission is empty: it contains no analysis.lua.")
                       : with_rest(Message("No file of the submission can be read, and analysis.lua is missing."));
        if (!near.empty())
            return with_rest(
                Message("The submission contains no analysis.lua, but {}: submit the correct file under the name {}.",
                        listed(shortened_list(near)), notebook ? "analysis.ipynb" : "analysis.lua"));
        if (const std::string kind = closed_kind(others); !kind.empty())
            return with_rest(
                Message("The submission contains no analysis.lua, only {} ({} archives cannot be opened; use zip or "
                        "tar). Submit the folder that dynlab new created.",
                        listed(shortened_list(others)), kind));
        return with_rest(
            Message("The submission contains no analysis.lua, only {}. Submit the folder that dynlab new created.",
                    listed(shortened_list(others))));
    }

    /// And what was not unpacked or copied, and why: the script may be among it.
    Message with_rest(Message obstacle) const {
        std::vector<Message> said = {std::move(obstacle)};
        if (!left_out_.empty())
            said.push_back(Message("Left out: {}.", MessageList{shortened_list(left_out_), Join::kSemicolon}));
        if (!damage_.empty()) said.push_back(damage_);
        return sentences(std::move(said));
    }

    template <class Item>
    static std::vector<Item> shortened_list(std::vector<Item> items) {
        constexpr std::size_t kMax = 3;
        if (items.size() > kMax) items.resize(kMax), items.push_back(Item("..."));
        return items;
    }

    /// The ending of an archive that cannot be opened; empty where there is none.
    static std::string closed_kind(const std::vector<std::string>& names) {
        for (const std::string kind : {".rar", ".7z"})
            for (const std::string& name : names)
                if (in_small_letters(name).ends_with(kind + "\"")) return kind;
        return "";
    }

    const Submission& submission_;
    const fs::path to_, root_;
    const Isolation level_;
    const fs::path& program_;
    SubmissionLimits limits_;
    int opened_ = 0;
    std::set<fs::path> of_notebooks_;  ///< folders whose script was a notebook
    std::vector<Message> left_out_;    ///< and why, a clause each
    Message renamed_;                  ///< of a script that came under another name
    Message damage_;                   ///< of the last archive that could not be opened
};

}  // namespace

std::string script_name_meant_by(const std::string& name) {
    static const RE2 kForm(R"((?:.*[ _-])?analysis(?:[ _-]?\(?\d+\)?|[ _-]copy)?(\.lua|\.ipynb)(?:\.txt)?)",
                           RE2::Latin1);
    std::string ending;
    if (!RE2::FullMatch(in_small_letters(without_percent_signs(name)), kForm, &ending)) return "";
    return "analysis" + ending;
}

std::vector<std::string> copy_submission(const Submission& submission, const fs::path& to,
                                         const SubmissionLimits& limits) {
    for (const LooseFile& file : submission.loose) copy_loose(file, to, limits);
    if (!submission.loose.empty()) return {};
    FolderCopy copy = copy_folder(submission.path, to, limits.bytes, limits.files);
    if (copy.too_large) refuse_size(limits);
    return std::move(copy.left_out);
}

void zip_submission(const Submission& submission, const fs::path& zip, const SubmissionLimits& limits) {
    const TemporaryFolder copy;
    copy_submission(submission, copy.path(), limits);
    write_zip(zip, contents_of(copy.path()));
}

StagedWork stage_submission(const Submission& submission, const fs::path& to, Isolation level, const fs::path& program,
                            const SubmissionLimits& limits) {
    StagedWork staged = Stager(submission, to, level, program, limits).stage();
    staged.language = language_of_work(staged.folder);
    return staged;
}

}  // namespace dynlab::inline course
