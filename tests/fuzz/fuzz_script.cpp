// Scripts in the percent format, and the documents woven from them. Every line of what is woven has an origin.
#include <algorithm>

#include "documents/error.h"
#include "documents/weave.h"
#include "fuzz/fuzz_input.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const PercentScript script = parse_percent_script(fuzz::text_of(data, size), "input.lua");
        RunRecord record;
        for (const Cell& cell : script.cells) record.outputs[cell.id].push_back({"printed\n", std::nullopt});
        record.error = RecordedError{Message("wrong"), "input.lua", 1};
        const MarkdownText woven = weave_cells(script, record);
        fuzz::demand(static_cast<std::size_t>(std::count(woven.text.begin(), woven.text.end(), '\n')) ==
                     woven.origin.size());
    } catch (const DocumentError& error) {
        fuzz::demand(*error.what() != '\0');
    }
    return 0;
}
