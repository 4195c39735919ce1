# Writes one C++ source that holds files by their names, help pages without their ending, as what a function gives:
# cmake -DFILES=pattern|pattern -DLAYER=layer -DHEADER=header.h -DTYPE=type -DFUNCTION=function -DOUTPUT=file.cpp
#       -P embed_pages.cmake
string(REPLACE "|" ";" FILES "${FILES}")
file(GLOB pages ${FILES})
list(SORT pages COMPARE FILE_BASENAME)
set(entries "")
foreach(page IN LISTS pages)
  get_filename_component(name ${page} NAME)
  string(REGEX REPLACE "\\.md$" "" name ${name})
  file(READ ${page} text)
  string(APPEND entries "    ${TYPE}{\"${name}\", R\"-page-(${text})-page-\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace dynlab::inline ${LAYER} {

std::span<const ${TYPE}> ${FUNCTION}() {
    static const std::vector<${TYPE}> kPages = {  // longer texts than a compiler counts for a constant
${entries}    };
    return kPages;
}

}  // namespace dynlab::inline ${LAYER}
")
