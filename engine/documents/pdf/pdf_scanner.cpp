#include "documents/pdf/pdf_scanner.h"

#include <algorithm>
#include <charconv>

namespace dynlab::inline documents {
namespace {

constexpr int kDeepest = 50;
constexpr std::string_view kSpace("\0\t\n\f\r ", 6), kDelimiters = "()<>[]{}/%";

}  // namespace

PdfScanner::PdfScanner(std::string_view bytes, std::size_t at) : bytes_(bytes), at_(at) {
    if (at > bytes.size()) throw UnusualPdf();
}

bool PdfScanner::takes(std::string_view sign) {
    skip_space();
    const bool here = bytes_.substr(at_, sign.size()) == sign;
    if (here) at_ += sign.size();
    return here;
}

void PdfScanner::expect(std::string_view sign) {
    if (!takes(sign)) throw UnusualPdf();
}

std::size_t PdfScanner::number() {
    skip_space();
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(bytes_.data() + at_, bytes_.data() + bytes_.size(), value);
    if (error != std::errc()) throw UnusualPdf();
    at_ = static_cast<std::size_t>(end - bytes_.data());
    return value;
}

std::string_view PdfScanner::value_at_depth(int depth) {
    if (depth > kDeepest) throw UnusualPdf();
    skip_space();
    const std::size_t start = at_;
    if (takes("<<")) {
        while (!takes(">>")) value_at_depth(depth + 1);
    } else if (takes("[")) {
        while (!takes("]")) value_at_depth(depth + 1);
    } else if (takes("(")) {
        skip_string();
    } else if (takes("<")) {
        at_ = std::min(bytes_.find('>', at_), bytes_.size() - 1) + 1;
    } else if (takes("/")) {
        skip_word();
    } else {
        skip_word();
        if (at_ == start) throw UnusualPdf();
        skip_rest_of_reference(bytes_.substr(start, at_ - start));
    }
    return bytes_.substr(start, at_ - start);
}

PdfEntries PdfScanner::dictionary() {
    PdfEntries entries;
    expect("<<");
    while (!takes(">>")) {
        const std::string_view key = value(), entry = value();
        const bool plain = key.starts_with('/') && key.find('#') == key.npos;
        if (!plain || !entries.emplace(key, entry).second) throw UnusualPdf();
    }
    return entries;
}

void PdfScanner::end_line() {
    if (bytes_.substr(at_, 2) == "\r\n") ++at_;
    if (bytes_.substr(at_, 1) != "\n") throw UnusualPdf();
    ++at_;
}

void PdfScanner::skip_space() {
    while (at_ < bytes_.size() && (is_one_of(kSpace) || bytes_[at_] == '%'))
        at_ = bytes_[at_] == '%' ? std::min(bytes_.find_first_of("\r\n", at_), bytes_.size()) : at_ + 1;
}

void PdfScanner::skip_word() {
    while (at_ < bytes_.size() && !is_one_of(kSpace) && !is_one_of(kDelimiters)) ++at_;
}

void PdfScanner::skip_string() {
    for (int open = 1; open > 0; ++at_) {
        if (at_ >= bytes_.size()) throw UnusualPdf();
        open += bytes_[at_] == '(' ? 1 : bytes_[at_] == ')' ? -1 : 0;
        if (bytes_[at_] == '\\') ++at_;
    }
}

void PdfScanner::skip_rest_of_reference(std::string_view first) {
    if (first.find_first_not_of("0123456789") != first.npos) return;
    const std::size_t before = at_;
    skip_space();
    const std::size_t generation = at_;
    skip_word();
    const bool two = at_ > generation && bytes_.substr(generation, at_ - generation).find_first_not_of("0123456789") ==
                                             std::string_view::npos;
    skip_space();
    const std::size_t sign = at_;
    skip_word();
    if (!two || bytes_.substr(sign, at_ - sign) != "R") at_ = before;
}

bool PdfScanner::is_one_of(std::string_view set) const {
    return set.find(bytes_[at_]) != set.npos;
}

}  // namespace dynlab::inline documents
