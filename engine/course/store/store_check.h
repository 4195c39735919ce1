#pragma once
#include <string>
#include <vector>

#include "course/store/course_store.h"

namespace dynlab::inline course {

struct StoreCheck {
    int files = 0, versions = 0;
    std::vector<std::string> troubles;  ///< sentences; none when all is well
};

/// Whether the database is whole, every file it speaks of is there and has its hash, and every version's signature is
/// that of its receipt.
StoreCheck check_store(Course& course);

}  // namespace dynlab::inline course
