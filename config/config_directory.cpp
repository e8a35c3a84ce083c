#include "config/config_directory.h"

#include <cstdlib>

namespace quadrig::config {

std::filesystem::path config_directory() {
    namespace fs = std::filesystem;
    if (const char* named = std::getenv("QUADRIG_CONFIG_DIR")) return named;
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    const fs::path installed = program.parent_path().parent_path() / "share" / "quadrig";
    if (!unknown && fs::is_directory(installed, unknown)) return installed;
    return QUADRIG_SOURCE_CONFIG_DIR;
}

}  // namespace quadrig::config
