#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace dynlab::inline data_io {

/// A sheet of a workbook as comma separated text (RFC 4180): numbers as they are stored, texts in quotes, a line for
/// each row of the sheet from its first on, so that line numbers are row numbers.
struct SheetText {
    std::string csv;
    std::vector<std::string> sheets;  ///< names of all the workbook has
};

/// Reads the sheet of that name, the first one for an empty name, of an .xlsx file (Office Open XML, ECMA-376 part 1,
/// chapter 18). Formulas give the values that were stored with them, dates the spreadsheet's day numbers. A forked copy
/// of this process with limits (memory as in reading_memory.h, 20 s) reads the file and can open no other file. Parts
/// that unpack to more than half of that memory are refused, and no entity except XML's own five is expanded. Throws
/// EnvironmentError that names the file and the reason: missing, no workbook, damaged, too large, no such sheet (the
/// message lists the existing sheets).
SheetText read_sheet(const std::filesystem::path& file, const std::string& sheet);

}  // namespace dynlab::inline data_io
