#include "documents/pdf/pdf_layout.h"

#include <qpdf/QPDF.hh>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>

#include "data_io/values/cbor_values.h"
#include "documents/pdf/guarded_pdf.h"
#include "documents/pdf/pdf_document.h"
#include "documents/pdf/pdf_objects.h"
#include "documents/pdf/plain_streams.h"
#include "documents/work_file.h"
#include "platform/text/small_letters.h"
#include "platform/utf8.h"

namespace dynlab::inline documents {

DYNLAB_DESCRIBE(PdfWord, left, top, right, bottom, size, bold, fixed_width, rotated, space_after, text)
DYNLAB_DESCRIBE(PdfPage, width, height, words)

template <Is<PdfLayout> T, class V>
void describe(T& object, V& member) {
    auto& [protected_by_password, pages] = object;
    member("protected", protected_by_password), member("pages", pages);
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEnd = 2048;  ///< bytes at the end of a file that contain its last mark

std::string bytes_at(const fs::path& file, std::uint64_t from, std::size_t count) {
    std::ifstream in(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(from));
    std::string bytes(count, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
    return bytes;
}

/// What can be said without reading the file as a PDF.
void check_outside(const fs::path& file, const PdfLimits& limits) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) throw PdfRefusal(PdfFault::kNotThere, Message("The file does not exist."));
    const std::uint64_t size = fs::file_size(file);
    if (size == 0) throw PdfRefusal(PdfFault::kNotPdf, Message("The file is empty."));
    if (size > limits.file_bytes) {
        throw PdfRefusal(PdfFault::kTooLarge, Message("The size of the file is {} MB; the limit is {} MB.", size >> 20,
                                                      limits.file_bytes >> 20));
    }
    const std::string start = bytes_at(file, 0, 1024);
    if (start.empty()) throw PdfRefusal(PdfFault::kNotThere, Message("The file cannot be read: permission is denied."));
    if (start.find("%PDF-") == std::string::npos)
        throw PdfRefusal(PdfFault::kNotPdf, Message("The file is not a PDF, despite its name."));
    if (bytes_at(file, size > kEnd ? size - kEnd : 0, kEnd).find("%%EOF") == std::string::npos)
        throw PdfRefusal(PdfFault::kDamaged, Message("The file is damaged: its end is missing."));
}

bool contains_any(const std::string& text, std::initializer_list<const char*> parts) {
    return std::ranges::any_of(parts, [&](const char* part) { return text.find(part) != std::string::npos; });
}

PdfWord word_of(const PdfDocument::Box& box) {
    const std::string font = in_small_letters(box.font);
    return {box.left,
            box.top,
            box.right,
            box.bottom,
            box.size,
            contains_any(font, {"bold", "bx", "heavy", "black"}),
            contains_any(font, {"mono", "courier", "cmtt", "consol", "typewriter"}),
            box.rotated,
            box.space_after,
            utf8_of(box.text)};
}

[[noreturn]] void refuse(PdfFault fault, const Message& message) {
    throw PdfRefusal(fault, message);
}

PdfLayout layout_of(const PdfDocument* document, const PdfLimits& limits) {
    if (!document) refuse(PdfFault::kDamaged, Message("The file is damaged: it contains no pages."));
    if (document->is_locked())
        refuse(PdfFault::kEncrypted, Message("The file is encrypted: save the PDF without a password."));
    const int count = document->pages();
    if (count < 1) refuse(PdfFault::kDamaged, Message("The file is damaged: it contains no pages."));
    if (count > limits.pages) {
        refuse(PdfFault::kTooLarge, Message("The file has {} pages; the limit is {}.", count, limits.pages));
    }
    PdfLayout layout{document->is_encrypted(), {}};
    std::size_t words = 0;
    for (int i = 0; i < count; ++i) {
        const std::optional<PdfDocument::Page> page = document->page(i);
        if (!page) refuse(PdfFault::kDamaged, Message("The file is damaged: page {} cannot be read.", i + 1));
        words += page->words.size();
        if (words > static_cast<std::size_t>(limits.words)) {
            refuse(PdfFault::kTooLarge,
                   Message("The file has more than {} words, the limit for a report.", limits.words));
        }
        PdfPage& added = layout.pages.emplace_back(PdfPage{page->width, page->height, {}});
        std::ranges::transform(page->words, std::back_inserter(added.words), word_of);
    }
    return layout;
}

/// Runs in the guarded copy.
PdfLayout read_all(const fs::path& file, const PdfLimits& limits) {
    const std::string pdf = with_plain_streams(read_work_file(file));
    return layout_of(open_pdf(pdf).get(), limits);
}

std::vector<std::string> texts_of(const fs::path& file, const PdfLimits& limits) {
    const std::string pdf = with_plain_streams(read_work_file(file));
    const auto document = open_pdf(pdf);
    std::vector<std::string> texts;
    for (int i = 0; document && i < std::min(document->pages(), limits.pages); ++i)
        if (const auto text = document->text_in_content_order(i)) texts.push_back(utf8_of(*text));
    return texts;
}

/// A page with a letter of a font that has no file.
std::string smallest_pdf() {
    QPDF pdf;
    pdf.emptyPDF();
    QPDFObjectHandle page = pdf.makeIndirectObject(QPDFObjectHandle::parse(
        "<< /Type /Page /MediaBox [0 0 9 9] /Resources << /Font << /F << /Type /Font /Subtype /Type3 /FontBBox "
        "[0 0 1 1] /FontMatrix [1 0 0 1 0 0] /CharProcs << >> /FirstChar 97 /LastChar 97 /Widths [1] /Encoding "
        "<< /Differences [97 /a] >> >> >> >> >>"));
    page.replaceKey("/Contents", pdf.newStream("BT /F 1 Tf 1 1 Td (a) Tj ET"));
    pdf.addPage(page, false);
    return written_pdf(pdf, 1u << 20);
}

bool is_placed(const PdfWord& word) {
    const double numbers[] = {word.left, word.top, word.right, word.bottom, word.size};
    return std::all_of(std::begin(numbers), std::end(numbers), [](double x) { return std::abs(x) < 1e6; });
}

}  // namespace

PdfLayout read_pdf_layout(const fs::path& file, const PdfLimits& limits) {
    check_outside(file, limits);
    load_pdf_library();  // once, instead of in each copy
    const auto work = [&] { return cbor_of(read_all(file, limits)); };
    const std::string answer = run_guarded_on_pdf(work, {{limits.time}, limits.memory_bytes, limits.memory_bytes});
    ValueLimits bounds;
    bounds.memory = limits.memory_bytes;
    try {
        auto layout = from_cbor<PdfLayout>(answer, bounds);
        for (PdfPage& page : layout.pages) std::erase_if(page.words, [](const PdfWord& w) { return !is_placed(w); });
        return layout;
    } catch (const ValueError&) {
        refuse(PdfFault::kDamaged, Message("The file is damaged: its pages cannot be read."));
    }
}

std::vector<std::string> text_in_content_order(const fs::path& file, const PdfLimits& limits) {
    check_outside(file, limits);
    load_pdf_library();  // once, instead of in each copy
    const auto work = [&] { return cbor_of(texts_of(file, limits)); };
    const std::string answer = run_guarded_on_pdf(work, {{limits.time}, limits.memory_bytes, limits.memory_bytes});
    try {
        return from_cbor<std::vector<std::string>>(answer);
    } catch (const ValueError&) {
        refuse(PdfFault::kDamaged, Message("The file is damaged: its pages cannot be read."));
    }
}

void prepare_to_read_pdfs() {
    static const std::string pdf = with_plain_streams(smallest_pdf());
    static const std::unique_ptr<PdfDocument> kept = open_pdf(pdf);  // with it poppler keeps its tables
    layout_of(kept.get(), {});
}

}  // namespace dynlab::inline documents
