#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "course/store/assignments.h"
#include "course/store/groups.h"
#include "course/store/incoming.h"

namespace dynlab::inline course {

/// What receive is asked to do.
struct ReceiveRequest {
    std::vector<std::filesystem::path> files;
    std::string assignment, stage = "first";  ///< "first", "review", "final"
    std::string from;                         ///< a group; empty: by the files' names
    std::vector<std::string> of;  ///< of reviews: the report's pseudonym for each file; empty: by the files' names
    Instant at = 0;               ///< time of receipt, if `time_of` returns none
    std::function<std::optional<Instant>(const IncomingFile&)> time_of;  ///< may be empty (intake/arrival_times.h)
    std::map<std::string, std::string> numbers;  ///< of participants by student, instead of the roster's
    Isolation level = Isolation::kFull;
    std::filesystem::path program;
    bool take_as_first = false;  ///< a first version even when the group's report was reviewed already
    bool checks = true;          ///< look at PDFs as dynlab check does
    std::function<void(std::size_t done, std::size_t total)> progress;
};

/// One file that was taken.
struct Received {
    std::string group, part, about;  ///< about: of a review, the pseudonym of the report
    std::int64_t version = 0, id = 0;
    std::int64_t late = 0;     ///< of its content, which may be that of an earlier version
    double waiting = 0;        ///< percent that its lateness costs once the instructor confirms the time of receipt
    bool known = false;        ///< the same content as the version before: nothing was changed
    bool voluntary = false;    ///< a review of a report that had been taken back
    bool from_pack = false;    ///< a PDF that was taken out of the group's pack
    bool withdrawn = false;    ///< known, and withdrawn by the instructor
    std::string twin;          ///< whose the same bytes are: "group-02's", "a review by group-02"
    bool made = false;         ///< that PDF was made here, as the pack has none
    Message missing;           ///< of a pack without the PDF that is wanted, a clause: "no PDF in the pack"
    std::string earlier;       ///< when an earlier version with the same content came: "v1 of Sat 2026-02-28 12:00"
    std::string other_time;    ///< of a known file: when it came by `time_of`, where the store says another time
    Message remark;            ///< name and content differ, a clause
    bool marked_late = false;  ///< the platform wrote LATE into the name, though the time says nothing of it
    int scores = 0;            ///< that the pack of a review brought
    int rules_broken = 0;
    bool names = false;        ///< of a review: it names a member of the course
    std::string error_reason;  ///< when the file cannot be read: "damaged"
};

struct ReceiveOutcome {
    Assignment assignment;
    std::vector<Received> received;
    std::vector<Message> refused;    ///< sentences, one a file that was not taken
    std::filesystem::path receipts;  ///< folder with a receipt for each
};

/// Receives submissions into the course, all acceptable ones in one transaction. A group's wrong file never stops the
/// files of other groups; if the request contains a single file, its error is thrown instead. Files are stored before
/// the transaction and receipts are written after it, so that a crash loses nothing and the same command completes the
/// work.
ReceiveOutcome receive(Course& course, const ReceiveRequest& request);

}  // namespace dynlab::inline course
