// The module libdynlab_poppler.so, the only code that uses poppler: see pdf_document.h.
#include <poppler/cpp/poppler-document.h>
#include <poppler/cpp/poppler-global.h>
#include <poppler/cpp/poppler-page.h>

#include "documents/pdf/pdf_document.h"

namespace dynlab::inline documents {
namespace {

void ignore_message(const std::string&, void*) {}

/// poppler's own conversion to UTF-8 looks for tables of characters each time.
std::u16string utf16(const poppler::ustring& text) {
    return {text.begin(), text.end()};
}

class PopplerDocument : public PdfDocument {
  public:
    explicit PopplerDocument(std::unique_ptr<poppler::document> document) : document_(std::move(document)) {}

    bool is_locked() const override { return document_->is_locked(); }
    bool is_encrypted() const override { return document_->is_encrypted(); }
    int pages() const override { return document_->pages(); }

    std::optional<Page> page(int index) const override {
        const std::unique_ptr<poppler::page> read(document_->create_page(index));
        if (!read) return std::nullopt;
        const poppler::rectf size = read->page_rect();
        Page page{size.width(), size.height(), {}};
        for (const poppler::text_box& box : read->text_list(poppler::page::text_list_include_font)) {
            const poppler::rectf at = box.bbox();
            page.words.push_back({at.left(), at.top(), at.right(), at.bottom(), box.get_font_size(),
                                  box.rotation() != 0, box.has_space_after(), box.get_font_name(), utf16(box.text())});
        }
        return page;
    }

    std::optional<std::u16string> text_in_content_order(int index) const override {
        const std::unique_ptr<poppler::page> read(document_->create_page(index));
        if (!read) return std::nullopt;
        return utf16(read->text({}, poppler::page::raw_order_layout));
    }

  private:
    std::unique_ptr<poppler::document> document_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) PdfDocument* dynlab_open_pdf(const std::string& pdf) {
    poppler::set_debug_error_function(ignore_message, nullptr);
    std::unique_ptr<poppler::document> document(
        poppler::document::load_from_raw_data(pdf.data(), static_cast<int>(pdf.size())));
    return document ? new PopplerDocument(std::move(document)) : nullptr;
}

}  // namespace dynlab::inline documents
