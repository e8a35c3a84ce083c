#include "config/file_error.h"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace quadrig::config {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{256} << 20;

/// Bytes of the UTF-8 character that a text begins with (Unicode 15.0, table 3-7); 0 where it begins with none.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    if (lead < 0xC2 || lead > 0xF4) return 0;
    const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    const unsigned least = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned most = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    if (byte(1) < least || byte(1) > most) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
    return length;
}

std::string printable(std::string_view text) {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    std::string shown;
    while (!text.empty()) {
        const auto first = static_cast<unsigned char>(text.front());
        std::size_t length = character_length(text);
        if (length == 0 || first < 0x20 || first == 0x7F) {
            shown.append({'\\', 'x', kHex[first >> 4], kHex[first & 15]});
            length = 1;
        } else {
            shown += text.substr(0, length);
        }
        text.remove_prefix(length);
    }
    return shown;
}

std::string message(const std::filesystem::path& file, std::size_t line, const std::string& key,
                    const std::string& complaint) {
    std::string text = file.string();
    if (line > 0) text += ":" + std::to_string(line);
    text += ": ";
    if (!key.empty()) text += "key '" + printable(key) + "': ";
    return text + printable(complaint);
}

}  // namespace

FileError::FileError(const std::filesystem::path& file, std::size_t line, std::string key, const std::string& complaint)
    : std::runtime_error(message(file, line, key, complaint)), line_(line), key_(std::move(key)) {}

std::string excerpt(std::string_view text) {
    constexpr std::size_t kShown = 40;
    if (text.size() <= kShown) return std::string(text);
    const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; };
    std::size_t end = kShown;
    while (end > 0 && continues(end)) --end;
    return std::string(text.substr(0, end)) + "...";
}

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
