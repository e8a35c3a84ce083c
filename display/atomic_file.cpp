#include "display/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace quadrig::display {

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
    part_ += ".part";
    stream_ = std::fopen(part_.c_str(), "wbe");
    if (!stream_) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
    if (!stream_) return;
    std::fclose(stream_);
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
}

void AtomicFile::write(const void* data, std::size_t bytes) {
    if (std::fwrite(data, 1, bytes, stream_) != bytes) fail("cannot be written");
}

void AtomicFile::commit() {
    std::FILE* const stream = std::exchange(stream_, nullptr);
    if (std::fclose(stream) == 0 && std::rename(part_.c_str(), path_.c_str()) == 0) return;
    const int reason = errno;
    std::remove(part_.c_str());
    errno = reason;
    fail("cannot be written");
}

void AtomicFile::fail(const char* what) const {
    throw std::runtime_error(path_.string() + ": " + what + ": " + std::strerror(errno));
}

void write_whole(const std::filesystem::path& path, std::string_view text) {
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace quadrig::display
