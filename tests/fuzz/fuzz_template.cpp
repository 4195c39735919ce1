// Templates: their header, their rules, their place for cells.
#include "documents/document_rules.h"
#include "documents/error.h"
#include "documents/template_file.h"
#include "fuzz/fuzz_input.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const TemplateFile source = read_template(fuzz::file_of(fuzz::text_of(data, size), "input.md"));
        document_rules(source);
        MarkdownText cells;
        cells.append("A cell.\n", "cells.lua", 1);
        if (shows_cells(source)) with_cells(source, cells);
    } catch (const DocumentError& error) {
        fuzz::demand(*error.what() != '\0');
    }
    return 0;
}
