/// What is wrong with a file that somebody wrote, said so that they can go and mend it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace quadrig::config {

/// Thrown by everything in this folder that reads a file. The message reads "FILE:LINE: key 'object[3].planes[1]':
/// expected …, found …"; the line is left out where the format does not tell it, the key where the mistake has none (a
/// syntax error between keys). What a terminal would obey, and what is not UTF-8, is told as \xNN.
class FileError : public std::runtime_error {
  public:
    /// `line` counts from 1; 0 is "not known".
    FileError(const std::filesystem::path& file, std::size_t line, std::string key, const std::string& complaint);

    [[nodiscard]] std::size_t line() const { return line_; }
    [[nodiscard]] const std::string& key() const { return key_; }

  private:
    std::size_t line_;
    std::string key_;
};

/// Of a text that is too long for a message the beginning, in whole characters.
std::string excerpt(std::string_view text);

/// The bytes of a text file. Throws FileError where it cannot be read or is larger than 256 MiB (a device, a wrong
/// file).
std::string read_text_file(const std::filesystem::path& file);

}  // namespace quadrig::config
