#pragma once
#include <span>
#include <string_view>

namespace dynlab::inline app {

/// A file of our pages as it is in engine/app/page, engine/app/workbench or engine/app/office, by its name alone: part
/// of the program.
struct PageFile {
    std::string_view name, text;
};

std::span<const PageFile> page_files();
/// Those of engine/web/page: what pages need that run the engine in the browser.
std::span<const PageFile> web_page_files();

}  // namespace dynlab::inline app
