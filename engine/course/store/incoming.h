#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "course/intake/submission.h"
#include "platform/temporary_folder.h"

namespace dynlab::inline course {

/// A file as it was received.
struct IncomingFile {
    std::filesystem::path file;  ///< where it can be read
    std::string name;            ///< its own name
    std::string source;          ///< for messages: the file that was given, and the place in it
    Submission sender;           ///< name, person and lms_id from the name of the folder or file
    std::string folder = {};     ///< source of the sender's own folder; empty for a file alone
    std::size_t given = 0;       ///< as how manieth it, or what it lay in, was given
    Message left_out = {};       ///< why it cannot be taken, a clause; what holds nothing is an empty file then
};

/// All files and folders to receive, including the zip that Moodle or Canvas exports. Archives are unpacked in a
/// sandbox, except packs, which are kept unchanged.
class IncomingFiles {
  public:
    struct Way {
        Isolation level = Isolation::kFull;
        std::filesystem::path program;
        bool one_sender = false;     ///< the instructor names the sender: an archive is that group's pack
        bool whole_folders = false;  ///< a sender's folder with several files is one pack: the work of a lab
        std::function<bool(const Submission&)> knows;  ///< whether a name is a group's or student's of the course
    };
    explicit IncomingFiles(Way way) : way_(std::move(way)) {}

    /// Throws EnvironmentError where there is no such file, SubmissionError for an archive that cannot be unpacked.
    void add(const std::filesystem::path& given);

    const std::vector<IncomingFile>& files() const { return files_; }
    bool batch() const { return batch_; }  ///< more than one file, so that one bad file need not stop the others

  private:
    void add_file(const std::filesystem::path& file, const std::string& source);
    void add_found(const std::filesystem::path& file, const std::string& source);
    void add_batch(const std::filesystem::path& folder, const std::string& source);
    void add_folder_of(const Submission& sender, const std::filesystem::path& folder, const std::string& source,
                       const std::string& own);

    void add_own_folder(const std::filesystem::path& folder, const std::string& source);
    void add_pack_of(const Submission& sender, const std::filesystem::path& folder, const std::string& source);
    void leave_out(const std::string& name, const std::string& source, const Submission& sender, const Message& reason);

    Way way_;
    TemporaryFolder scratch_;
    int unpacked_ = 0;
    std::size_t given_ = 0;
    bool batch_ = false;
    std::vector<IncomingFile> files_;
};

}  // namespace dynlab::inline course
