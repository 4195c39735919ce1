#pragma once
#include <cstddef>
#include <map>
#include <string_view>

namespace dynlab::inline documents {

/// What PdfScanner throws: the file, or a part of it, has a form that is left to a reader of PDFs.
struct UnusualPdf {};

/// Of a dictionary: key and value as they are written.
using PdfEntries = std::map<std::string_view, std::string_view>;

/// Reads the objects of a sound PDF one after the other (ISO 32000-1, 7.2 and 7.3), each as it is written. It is no
/// reader of PDFs: what is unusual it refuses. The bytes must outlive it and what it returns.
class PdfScanner {
  public:
    PdfScanner(std::string_view bytes, std::size_t at);

    std::size_t at() const { return at_; }
    bool takes(std::string_view sign);  ///< steps over `sign` when it stands here, behind spaces
    void expect(std::string_view sign);
    std::size_t number();
    std::string_view value() { return value_at_depth(0); }  ///< any object; references too
    PdfEntries dictionary();                                ///< with plainly written keys, each once
    void end_line();

  private:
    std::string_view value_at_depth(int depth);
    void skip_space();
    void skip_word();
    void skip_string();
    void skip_rest_of_reference(std::string_view first);
    bool is_one_of(std::string_view set) const;

    std::string_view bytes_;
    std::size_t at_;
};

}  // namespace dynlab::inline documents
