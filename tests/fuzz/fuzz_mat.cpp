// MATLAB files of others, in the guarded copy that reads them: it may be lost, this process may not.
#include "data_io/data_file.h"
#include "fuzz/fuzz_input.h"
#include "platform/error.h"

using namespace dynlab;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const LoadedData loaded = read_data_file(fuzz::file_of(fuzz::text_of(data, size), "input.mat"), true);
        for (const auto& [name, variable] : loaded.variables) fuzz::demand(!name.empty());
    } catch (const EnvironmentError& error) {
        fuzz::demand(*error.what() != '\0');
    }
    return 0;
}
