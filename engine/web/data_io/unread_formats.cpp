#include "data_io/packaged_data.h"
#include "data_io/workbook.h"
#include "platform/error.h"

// Formats whose libraries are not there in a browser.
namespace dynlab::inline data_io {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const char* format) {
    throw EnvironmentError("{}: in a browser, dynlab cannot read {} files; save the data as CSV", file.string(),
                           format);
}

}  // namespace

SheetText read_sheet(const std::filesystem::path& file, const std::string&) {
    refuse(file, ".xlsx");
}

VariableTable read_packaged_data(const PackagedData& packaged) {
    refuse(packaged.file, "SLICOT");
}

}  // namespace dynlab::inline data_io
