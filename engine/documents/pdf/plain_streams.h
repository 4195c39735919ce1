#pragma once
#include <string>

namespace dynlab::inline documents {

/// The same PDF with its compressed streams written out, fonts, pages and packed objects; pictures and embedded files
/// stay as they are. poppler reads it with equal outcome in a fraction of the time, as it inflates slowly and each font
/// again for each page. A file that is encrypted, or damaged in any way that libqpdf notices, comes back as it is; so
/// stays each stream that cannot be decoded, whose data lie elsewhere, and what is beyond 64 MB.
std::string with_plain_streams(std::string pdf);

}  // namespace dynlab::inline documents
