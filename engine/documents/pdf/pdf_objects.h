#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "documents/pdf/pdf_layout.h"
#include "platform/box.h"

namespace dynlab::inline documents {

/// How PDFs from anybody are given to qpdf: in a box, with limits.
struct PdfObjectLimits {
    Isolation isolation = strongest_isolation();
    std::uint64_t memory_bytes = 3ull << 30, output_bytes = 400ull << 20;
    std::chrono::milliseconds time{20'000};
};

enum class StreamForm {
    kDecoded,  ///< as far as nothing is lost; photographs (DCT, JPX) stay as they are
    kAsStored  ///< the bytes of the file
};

/// All objects of a PDF, referred to or not, as qpdf's JSON (version 2): {"pages": [...], "qpdf": [{...}, {"obj:4 0 R":
/// {"value": ...} | {"stream": {"dict": ..., "data": base64}}, ..., "trailer": ...}]}. Throws PdfRefusal whose sentence
/// does not name the file, MissingProgram without qpdf.
std::string pdf_objects(const std::filesystem::path& file, StreamForm form, const PdfObjectLimits& limits);

/// The PDF with some objects in another form, or the PDF that `objects` alone describe when `file` is empty, without
/// what is not referred to; equal input gives equal bytes. Throws like pdf_objects.
std::string pdf_with_objects(const std::filesystem::path& file, const std::string& objects,
                             const PdfObjectLimits& limits);

std::string bytes_of_base64(const std::string& text);  ///< up to the first character that is none of base64
std::string base64_of(const std::string& bytes);

}  // namespace dynlab::inline documents
