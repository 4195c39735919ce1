#include "support/pdf_inspection.h"

#include <poppler/cpp/poppler-document.h>
#include <poppler/cpp/poppler-global.h>
#include <poppler/cpp/poppler-page.h>

#include <memory>

#include "platform/error.h"

namespace dynlab::test {
namespace {

std::string utf8(const poppler::ustring& text) {
    const poppler::byte_array bytes = text.to_utf8();
    return {bytes.begin(), bytes.end()};
}

void ignore_poppler_message(const std::string&, void*) {}

}  // namespace

PdfContent inspect_pdf(const std::filesystem::path& file) {
    poppler::set_debug_error_function(ignore_poppler_message, nullptr);
    const std::unique_ptr<poppler::document> document(poppler::document::load_from_file(file.string()));
    if (!document) throw EnvironmentError(file.string() + " cannot be read as a PDF: it is missing or damaged");
    if (document->is_locked())
        throw EnvironmentError(file.string() + " is encrypted; save it again as a PDF without password");
    PdfContent content;
    for (int i = 0; i < document->pages(); ++i) {
        const std::unique_ptr<poppler::page> page(document->create_page(i));
        if (!page)
            throw EnvironmentError(file.string() + " cannot be read as a PDF: page " + std::to_string(i + 1) +
                                   " is damaged");
        content.pages.push_back(utf8(page->text()));
    }
    for (const std::string& key : document->info_keys())
        content.metadata.emplace_back(key, utf8(document->info_key(key)));
    return content;
}

}  // namespace dynlab::test
