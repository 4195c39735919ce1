#include "documents/pdf/plain_streams.h"

#include <algorithm>
#include <memory>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFWriter.hh>
#include <set>

#include "documents/pdf/content_paths.h"
#include "documents/pdf/pdf_objects.h"
#include "platform/guarded_call.h"

namespace dynlab::inline documents {
namespace {

constexpr std::uint64_t kMaxInnerBytes = 64u << 20;
/// Of a file whose objects may be left in memory when all is said of them.
constexpr std::size_t kSmallFile = 4u << 20;
/// Types of streams that poppler does not read for the text.
constexpr const char* kUnread[] = {"/EmbeddedFile", "/Metadata", "/ObjStm", "/XRef"};

bool is_left_alone(QPDFObjectHandle stream) {
    QPDFObjectHandle entries = stream.getDict();
    const bool is_elsewhere = entries.hasKey("/F") || entries.hasKey("/DP");
    const auto is_of_type = [&](const char* type) { return entries.isDictionaryOfType(type); };
    return is_elsewhere || !entries.hasKey("/Filter") || entries.isDictionaryOfType("", "/Image") ||
           std::any_of(std::begin(kUnread), std::end(kUnread), is_of_type);
}

/// Streams that are the whole content of a page, and forms. One that is a piece of some content as well is none of
/// them, for a string may begin in the piece before it.
std::set<QPDFObjGen> whole_contents(QPDF& pdf, std::vector<QPDFObjectHandle>& objects) {
    std::set<QPDFObjGen> contents, pieces;
    const auto note_page = [&](QPDFObjectHandle content) {
        if (content.isStream()) contents.insert(content.getObjGen());
        if (!content.isArray()) return;
        for (const QPDFObjectHandle& piece : content.getArrayAsVector()) pieces.insert(piece.getObjGen());
    };
    for (QPDFObjectHandle page : pdf.getAllPages()) note_page(page.getKey("/Contents"));
    for (QPDFObjectHandle& object : objects) {
        if (object.isStream() && object.getDict().isDictionaryOfType("", "/Form")) contents.insert(object.getObjGen());
        if (object.isDictionary())
            note_page(object.getKey("/Contents"));  // readers differ in what they take for a page
    }
    for (const QPDFObjGen& piece : pieces) contents.erase(piece);
    return contents;
}

void write_out_streams(QPDF& pdf) {
    std::uint64_t left = kMaxInnerBytes;
    std::vector<QPDFObjectHandle> objects = pdf.getAllObjects();
    const std::set<QPDFObjGen> contents = whole_contents(pdf, objects);
    for (QPDFObjectHandle& object : objects) {
        if (!object.isStream() || is_left_alone(object)) continue;
        try {
            StreamContent content = stream_content(object, left);
            if (!content.decoded) continue;
            left -= content.bytes.size();
            if (contents.contains(object.getObjGen())) content.bytes = without_paths(content.bytes);
            object.replaceStreamData(content.bytes, QPDFObjectHandle::newNull(), QPDFObjectHandle::newNull());
        } catch (const PdfRefusal&) {
            // It stays as it is.
        }
    }
}

}  // namespace

std::string with_plain_streams(std::string bytes) {
    try {
        auto pdf = std::make_unique<QPDF>();
        read_pdf(*pdf, bytes);
        if (pdf->isEncrypted()) return bytes;
        write_out_streams(*pdf);
        std::string plain = written_pdf(*pdf, bytes.size() + 2 * kMaxInnerBytes, [](QPDFWriter& writer) {
            writer.setStreamDataMode(qpdf_s_preserve);
            writer.setObjectStreamMode(qpdf_o_disable);
            writer.setNewlineBeforeEndstream(true);
            writer.setDeterministicID(false);  // which would be computed from all that is written
            writer.setStaticID(true);
        });
        if (pdf->anyWarnings()) return bytes;
        // A copy of the process ends soon and need not destroy thousands of objects.
        if (is_guarded_copy() && bytes.size() < kSmallFile) static_cast<void>(pdf.release());
        return plain;
    } catch (const std::exception&) {
        return bytes;
    }
}

}  // namespace dynlab::inline documents
