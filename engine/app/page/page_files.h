#pragma once
#include <span>
#include <string_view>

namespace dynlab::inline app {

/// A file of our pages as it lies in engine/app/page or engine/app/office, or a Lua file of engine/app/workbench: part
/// of the program.
struct PageFile {
    std::string_view name, text;
};

std::span<const PageFile> page_files();
/// Those of engine/web/page: what pages need that run the engine in the browser.
std::span<const PageFile> web_page_files();

}  // namespace dynlab::inline app
