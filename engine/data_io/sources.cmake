# How single sources of data_io are compiled; included by engine/CMakeLists.txt.

# libmatio is loaded by name with the first file that needs it: by the name that stays the same through bug fixes.
file(REAL_PATH ${pkgcfg_lib_MATIO_matio} matio_library)
string(REGEX REPLACE "(\\.so\\.[0-9]+)\\..*" "\\1" matio_library ${matio_library})
set_source_files_properties(data_io/matio_library.cpp
                            PROPERTIES COMPILE_DEFINITIONS DYNLAB_MATIO="${matio_library}"
                            SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)

# What reads each number of a table.
dynlab_optimized(data_io/text_table.cpp data_io/tables/cell_scanner.cpp data_io/tables/number_cell.cpp
                 data_io/tables/table_rows.cpp data_io/tables/text_decoding.cpp)
