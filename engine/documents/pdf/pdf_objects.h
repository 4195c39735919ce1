#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "documents/pdf/pdf_refusal.h"

class QPDF;
class QPDFObjectHandle;
class QPDFWriter;

namespace dynlab::inline documents {

/// What looking inside a PDF from somebody else may cost; `bytes_inside` of a stream that is written out, and of the
/// answer.
struct PdfObjectLimits {
    std::uint64_t memory_bytes = 3ull << 30, bytes_inside = 400ull << 20;
    std::chrono::milliseconds time{20'000};
};

/// Work on the objects of a PDF as libqpdf reads them; `bytes` are those of the file.
using PdfWork = std::function<std::string(QPDF& pdf, const std::string& bytes)>;
/// Does it in a process of its own with limits, which can reach nothing but its memory, and returns its answer. Throws
/// PdfRefusal, also those of the work.
std::string work_on_pdf_objects(const std::filesystem::path& file, const PdfObjectLimits& limits, const PdfWork& work);

/// For use in such work: reads a PDF, mending what is damaged without a word. Throws QPDFExc where that cannot be done.
void read_pdf(QPDF& pdf, const std::string& bytes);

/// What a stream holds, decoded as far as nothing is lost (photographs stay as they are, and damaged streams).
struct StreamContent {
    std::string bytes;
    bool decoded = false;
};
/// Throws PdfRefusal for more than `most` bytes.
StreamContent stream_content(QPDFObjectHandle stream, std::uint64_t most);
/// The bytes in the file, decrypted.
std::string stored_bytes(QPDFObjectHandle stream);

/// The PDF as one file, without what nothing refers to; equal objects give equal bytes. Throws PdfRefusal for more than
/// `most` bytes.
std::string written_pdf(QPDF& pdf, std::uint64_t most, const std::function<void(QPDFWriter&)>& choose = {});

}  // namespace dynlab::inline documents
