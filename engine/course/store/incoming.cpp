#include "course/store/incoming.h"

#include <fmt/format.h>

#include <algorithm>

#include "course/intake/folder_copy.h"
#include "course/intake/notebooks.h"
#include "course/intake/staging.h"
#include "platform/atomic_file.h"
#include "platform/error.h"
#include "workflow/notebooks/notebook.h"

namespace dynlab::inline course {
namespace {

namespace fs = std::filesystem;

bool names_the_folder_itself(const fs::path& path) {
    return fs::symlink_status(path).type() == fs::file_type::directory;
}

/// Entries that a person put there, sorted; not what macOS or the platform adds.
std::vector<fs::path> entries_of_one_person(const fs::path& folder) {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        if (!name.starts_with('.') && name != "__MACOSX" && name != "onlinetext.html") entries.push_back(entry.path());
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

/// The sender that a name shows: an LMS's pattern, or the name without its ending.
Submission sender_of(const std::string& name) {
    Submission sender;
    sender.name = archive_stem(name).value_or(fs::path(name).stem().string());
    if (sender.name.empty()) sender.name = name;
    read_lms_name(sender);
    return sender;
}

}  // namespace

void IncomingFiles::add(const fs::path& given) {
    const std::string source = given.string();
    if (!fs::exists(given)) throw EnvironmentError("file or folder not found: '{}'", source);
    if (!files_.empty()) batch_ = true;
    ++given_;
    if (fs::is_directory(given)) {
        if (way_.one_sender)
            throw EnvironmentError("{} is a folder; with --from, give the files themselves or a pack", source);
        batch_ = true;
        if (way_.knows(sender_of(given.filename())))
            add_own_folder(given, source);
        else
            add_batch(given, source);
        return;
    }
    if (!fs::is_regular_file(given)) throw EnvironmentError("{} is not a regular file", source);
    const std::string name = given.filename();
    if (!archive_stem(name) || way_.one_sender || way_.knows(sender_of(name))) {
        add_file(given, source);
        return;
    }
    const fs::path to = scratch_.path() / std::to_string(++unpacked_);
    fs::create_directories(to);
    int number = 0;
    for (const Message& clause : unpack_export(given, to, way_.level, way_.program))
        leave_out(fmt::format("{} ({})", name, ++number), source, {}, Message("{}; left out", clause));
    add_batch(to, source);
}

void IncomingFiles::add_file(const fs::path& file, const std::string& source) {
    const std::string name = file.filename();
    if (!is_notebook(file)) {
        files_.push_back({file, name, source, sender_of(name), {}, given_ - 1});
        return;
    }
    try {  // a notebook is the script that it says
        const fs::path script = scratch_.path() / fmt::format("notebook-{}.lua", ++unpacked_);
        write_file_atomically(script, script_of_submitted_notebook(file));
        files_.push_back({script, fs::path(name).stem().string() + ".lua", source, sender_of(name), {}, given_ - 1});
    } catch (const SubmissionError& error) {
        files_.push_back({file, name, source, sender_of(name), {}, given_ - 1, error.message()});
    }
}

/// Leaves out an entry without content.
void IncomingFiles::leave_out(const std::string& name, const std::string& source, const Submission& sender,
                              const Message& reason) {
    const fs::path nothing = scratch_.path() / "nothing";
    if (!fs::exists(nothing)) write_file_atomically(nothing, "");
    files_.push_back({nothing, name, source, sender, {}, given_ - 1, reason});
}

/// Adds a file of a folder. Links are refused, because they could lead to files that were not submitted.
void IncomingFiles::add_found(const fs::path& file, const std::string& source) {
    const fs::file_type type = fs::symlink_status(file).type();
    if (type == fs::file_type::regular)
        add_file(file, source);
    else
        leave_out(file.filename(), source, sender_of(file.filename()),
                  type == fs::file_type::symlink ? Message("link; left out") : Message("not a regular file; left out"));
}

void IncomingFiles::add_batch(const fs::path& folder, const std::string& source) {
    batch_ = true;
    const std::vector<fs::path> entries = entries_of_one_person(folder);
    const bool wrapped = entries.size() == 1 && names_the_folder_itself(entries.front()) &&
                         !way_.knows(sender_of(entries.front().filename())) &&
                         sender_of(entries.front().filename()).lms_id.empty();
    if (wrapped) {
        add_batch(entries.front(), source);
        return;
    }
    for (const fs::path& entry : entries) {
        const std::string name = entry.filename(), shown_source = source + "/" + name;
        if (names_the_folder_itself(entry)) {
            add_own_folder(entry, shown_source);
        } else {
            add_found(entry, shown_source);
        }
    }
}

/// A folder that is called after its sender.
void IncomingFiles::add_own_folder(const fs::path& folder, const std::string& source) {
    Submission sender;
    sender.name = folder.filename();
    read_lms_name(sender);
    const std::vector<fs::path> own = entries_of_one_person(folder);
    if (way_.whole_folders && (own.size() > 1 || (own.size() == 1 && names_the_folder_itself(own.front()))))
        add_pack_of(sender, folder, source);
    else
        add_folder_of(sender, folder, source, source);
}

void IncomingFiles::add_pack_of(const Submission& sender, const fs::path& folder, const std::string& source) {
    const std::string name = sender.name + ".zip";
    Submission submission = sender;
    submission.path = folder;
    try {
        const fs::path zip = scratch_.path() / fmt::format("pack-{}.zip", ++unpacked_);
        zip_submission(submission, zip);
        fs::file_time_type newest = fs::file_time_type::min();
        for (const fs::path& file : files_below(folder)) newest = std::max(newest, fs::last_write_time(file));
        if (newest > fs::file_time_type::min()) fs::last_write_time(zip, newest);
        files_.push_back({zip, name, source, sender, source, given_ - 1});
    } catch (const SubmissionError& error) {
        leave_out(name, source, sender, error.message());
    }
}

void IncomingFiles::add_folder_of(const Submission& sender, const fs::path& folder, const std::string& source,
                                  const std::string& own) {
    for (const fs::path& entry : entries_of_one_person(folder)) {
        const std::string shown_source = source + "/" + entry.filename().string();
        if (entry.filename() == "data") continue;  // the course's data sets, or a link to them
        if (names_the_folder_itself(entry)) {
            if (entry.filename() == kFiguresOfRuns) continue;
            add_folder_of(sender, entry, shown_source, own);
            continue;
        }
        const std::size_t before = files_.size();
        add_found(entry, shown_source);
        if (files_.size() > before) files_.back().sender = sender, files_.back().folder = own;
    }
}

}  // namespace dynlab::inline course
