#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "course/intake/course_clock.h"
#include "course/store/database.h"
#include "platform/atomic_file.h"
#include "platform/signature.h"

namespace dynlab::inline course {

struct StoredFile {
    std::string hash;
    std::int64_t bytes = 0;
};

/// A course on disk: course.db, the submitted files under their hashes in files/, the secret course.key, which signs
/// receipts and seals, and course.pub, with which anyone can verify them. Only the owner can read these files. Nothing
/// is ever deleted. A file is on disk before the transaction that refers to it commits, so that a crash leaves at worst
/// an unreferenced file. Every transaction seals its result (store_seal.h).
class Course {
  public:
    /// Makes a course in `folder`, which may exist. Finishes what an interrupted one began. Throws EnvironmentError
    /// where there is a course already, InvalidArgument for an unknown zone.
    static void create(const std::filesystem::path& folder, const std::string& name, const std::string& zone);

    /// Opens the course in `folder`, or in a folder above it. Removes temporary files and folders of killed
    /// processes.
    explicit Course(const std::filesystem::path& folder);

    Database& database() { return database_; }
    const CourseClock& clock() const { return clock_; }
    const std::string& name() const { return name_; }
    const std::string& key() const { return key_; }  ///< the secret
    const SigningKey& signing_key() const { return signing_key_; }
    const std::filesystem::path& folder() const { return folder_; }
    const std::vector<std::filesystem::path>& removed_leftovers() const { return leftovers_; }  ///< when it was opened

    /// Writes course.pub where it is not there, as in courses of before; returns the file.
    std::filesystem::path publish_key() const;

    /// Stores the content of a file, before a transaction; returns its hash. Several threads may do so at once.
    std::string keep(std::string_view content) const;
    /// The same for several, of which each has its hash; they wait for the disk together.
    std::vector<std::string> keep(std::vector<std::string> contents) const;
    /// Once all are kept, before the transaction: they are there after a power cut too.
    void settle(const std::vector<std::string>& hashes) const;
    /// Stores files and settles them. look(i, kept) hears of each as soon as it is stored, on all cores, while the disk
    /// is busy with the next ones; `progress` in the calling thread. What either throws is thrown on.
    void keep_files(const std::vector<std::filesystem::path>& files,
                    const std::function<void(std::size_t, const StoredFile&)>& look,
                    const std::function<void(std::size_t done, std::size_t total)>& progress = {}) const;
    /// Writes files anywhere below the course's folder, as write_files_atomically does. Their temporary files lie in
    /// files/, so that opening the course finds leftovers without searching all folders.
    void write(const std::vector<NewFile>& files) const;
    /// Within a transaction: the store speaks of this content from now on.
    void register_file(const std::string& hash, std::int64_t bytes, Instant at);
    std::filesystem::path file(const std::string& hash) const;
    /// A named setting of a command; empty if it was never set. Setting it requires a transaction.
    std::string saved_entry(const std::string& key);
    void save_entry(const std::string& key, const std::string& value);
    /// Within a transaction: a line in the journal.
    void note(const std::string& what, Instant at = CourseClock::now());

  private:
    std::string setting(const char* key);
    void keep_in_batches(const std::vector<std::filesystem::path>& files, std::vector<StoredFile>& kept,
                         const std::function<void(std::size_t)>& notify, const std::stop_token& stop) const;

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> leftovers_;
    Database database_;
    bool migrated_ = false;  ///< from the tables of an earlier version
    std::string name_;
    CourseClock clock_;
    std::string key_;
    SigningKey signing_key_;
};

}  // namespace dynlab::inline course
