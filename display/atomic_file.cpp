#include "display/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace quadrig::display {

namespace {

/// Devices, pipes and sockets: a file renamed to such a name would take its place.
bool is_special(const std::filesystem::path& path) {
    std::error_code none;
    return std::filesystem::is_other(path, none);
}

/// Links that lead nowhere yet are followed too, as opening them for writing would.
std::filesystem::path behind_links(std::filesystem::path path) {
    constexpr int kMostLinks = 40;  // as many as Linux follows
    std::error_code none;
    for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(path, none); ++i)
        path = path.parent_path() / std::filesystem::read_symlink(path, none);
    return path;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
    if (is_special(path_)) {
        target_ = part_ = path_;
    } else {
        part_ = target_ = behind_links(path_);
        part_ += ".part";
    }
    stream_ = std::fopen(part_.c_str(), "wbe");
    if (!stream_) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
    if (!stream_) return;
    std::fclose(stream_);
    discard();
}

void AtomicFile::discard() const {
    if (part_ != target_) std::remove(part_.c_str());
}

void AtomicFile::write(const void* data, std::size_t bytes) {
    if (std::fwrite(data, 1, bytes, stream_) != bytes) fail("cannot be written");
}

void AtomicFile::commit() {
    std::FILE* const stream = std::exchange(stream_, nullptr);
    if (std::fclose(stream) == 0 && (part_ == target_ || std::rename(part_.c_str(), target_.c_str()) == 0)) return;
    const int reason = errno;
    discard();
    errno = reason;
    fail("cannot be written");
}

void AtomicFile::fail(const char* what) const {
    throw std::runtime_error(path_.string() + ": " + what + ": " + std::strerror(errno));
}

void expect_writable(const std::filesystem::path& path) {
    if (!is_special(path)) AtomicFile can_be_made(path);
}

void write_whole(const std::filesystem::path& path, std::string_view text) {
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace quadrig::display
