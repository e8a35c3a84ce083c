#include "config/file_error.h"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace quadrig::config {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{256} << 20;

std::string message(const std::filesystem::path& file, std::size_t line, const std::string& key,
                    const std::string& complaint) {
    std::string text = file.string();
    if (line > 0) text += ":" + std::to_string(line);
    text += ": ";
    if (!key.empty()) text += "key '" + key + "': ";
    return text + complaint;
}

}  // namespace

FileError::FileError(const std::filesystem::path& file, std::size_t line, std::string key, const std::string& complaint)
    : std::runtime_error(message(file, line, key, complaint)), line_(line), key_(std::move(key)) {}

std::string read_text_file(const std::filesystem::path& file) {
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    const auto refuse_errno = [&] {
        throw FileError(file, 0, "", "cannot be read: " + std::generic_category().message(errno != 0 ? errno : EIO));
    };
    if (!stream) refuse_errno();
    std::string text;
    std::string chunk(std::size_t{1} << 16, '\0');
    while (stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || stream.gcount() > 0) {
        text.append(chunk, 0, static_cast<std::size_t>(stream.gcount()));
        if (text.size() > kMaxFileBytes) throw FileError(file, 0, "", "expected at most 256 MiB of text, found more");
    }
    // A directory opens like a file on Linux and fails at the first read.
    if (stream.bad() || errno == EISDIR) refuse_errno();
    return text;
}

}  // namespace quadrig::config
