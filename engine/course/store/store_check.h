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

/// Whether the database is whole, every file it speaks of is there and has its hash, every version's signature, and
/// that of every correction, is that of its receipt, every receipt in receipts/ is one that the store would write, and
/// the tables are as their seals say: versions taken away, pairs, marks and sendings changed by something else are
/// told.
StoreCheck check_store(Course& course);

}  // namespace dynlab::inline course
