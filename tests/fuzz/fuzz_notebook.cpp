// Jupyter notebooks. The script that one says becomes a notebook that says the same script.
#include "base/reader.h"
#include "documents/error.h"
#include "fuzz/fuzz_input.h"
#include "workflow/notebooks/notebook.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const std::string source = script_of_notebook(fuzz::text_of(data, size), "input.ipynb").source;
        fuzz::demand(message_text(place_in_notebook(source, 1)).size() < 100);
        const std::string again = notebook_of(parse_percent_script(source, "input.lua"));
        fuzz::demand(script_of_notebook(again, "input.ipynb").source == source);
    } catch (const DocumentError& error) {
        fuzz::demand(*error.what() != '\0');
    }
    return 0;
}
