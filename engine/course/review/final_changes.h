#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "course/review/remark_traces.h"
#include "course/review/text_changes.h"
#include "course/review/value_changes.h"
#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "platform/box.h"

namespace dynlab::inline course {

/// A file of a first or final version.
struct ReceivedFile {
    std::string stage, part, name, hash;
    std::int64_t id = 0, number = 0, late = 0;
    Instant at = 0;
    bool compared = false;  ///< one of the two versions that are compared
};

struct AnsweredRemark {
    Remark remark;
    std::vector<RemarkMatch> traces;
};

/// A review as its authors got it.
struct AnsweredReview {
    std::string reviewer;  ///< the pseudonym
    Instant released = 0;
    std::vector<AnsweredRemark> remarks;
    Message trouble;  ///< a sentence, when its text cannot be read
};

/// What a group made of its report between the first and the final version.
struct GroupChanges {
    std::string group;
    bool dropped_out = false;  ///< dropped out
    std::vector<ReceivedFile> received;
    bool has_first = false, has_final = false, same_files = false;
    std::optional<int> pages_before, pages_after;
    std::optional<TextChanges> text;
    Message compared;                    ///< what was compared: a sentence
    std::optional<ValueChanges> values;  ///< where both versions were handed in as packs
    std::vector<AnsweredReview> reviews;
    std::vector<Message> troubles;  ///< sentences

    int traced() const;    ///< remarks that ask for an answer and have a trace
    int untraced() const;  ///< those that have none
};

struct FinalChangesRequest {
    std::vector<std::string> groups;  ///< all unless named
    Isolation level = Isolation::kFull;
    std::filesystem::path program;
    std::function<void(std::size_t done, std::size_t total)> progress;
};

/// Compares final versions with those that reviewers read (the newest first version where none was sent), and looks in
/// the changes for traces of every released review. Groups who handed in nothing are left out. Changes nothing in the
/// store. Throws InvalidArgument for a talk or an unknown group.
std::vector<GroupChanges> final_changes(Course& course, const Assignment& assignment,
                                        const FinalChangesRequest& request);

/// As a table for the terminal, a row a group, and sums.
std::string final_changes_table(const Assignment& assignment, const std::vector<GroupChanges>& groups);

}  // namespace dynlab::inline course
