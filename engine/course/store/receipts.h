#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "course/store/course_store.h"

namespace dynlab::inline course {

/// A group's receipt for a submitted file: the signed lines.
struct Receipt {
    std::string course, assignment, group, stage, part, name, hash;
    std::int64_t version = 0, bytes = 0, late = 0;
    Instant received = 0, due = 0;
    std::int64_t correction = 0;  ///< which one it is of the first receipt; 0 for that one itself
};

/// The first line says how a receipt is signed: by Ed25519, so that everybody with the course's public key can verify
/// it, or, as courses did before, by a code (HMAC) that only the course itself can verify.
enum class ReceiptKind { kSigned, kCoded };

/// One "key: value" a line, always in the same order, control characters as blanks: equal facts give equal text.
std::string receipt_text(const Receipt& receipt, ReceiptKind kind = ReceiptKind::kSigned);

/// The receipt as a file: its text, a line "public key: ..." that is not signed, and a line "signature: ...".
std::string signed_receipt(const Receipt& receipt, const SigningKey& key);

/// Result of the verification of a receipt: "genuine", or the reason why it is not genuine.
struct ReceiptCheck {
    bool genuine = false;
    std::string reason;
};

/// Whether this text is a receipt that the owner of this public key signed, not a letter changed (line ends and blank
/// lines aside). Coded receipts are recognized: they need the course.
ReceiptCheck verify_receipt(std::string_view text, std::string_view public_key);
/// The same by the course itself, coded receipts too. Of a genuine receipt that is not valid any more the reason says
/// so: its file was withdrawn, its time corrected, or a newer version submitted.
ReceiptCheck verify_receipt(std::string_view text, Course& course);
/// The lines that are signed; empty for what is no receipt.
std::string signed_part(std::string_view text);
/// The public key that a receipt names itself: who trusts it needs to know it from elsewhere. Empty where there is
/// none.
std::string key_in_receipt(std::string_view text);
/// Whether the receipt is for this file: the SHA-256 it names is the file's. Throws EnvironmentError when that cannot
/// be read.
bool is_receipt_for(std::string_view text, const std::filesystem::path& file);

/// The signature or code of a version's facts, as the store keeps it, and whether it is theirs.
std::string version_signature(const Course& course, const Receipt& receipt);
bool is_version_signature(const Course& course, const Receipt& receipt, std::string_view signature);

/// The receipt of a version, from the store: with the newest correction, or the one with this number. Throws
/// EnvironmentError for an unknown one.
Receipt receipt_of(Course& course, std::int64_t version, std::optional<std::int64_t> correction = {});

/// Writes the receipts of versions, with their newest corrections, into receipts/ASSIGNMENT/ where they are not there
/// yet; returns the files.
std::vector<std::filesystem::path> write_receipts(Course& course, const std::vector<std::int64_t>& versions);

}  // namespace dynlab::inline course
