// Tables in text files. Whatever is read has names, columns of one length, and is written and read again.
#include "data_io/csv_file.h"
#include "fuzz/fuzz_input.h"
#include "platform/error.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string text = fuzz::text_of(data, size);
    ImportOptions options;
    const unsigned choice = fuzz::take_choice(text);
    if (choice & 1) options.skip = choice >> 4;
    if (choice & 2) options.delimiter = (choice & 4) ? ';' : ' ';
    if (choice & 8) options.names = {"t", "u", "y"};
    try {
        const CsvTable table = read_csv_text("input.csv", text, options);
        fuzz::demand(!table.names.empty());
        fuzz::demand(table.columns.size() == table.names.size());
        for (const auto& [name, texts] : table.texts)
            fuzz::demand(std::find(table.names.begin(), table.names.end(), name) != table.names.end());
    } catch (const EnvironmentError& error) {
        fuzz::demand(*error.what() != '\0');
    }
    return 0;
}
