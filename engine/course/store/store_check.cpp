#include "course/store/store_check.h"

#include <fmt/format.h>

#include "course/store/receipts.h"
#include "platform/hash.h"

namespace dynlab::inline course {

StoreCheck check_store(Course& course) {
    StoreCheck check;
    Database& db = course.database();
    for (Rows rows = db.query("PRAGMA integrity_check"); rows.next();)
        if (rows.text(0) != "ok") check.troubles.push_back("the database: " + rows.text(0));
    for (Rows rows = db.query("PRAGMA foreign_key_check"); rows.next();)
        check.troubles.push_back(fmt::format("the database: a row of {} refers to nothing", rows.text(0)));
    for (Rows rows = db.query("SELECT hash FROM files ORDER BY hash"); rows.next(); ++check.files) {
        const auto file = course.file(rows.text(0));
        if (!std::filesystem::exists(file))
            check.troubles.push_back(fmt::format("{} is missing; put it back from a backup", file.string()));
        else if (sha256_of_file(file) != rows.text(0))
            check.troubles.push_back(fmt::format("{} was altered; put it back from a backup", file.string()));
    }
    for (Rows rows = db.query("SELECT id, signature FROM versions ORDER BY id"); rows.next(); ++check.versions)
        if (!is_version_signature(course, receipt_of(course, rows.integer(0)), rows.text(1)))
            check.troubles.push_back(
                fmt::format("version {}: its facts are not those that were signed", rows.integer(0)));
    return check;
}

}  // namespace dynlab::inline course
