#pragma once
#include <set>
#include <string>
#include <vector>

#include "base/message.h"
#include "course/intake/roster.h"
#include "course/names/name_tokens.h"

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
    bool labelled = false;    ///< counts behind "student", "ID" and their like only
    bool spaced = true;       ///< parts may stand apart: "group 01", but not "group 1", which counts something
    std::string initials;     ///< of the given names, for a surname alone
    bool own = false;         ///< of one of the document's own authors
    bool initialled = false;  ///< a name and an initial, written with a point or a comma: "B. Li", "Wu, M.", "Ada L."
    bool connected = false;   ///< two people of a group, who may be joined by a word: "Wu & Li", "Ada and Grace"
    bool bare = false;        ///< a group's number without its zeros: "Group 1", "team1", but not "group 1"
};

/// All ways in which the student's name, number, group and the account in the mail address are looked for.
std::vector<NamePattern> patterns_of(const Student& student, bool own);

/// Whether a student's number is looked for: one of fewer than three letters and digits stands in every document.
bool is_sought_number(const std::string& id);
/// Says whose numbers are not looked for; empty where all are.
Message unsought_numbers(const std::vector<Student>& students);

/// Ways in which two authors of one document are named together, each by surname or given name only.
std::vector<NamePattern> patterns_of_pair(const Student& one, const Student& other);

/// A name that stands in documents with another meaning: an ordinary word in English or French, a name of the field.
bool is_ordinary_word(const std::string& folded);

}  // namespace dynlab::inline course
