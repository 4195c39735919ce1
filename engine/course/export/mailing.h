#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "data_io/text_table.h"

namespace dynlab::inline course {

/// A person who receives files, with the identifiers that the learning platform uses.
struct Recipient {
    std::string id, name, group, mail, moodle;  ///< what is not known is empty
    const std::string& shown() const { return name.empty() ? id : name; }
};

/// What one person gets.
struct Mailing {
    Recipient to;
    std::vector<std::string> files;  ///< relative to the folder of the list
    bool is_new = true;              ///< some of it was not sent before
};

/// The list for a mailing program, one row per person: id, name, group, mail, files (separated by "; "), new (yes or
/// no).
TextTable mailing_list(const std::vector<Mailing>& mailings);

/// Moodle's zip of feedback files (the assignment's "Upload multiple feedback files in a zip"): a folder
/// NAME_NUMBER_assignfeedback_file_ for each participant. Moodle's importer splits the folder's name at its underlines
/// and reads the number behind the first; releases before 4.1 want the one at the end.
class MoodleFeedback {
  public:
    /// False where the person's number is not known; nothing is added then.
    bool add(const Recipient& to, const std::string& file, const std::string& content);
    bool empty() const { return contents_.empty(); }
    void write(const std::filesystem::path& zip) const;

  private:
    std::map<std::string, std::string> contents_;
};

}  // namespace dynlab::inline course
