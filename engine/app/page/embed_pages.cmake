# Writes one C++ source that holds the files of the pages: cmake -DAPP=folder -DOUTPUT=file.cpp -P embed_pages.cmake
file(GLOB pages ${APP}/page/*.html ${APP}/page/*.css ${APP}/page/*.js ${APP}/workbench/*.lua)
list(SORT pages)
set(entries "")
foreach(page IN LISTS pages)
  get_filename_component(name ${page} NAME)
  file(READ ${page} text)
  string(APPEND entries "    PageFile{\"${name}\", R\"-page-(${text})-page-\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"app/page/page_files.h\"

namespace dynlab::inline app {
namespace {

constexpr PageFile kFiles[] = {
${entries}};

}  // namespace

std::span<const PageFile> page_files() {
    return kFiles;
}

}  // namespace dynlab::inline app
")
