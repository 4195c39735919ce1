#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "course/intake/roster.h"
#include "course/intake/submission.h"

namespace dynlab::inline course {

/// Finds the owner of a submission, for `grade` and `course submit`. The matcher uses names and numbers that a platform
/// or a person wrote on the outside, never the content of the work. It compares the letters of names after Unicode case
/// folding ("LEFEVRE Élise", "lefevreelise", "Müller" and "Mueller") and in any order of their parts, and groups by
/// words and numbers ("group-03", "Group 3", "gruppe_03_final"). A submission of one member belongs to the group.
class Owners {
  public:
    /// `groups`: names in addition to those of the students' groups. `students` must outlive this object.
    explicit Owners(const std::vector<Student>& students, const std::vector<std::string>& groups = {});

    /// The instructor's own list, which goes before everything else: a CSV with the column `submission` (a name, with
    /// or without an archive's ending, or a platform's number) and `group` or `id`. Throws EnvironmentError with file
    /// and line: a column misses, no such group or student, a submission twice.
    void read_list(const std::filesystem::path& file);
    /// The submissions of the list that are none of these.
    std::vector<std::string> unmatched_names(const std::vector<Submission>& submissions) const;

    struct Found {
        std::vector<std::size_t> students;  ///< places in `students`: all of the group; may be none of an empty group
        std::string group;                  ///< empty for a student without one
        bool by_prefix = false;  ///< the name is, or begins with, the owner's; otherwise it contains the owner's name
        Message error_reason;    ///< no owner, and why: "it fits several: group-1, group-2"
        bool doubtful = false;   ///< no owner, because several are possible
        bool anybody() const { return error_reason.empty(); }
    };
    /// If a name matches no owner and comes from an archive without a character set, it is also read in the character
    /// sets of other scripts. The submission belongs to an owner if all matches are the same owner.
    Found find(const Submission& submission) const;
    /// Who is called so and no more: a group in any spelling, a student's name, id, address or number of a platform, or
    /// a part of a name that only the members of one group bear.
    Found called(const std::string& name) const;

    /// All names that could have been meant, for suggestions.
    std::vector<std::string> names() const;

  private:
    using Words = std::vector<std::string>;
    /// A group, or a student without one.
    struct Owner {
        std::string name;
        std::vector<std::size_t> students;
        bool group = false;
    };
    struct Evidence {
        std::size_t begin = 0, end = 0;  ///< words of the name
        std::size_t owner = 0, student = 0;
        bool group = false;
    };
    Found as_written(const Submission& submission) const;
    std::size_t owner_of_group(const std::string& name);
    void add_person(const Student& student, std::size_t index);
    std::vector<std::size_t> owners_of(const std::vector<std::size_t>& students) const;
    std::optional<std::size_t> group_called(const std::string& name) const;
    std::vector<std::size_t> students_called(const std::string& name) const;
    std::vector<Evidence> evidence_in(const Words& words) const;
    std::vector<std::size_t> whole(const std::string& name, std::vector<std::size_t>& students) const;
    Found found(const std::vector<std::size_t>& owners, bool by_prefix = true) const;
    Found by_list(const std::vector<Submitter>& submitters) const;
    std::optional<std::size_t> listed(const Submission& submission) const;

    const std::vector<Student>& students_;
    std::vector<Owner> owners_;
    std::vector<std::size_t> owner_of_;               ///< by student
    std::map<std::string, std::size_t> group_names_;  ///< exactly as they are written
    std::multimap<Words, std::size_t> group_words_;
    std::multimap<std::string, std::size_t> joined_names_;  ///< letters of a name from each of its parts on -> student
    std::multimap<Words, std::size_t> person_words_;        ///< names and ids -> student
    std::map<std::string, std::size_t> list_;
    std::size_t longest_ = 1;  ///< words of a key
};

/// A text in words that can be compared: runs of folded letters, and numbers without leading zeros.
std::vector<std::string> name_words(std::string_view text);

/// Whether two names have the same words, in any order.
bool same_person(const std::string& a, const std::string& b);

/// "group", "Gruppe", "team" and the like.
bool is_word_for_group(const std::string& word);

}  // namespace dynlab::inline course
