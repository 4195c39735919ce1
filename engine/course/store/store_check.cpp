#include "course/store/store_check.h"

#include <re2/re2.h>

#include <map>
#include <set>

#include "course/store/receipts.h"
#include "course/store/store_seal.h"
#include "platform/atomic_file.h"
#include "platform/hash.h"

namespace dynlab::inline course {

namespace {

namespace fs = std::filesystem;

/// Every receipt that the store would give today or gave before.
std::set<std::string> receipts_given(Course& course) {
    std::set<std::string> texts;
    const auto add = [&](const Receipt& receipt) {
        for (const ReceiptKind kind : {ReceiptKind::kSigned, ReceiptKind::kCoded})
            texts.insert(receipt_text(receipt, kind));
    };
    for (Rows rows = course.database().query("SELECT id FROM versions"); rows.next();)
        add(receipt_of(course, rows.integer(0), 0));
    std::map<std::int64_t, std::int64_t> number;
    for (Rows rows = course.database().query("SELECT version FROM arrivals ORDER BY id"); rows.next();)
        add(receipt_of(course, rows.integer(0), ++number[rows.integer(0)]));
    return texts;
}

void check_receipts(Course& course, StoreCheck& check) {
    const fs::path folder = course.folder() / "receipts";
    if (!fs::exists(folder)) return;
    const std::set<std::string> given = receipts_given(course);
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file() || entry.path().extension() != ".txt") continue;
        const std::string text = read_file(entry.path());
        if (!verify_receipt(text, course).genuine)
            check.error_list.push_back(Message("{} is not a genuine receipt", entry.path().string()));
        else if (!given.contains(signed_part(text)))
            check.error_list.push_back(Message(
                "{} is genuine, but its file is no longer in the store; restore a backup", entry.path().string()));
    }
}

void check_signatures(Course& course, StoreCheck& check) {
    Database& db = course.database();
    for (Rows rows = db.query("SELECT id, signature FROM versions ORDER BY id"); rows.next(); ++check.versions)
        if (!is_version_signature(course, receipt_of(course, rows.integer(0), 0), rows.text(1)))
            check.error_list.push_back(
                Message("version {}: the data differ from the signed data; restore a backup", rows.integer(0)));
    std::map<std::int64_t, std::int64_t> number;
    for (Rows rows = db.query("SELECT version, signature FROM arrivals ORDER BY id"); rows.next();) {
        const std::int64_t version = rows.integer(0), correction = ++number[version];
        if (!is_version_signature(course, receipt_of(course, version, correction), rows.text(1)))
            check.error_list.push_back(
                Message("version {}: the correction {} differs from the signed correction; restore a backup", version,
                        correction));
    }
}

/// Those that were removed when the course was opened, and those of earlier versions: ".HASH.PID-N" beside the files.
void check_leftovers(const Course& course, StoreCheck& check) {
    for (const fs::path& file : course.removed_leftovers())
        check.leftovers.push_back(Message("removed {}, left by an interrupted run", file.string()));
    static const RE2 earlier(R"(\..+\.[0-9]+-[0-9]+)", RE2::Latin1);
    for (const char* own : {"files", "receipts"}) {
        const fs::path folder = course.folder() / own;
        if (!fs::exists(folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (RE2::FullMatch(name, earlier) && name.find(".dynlab-") == std::string::npos)
                check.leftovers.push_back(
                    Message("{} is a temporary file of an earlier, interrupted run of dynlab; remove the file",
                            entry.path().string()));
        }
    }
}

}  // namespace

StoreCheck check_store(Course& course) {
    StoreCheck check;
    check_leftovers(course, check);
    Database& db = course.database();
    for (Rows rows = db.query("PRAGMA integrity_check"); rows.next();)
        if (rows.text(0) != "ok")
            check.error_list.push_back(Message("the database is damaged: {}. Restore a backup", rows.text(0)));
    for (Rows rows = db.query("PRAGMA foreign_key_check"); rows.next();)
        check.error_list.push_back(
            Message("the database is damaged: a row of {} refers to a missing row. Restore a backup", rows.text(0)));
    for (Rows rows = db.query("SELECT hash FROM files ORDER BY hash"); rows.next(); ++check.files) {
        const auto file = course.file(rows.text(0));
        if (!std::filesystem::exists(file))
            check.error_list.push_back(Message("{} is missing; restore it from a backup", file.string()));
        else if (sha256_of_file(file) != rows.text(0))
            check.error_list.push_back(Message("{} was altered; restore it from a backup", file.string()));
    }
    check_signatures(course, check);
    check_receipts(course, check);
    for (const std::string& error_reason : seal_errors(db, course.signing_key().public_key()))
        check.error_list.push_back(Message::verbatim(error_reason));
    return check;
}

}  // namespace dynlab::inline course
