#pragma once
#include <set>
#include <string>
#include <vector>

#include "base/message.h"
#include "course/intake/roster.h"
#include "platform/text/name_tokens.h"

namespace dynlab::inline course {

enum class NameKind { kName, kNumber, kMail, kGroup, kHome };

/// One way in which a person's name or number may be written.
struct NamePattern {
    NameKind kind = NameKind::kName;
    std::string who;
    std::string letters;           ///< of all parts, joined
    std::set<std::size_t> breaks;  ///< offsets in `letters` between parts
    bool whole = true;             ///< all of the name: not a surname or given name alone
    bool given_only = false;
    bool reversed = false;    ///< surname first
    bool capital = false;     ///< in prose, each part begins with a capital
    bool ordinary = false;    ///< a surname alone that is also an ordinary word: "Page"
    bool labeled = false;     ///< counts only after "student", "ID" and similar words
    bool spaced = true;       ///< parts may be apart: "group 01", but not "group 1", which counts something
    std::string initials;     ///< of the given names, for a surname alone
    bool own = false;         ///< of one of the document's own authors
    bool initialled = false;  ///< a name and an initial, with a full stop or a comma: "B. Li", "Wu, M.", "Ada L."
    bool connected = false;   ///< two people of a group, whom a word may join: "Wu & Li", "Ada and Grace"
    bool bare = false;        ///< a group's number without its zeros: "Group 1", "team1", but not "group 1"
    bool account = false;     ///< counts only in paths and addresses: "~alovelace"
};

/// All ways of writing the student's name, number, group and the account in the mail address.
std::vector<NamePattern> patterns_of(const Student& student, bool own);

/// Whether documents are searched for a student's number: not if it has fewer than three letters and digits.
bool is_searched_number(const std::string& id);
/// Names the students whose numbers are too short to search for; empty if there are none.
Message numbers_too_short(const std::vector<Student>& students);

/// Ways of naming two authors of one document together, each by surname or given name only.
std::vector<NamePattern> patterns_of_pair(const Student& one, const Student& other);

/// A name as a bibliography has it: letters of the surname and of each given name.
struct CitedAuthor {
    std::string surname;
    std::vector<std::string> given;
};
CitedAuthor cited_author(const std::string& name);

}  // namespace dynlab::inline course
