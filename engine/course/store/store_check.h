#pragma once
#include <string>
#include <vector>

#include "course/store/course_store.h"

namespace dynlab::inline course {

struct StoreCheck {
    int files = 0, versions = 0;
    std::vector<Message> error_list;  ///< sentences; none when all is well
    std::vector<Message> leftovers;   ///< sentences: temporary files and folders of killed runs
};

/// Checks the integrity of the store: the database is intact; every referenced file exists and has its hash; the
/// signatures of versions and amendments match their receipts; every receipt in receipts/ is one that the store would
/// write; and the tables match their seals. Versions that were removed and pairs, marks and sendings that another
/// program changed are reported.
StoreCheck check_store(Course& course);

}  // namespace dynlab::inline course
