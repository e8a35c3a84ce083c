/// Where the files that travel with the program are: the patterns that scenes name, the gallery.
#pragma once

#include <filesystem>

namespace quadrig::config {

/// The first of these that is there: what QUADRIG_CONFIG_DIR names; share/quadrig beside the directory of the program
/// (/usr/bin/quadrig has /usr/share/quadrig); config of the source tree that the program was built from. Where none is,
/// the last.
std::filesystem::path config_directory();

}  // namespace quadrig::config
