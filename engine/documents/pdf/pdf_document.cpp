#include "documents/pdf/pdf_document.h"

#include <dlfcn.h>

#include "platform/error.h"
#include "platform/program_lookup.h"

namespace dynlab::inline documents {
namespace {

using Open = PdfDocument*(const std::string& pdf);  ///< poppler/poppler_document.cpp

Open& opening_function() {
    static Open* const open = [] {
        const auto file = running_program().parent_path().parent_path() / "lib/dynlab/libdynlab_poppler.so";
        void* const library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
        void* const function = library != nullptr ? ::dlsym(library, "dynlab_open_pdf") : nullptr;
        if (function == nullptr) {
            const char* reason = ::dlerror();
            throw EnvironmentError("PDF files cannot be read: {}. Reinstall dynlab.",
                                   reason != nullptr ? Message::verbatim(reason) : Message::verbatim(file.string()));
        }
        return reinterpret_cast<Open*>(function);
    }();
    return *open;
}

}  // namespace

void load_pdf_library() {
    opening_function();
}

std::unique_ptr<PdfDocument> open_pdf(const std::string& pdf) {
    return std::unique_ptr<PdfDocument>(opening_function()(pdf));
}

}  // namespace dynlab::inline documents
