#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "course/store/course_store.h"

namespace dynlab::inline course {

/// HMAC-SHA256 (RFC 2104, FIPS 198-1) as 64 lower-case hexadecimal digits.
std::string hmac_sha256(std::string_view key, std::string_view message);

/// What a group gets for a file it handed in: the lines that are signed.
struct Receipt {
    std::string course, assignment, group, stage, part, name, hash;
    std::int64_t version = 0, bytes = 0, late = 0;
    Instant received = 0, due = 0;
};

/// One "key: value" a line, always in the same order, control characters as blanks: equal facts give equal text.
std::string receipt_text(const Receipt& receipt);

/// The receipt as a file: its text and a line "signature: ...".
std::string signed_receipt(const Receipt& receipt, std::string_view key);

/// Whether this text is a receipt that this key signed, not a letter changed (line ends and blank lines aside).
bool receipt_is_genuine(std::string_view text, std::string_view key);

/// The receipt of a version, from the store. Throws EnvironmentError for an unknown one.
Receipt receipt_of(Course& course, std::int64_t version);

}  // namespace dynlab::inline course
