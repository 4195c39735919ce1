#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace dynlab::inline app {

/// Where Jupyter looks for kernels of this user: $JUPYTER_DATA_DIR/kernels, else below $XDG_DATA_HOME/jupyter or
/// ~/.local/share/jupyter; empty when none is known. With a prefix below PREFIX/share/jupyter.
std::filesystem::path kernels_folder(const std::string& prefix = {});

/// Registers `program` with Jupyter in that folder and replaces an earlier registration. Returns the description's
/// file. Throws EnvironmentError.
std::filesystem::path install_kernel(const std::filesystem::path& folder, const std::filesystem::path& program);
bool remove_kernel(const std::filesystem::path& folder);  ///< false where there was none

/// The program that Jupyter starts, of this user's description or one of the machine's; nothing without one.
std::optional<std::filesystem::path> installed_kernel();

}  // namespace dynlab::inline app
