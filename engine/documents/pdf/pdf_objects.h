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

/// Limits for reading the objects of an untrusted PDF; `bytes_inside` limits a stream that is written out, and the
/// answer.
struct PdfObjectLimits {
    std::uint64_t memory_bytes = 3ull << 30, bytes_inside = 400ull << 20;
    std::chrono::milliseconds time{20'000};
};

/// Work on the objects of a PDF as libqpdf reads them; `bytes` are those of the file.
using PdfWork = std::function<std::string(QPDF& pdf, const std::string& bytes)>;
/// Does the work in a separate process with limits, which can access only its memory, and returns the answer. Throws
/// PdfRefusal, also those of the work.
std::string work_on_pdf_objects(const std::filesystem::path& file, const PdfObjectLimits& limits, const PdfWork& work);

/// For use in such work: reads a PDF, mending what is damaged without a word. Throws QPDFExc where that cannot be done.
void read_pdf(QPDF& pdf, const std::string& bytes);

/// The content of a stream, decoded if the decoding is lossless (photographs and damaged streams stay encoded).
struct StreamContent {
    std::string bytes;
    bool decoded = false;
};
/// Throws PdfRefusal for more than `max_bytes` bytes.
StreamContent stream_content(QPDFObjectHandle stream, std::uint64_t max_bytes);
/// The bytes in the file, decrypted.
std::string stored_bytes(QPDFObjectHandle stream);

/// The PDF as one file, without what nothing refers to; equal objects give equal bytes. Throws PdfRefusal for more than
/// `max_bytes` bytes.
std::string written_pdf(QPDF& pdf, std::uint64_t max_bytes, const std::function<void(QPDFWriter&)>& choose = {});

}  // namespace dynlab::inline documents
