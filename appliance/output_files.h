/// The files that a command is to write, looked at before anything is done for them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrig::appliance {

/// Throws WrongUse where two outputs would write over each other (two names of one file, one sink given twice), or one
/// over an input; std::runtime_error, with the system's reason, where a file cannot be made. Empty names are none.
/// Devices and pipes take what comes, but for one sink only, and nothing beside the video on standard output.
void expect_outputs(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& sinks,
                    const std::vector<std::filesystem::path>& inputs);

}  // namespace quadrig::appliance
