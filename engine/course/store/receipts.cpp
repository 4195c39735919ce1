#include "course/store/receipts.h"

#include <fmt/format.h>
#include <sodium/crypto_auth_hmacsha256.h>
#include <sodium/utils.h>

#include <array>
#include <sstream>

#include "platform/error.h"

namespace dynlab::inline course {
namespace {

constexpr std::string_view kSignature = "signature: ";

/// The same time whatever the first difference, so that nobody can guess a signature digit by digit.
bool equal_digits(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    int difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) difference |= a[i] ^ b[i];
    return difference == 0;
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
    return text;
}

}  // namespace

std::string hmac_sha256(std::string_view key, std::string_view message) {
    const auto bytes = [](std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); };
    crypto_auth_hmacsha256_state state;
    crypto_auth_hmacsha256_init(&state, bytes(key), key.size());
    crypto_auth_hmacsha256_update(&state, bytes(message), message.size());
    std::array<unsigned char, crypto_auth_hmacsha256_BYTES> code;
    crypto_auth_hmacsha256_final(&state, code.data());
    std::array<char, 2 * code.size() + 1> digits;
    return sodium_bin2hex(digits.data(), digits.size(), code.data(), code.size());
}

std::string receipt_text(const Receipt& receipt) {
    return fmt::format(
        "dynlab receipt 1\ncourse: {}\nassignment: {}\ngroup: {}\nhanded in as: {}, {}, version {}\nfile: {}\n"
        "sha256: {}\nbytes: {}\nreceived: {}\ndue: {}\nlate: {}\n",
        one_line(receipt.course), one_line(receipt.assignment), one_line(receipt.group), receipt.stage, receipt.part,
        receipt.version, one_line(receipt.name), receipt.hash, receipt.bytes, utc_text(receipt.received),
        utc_text(receipt.due), receipt.late > 0 ? duration_text(receipt.late) : "no");
}

std::string signed_receipt(const Receipt& receipt, std::string_view key) {
    const std::string text = receipt_text(receipt);
    return fmt::format("{}{}{}\n", text, kSignature, hmac_sha256(key, text));
}

bool receipt_is_genuine(std::string_view text, std::string_view key) {
    std::string content, signature;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);) {
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty()) continue;
        if (!signature.empty()) return false;  // the signature is the last line
        if (line.starts_with(kSignature))
            signature = line.substr(kSignature.size());
        else
            content += line + '\n';
    }
    return equal_digits(signature, hmac_sha256(key, content));
}

Receipt receipt_of(Course& course, std::int64_t version) {
    Rows rows = course.database().query(
        "SELECT a.name, g.name, v.stage, v.part, v.name, v.hash, v.number, f.bytes, v.late, v.received_at, v.due_at "
        "FROM versions v JOIN assignments a ON a.id = v.assignment JOIN groups g ON g.id = v.group_id "
        "JOIN files f ON f.hash = v.hash WHERE v.id = ?",
        version);
    if (!rows.next()) throw EnvironmentError(fmt::format("there is no version {} in this course", version));
    return {course.name(), rows.text(0),    rows.text(1),    rows.text(2),    rows.text(3),    rows.text(4),
            rows.text(5),  rows.integer(6), rows.integer(7), rows.integer(8), rows.integer(9), rows.integer(10)};
}

}  // namespace dynlab::inline course
