#include "course/store/receipts.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "platform/error.h"
#include "platform/hash.h"
#include "platform/terminal/terminal_text.h"

namespace dynlab::inline course {
namespace {

constexpr std::string_view kSignature = "signature: ", kHash = "sha256: ", kPublicKey = "public key: ";
constexpr std::size_t kCodeDigits = 64;

std::string_view first_line(ReceiptKind kind) {
    return kind == ReceiptKind::kSigned ? "dynlab receipt 2" : "dynlab receipt 1";
}

/// A receipt's file taken apart; the signature is its last line.
struct ReceiptFile {
    std::string content, signature, public_key;
    ReceiptKind kind = ReceiptKind::kSigned;
};

/// Nothing for any other text.
std::optional<ReceiptFile> read_receipt(std::string_view text) {
    ReceiptFile file;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);) {
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty()) continue;
        if (!file.signature.empty()) return {};
        if (line.starts_with(kSignature))
            file.signature = line.substr(kSignature.size());
        else if (line.starts_with(kPublicKey) && file.public_key.empty())
            file.public_key = line.substr(kPublicKey.size());
        else
            file.content += line + '\n';
    }
    const std::string_view first = std::string_view(file.content).substr(0, file.content.find('\n'));
    if (first != first_line(ReceiptKind::kSigned) && first != first_line(ReceiptKind::kCoded)) return {};
    if (first == first_line(ReceiptKind::kCoded)) file.kind = ReceiptKind::kCoded;
    return file;
}

const ReceiptCheck kGenuine{true, "genuine"};
const ReceiptCheck kNoReceipt{false, "NOT genuine: this is not a receipt"};
const ReceiptCheck kNotGenuine{false, "NOT genuine: altered, or signed by another course"};
const ReceiptCheck kNeedsCourse{false,
                                "cannot be decided: the receipt has a code instead of a signature, from an early "
                                "version of dynlab; only the course can verify it (dynlab course verify)"};

ReceiptCheck verify_signature(const ReceiptFile& file, std::string_view public_key) {
    const bool other_key = !file.public_key.empty() && file.public_key != public_key;
    return !other_key && is_signature(file.signature, file.content, public_key) ? kGenuine : kNotGenuine;
}

/// A genuine receipt that is shown again although the store knows better.
ReceiptCheck genuine_until_now(const ReceiptFile& file, Course& course) {
    Rows rows = course.database().query(
        "WITH shown AS (SELECT id AS version, 0 AS arrival FROM versions WHERE signature = ?1 UNION ALL SELECT "
        "version, "
        "id FROM arrivals WHERE signature = ?1) SELECT v.withdrawn, "
        "EXISTS (SELECT 1 FROM arrivals c WHERE c.version = v.id AND c.id > shown.arrival), "
        "EXISTS (SELECT 1 FROM arrived n WHERE NOT n.withdrawn AND n.number > v.number AND n.assignment = v.assignment "
        "AND n.group_id IS v.group_id AND n.stage = v.stage AND n.pair IS v.pair AND n.part = v.part) "
        "FROM shown JOIN arrived v ON v.id = shown.version",
        file.signature);
    if (!rows.next()) return kGenuine;
    if (rows.integer(0)) return {true, "genuine, but the file was withdrawn"};
    if (rows.integer(1)) return {true, "genuine, but the time was corrected; a newer receipt is valid"};
    return rows.integer(2) ? ReceiptCheck{true, "genuine, but a newer version was submitted"} : kGenuine;
}

}  // namespace

std::string receipt_text(const Receipt& receipt, ReceiptKind kind) {
    return fmt::format(
        "{}\n{}course: {}\nassignment: {}\ngroup: {}\nhanded in as: {}, {}, version {}\nfile: {}\n"
        "{}{}\nbytes: {}\nreceived: {}\ndue: {}\nlate: {}\n",
        first_line(kind), receipt.correction > 0 ? fmt::format("correction: {}\n", receipt.correction) : "",
        terminal_line(receipt.course), terminal_line(receipt.assignment), terminal_line(receipt.group), receipt.stage,
        receipt.part, receipt.version, terminal_line(receipt.name), kHash, receipt.hash, receipt.bytes,
        utc_text(receipt.received), utc_text(receipt.due), receipt.late > 0 ? duration_text(receipt.late) : "no");
}

std::string signed_receipt(const Receipt& receipt, const SigningKey& key) {
    const std::string text = receipt_text(receipt);
    return fmt::format("{}{}{}\n{}{}\n", text, kPublicKey, key.public_key(), kSignature, key.sign(text));
}

ReceiptCheck verify_receipt(std::string_view text, std::string_view public_key) {
    const auto file = read_receipt(text);
    if (!file) return kNoReceipt;
    return file->kind == ReceiptKind::kCoded ? kNeedsCourse : verify_signature(*file, public_key);
}

ReceiptCheck verify_receipt(std::string_view text, Course& course) {
    const auto file = read_receipt(text);
    if (!file) return kNoReceipt;
    const bool genuine = file->kind == ReceiptKind::kSigned
                             ? verify_signature(*file, course.signing_key().public_key()).genuine
                             : equal_in_constant_time(file->signature, hmac_sha256(course.key(), {file->content}));
    return genuine ? genuine_until_now(*file, course) : kNotGenuine;
}

std::string signed_part(std::string_view text) {
    const auto file = read_receipt(text);
    return file ? file->content : "";
}

std::string key_in_receipt(std::string_view text) {
    const auto file = read_receipt(text);
    return file ? file->public_key : "";
}

bool is_receipt_for(std::string_view text, const std::filesystem::path& file) {
    const std::string hash = fmt::format("\n{}{}\n", kHash, sha256_of_file(file));
    const auto receipt = read_receipt(text);
    return receipt && receipt->content.find(hash) != std::string::npos;
}

std::string version_signature(const Course& course, const Receipt& receipt) {
    return course.signing_key().sign(receipt_text(receipt));
}

bool is_version_signature(const Course& course, const Receipt& receipt, std::string_view signature) {
    if (signature.size() == kCodeDigits)
        return equal_in_constant_time(signature,
                                      hmac_sha256(course.key(), {receipt_text(receipt, ReceiptKind::kCoded)}));
    return is_signature(signature, receipt_text(receipt), course.signing_key().public_key());
}

Receipt receipt_of(Course& course, std::int64_t version, std::optional<std::int64_t> correction) {
    Database& db = course.database();
    Rows rows = db.query(
        "SELECT a.name, g.name, v.stage, v.part, v.name, v.hash, v.number, f.bytes, v.late, v.received_at, v.due_at "
        "FROM versions v JOIN assignments a ON a.id = v.assignment LEFT JOIN groups g ON g.id = v.group_id "
        "JOIN files f ON f.hash = v.hash WHERE v.id = ?",
        version);
    if (!rows.next()) throw EnvironmentError("this course has no submitted version with the number {}", version);
    Receipt receipt{course.name(),   rows.text(0),    rows.text(1),    rows.text(2),
                    rows.text(3),    rows.text(4),    rows.text(5),    rows.integer(6),
                    rows.integer(7), rows.integer(8), rows.integer(9), rows.integer(10)};
    Rows corrected = db.query("SELECT received_at, due_at, late FROM arrivals WHERE version = ? ORDER BY id", version);
    while (receipt.correction != correction && corrected.next()) {
        ++receipt.correction;
        receipt.received = corrected.integer(0), receipt.due = corrected.integer(1);
        receipt.late = corrected.integer(2);
    }
    return receipt;
}

std::vector<std::filesystem::path> write_receipts(Course& course, const std::vector<std::int64_t>& versions) {
    std::vector<NewFile> files;
    std::vector<std::filesystem::path> places;
    for (const std::int64_t version : versions) {
        const Receipt receipt = receipt_of(course, version);
        const std::filesystem::path folder = course.folder() / "receipts" / receipt.assignment;
        std::filesystem::create_directories(folder);
        places.push_back(folder /
                         fmt::format("{:05}-{}-{}-{}{}.txt", version, receipt.group, receipt.stage, receipt.part,
                                     receipt.correction > 0 ? fmt::format("-corrected-{}", receipt.correction) : ""));
        const bool twice = std::ranges::find(files, places.back(), &NewFile::file) != files.end();
        if (!std::filesystem::exists(places.back()) && !twice)
            files.push_back({places.back(), signed_receipt(receipt, course.signing_key())});
    }
    course.write(files);
    return places;
}

}  // namespace dynlab::inline course
