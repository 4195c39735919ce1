# Writes one C++ source that holds all help pages: cmake -DPAGES=folder -DOUTPUT=file.cpp -P embed_pages.cmake
file(GLOB pages ${PAGES}/*.md ${PAGES}/guides/*.md)
list(SORT pages COMPARE FILE_BASENAME)
set(entries "")
foreach(page IN LISTS pages)
  get_filename_component(name ${page} NAME)
  string(REGEX REPLACE "\\.md$" "" name ${name})
  file(READ ${page} text)
  string(APPEND entries "    HelpPage{\"${name}\", R\"-page-(${text})-page-\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"scripting/runtime/help.h\"

namespace dynlab::inline scripting {
namespace {

constexpr HelpPage kPages[] = {
${entries}};

}  // namespace

std::span<const HelpPage> help_pages() {
    return kPages;
}

}  // namespace dynlab::inline scripting
")
