#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dynlab::inline documents {

/// A PDF document, read with poppler. Pages count from 0.
class PdfDocument {
  public:
    struct Box {  ///< a word: points from the upper left corner of the page
        double left = 0, top = 0, right = 0, bottom = 0;
        double size = 0;  ///< of the font, in points
        bool rotated = false, space_after = false;
        std::string font;  ///< name
        std::u16string text;
    };
    struct Page {
        double width = 0, height = 0;  ///< points
        std::vector<Box> words;        ///< in reading order
    };

    virtual ~PdfDocument() = default;
    virtual bool is_locked() const = 0;     ///< needs a password to be read
    virtual bool is_encrypted() const = 0;  ///< readable, but a password guards changes
    virtual int pages() const = 0;
    virtual std::optional<Page> page(int index) const = 0;  ///< nothing if it cannot be read
    /// Returns the text in the order in which the content prints it; nothing if the page cannot be read.
    virtual std::optional<std::u16string> text_in_content_order(int index) const = 0;
};

/// Loads poppler and the twenty libraries that only it needs. They would take a fifth of the start of every command, so
/// only a process that reads a PDF loads them. Throws EnvironmentError.
void load_pdf_library();

/// Returns the document in `pdf`, which must outlive it; null if the bytes are not a PDF. Throws EnvironmentError.
std::unique_ptr<PdfDocument> open_pdf(const std::string& pdf);

}  // namespace dynlab::inline documents
