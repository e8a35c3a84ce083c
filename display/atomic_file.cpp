#include "display/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
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

std::string name_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

/// Of a program that is killed it leaves nothing behind. Null where the file system has no such files, or the system no
/// way to name them.
std::FILE* open_nameless(const std::filesystem::path& directory) {
    const int descriptor = open(directory.empty() ? "." : directory.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) return nullptr;
    std::FILE* const stream = access(name_of(descriptor).c_str(), F_OK) == 0 ? fdopen(descriptor, "wb") : nullptr;
    if (stream == nullptr) close(descriptor);
    return stream;
}

}  // namespace

std::filesystem::path written_to(const std::filesystem::path& path) {
    std::error_code none;
    const auto found = std::filesystem::weakly_canonical(behind_links(std::filesystem::absolute(path, none)), none);
    return none ? path : found;
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
    if (is_special(path_)) {
        target_ = part_ = path_;
    } else {
        part_ = target_ = behind_links(path_);
        part_ += ".part";
        stream_ = open_nameless(target_.parent_path());
        nameless_ = stream_ != nullptr;
    }
    if (!stream_) stream_ = std::fopen(part_.c_str(), "wbe");
    if (!stream_) fail("cannot be written");
}

AtomicFile::~AtomicFile() {
    if (!stream_) return;
    std::fclose(stream_);
    discard();
}

void AtomicFile::discard() const {
    if (part_ != target_ && !nameless_) std::remove(part_.c_str());
}

/// Only renaming puts a file in another's place, and only one that has a name.
bool AtomicFile::give_name() {
    const auto link = [&] {
        return linkat(AT_FDCWD, name_of(fileno(stream_)).c_str(), AT_FDCWD, part_.c_str(), AT_SYMLINK_FOLLOW) == 0;
    };
    if (std::fflush(stream_) != 0) return false;
    nameless_ = !(link() || (errno == EEXIST && std::remove(part_.c_str()) == 0 && link()));
    return !nameless_;
}

void AtomicFile::write(const void* data, std::size_t bytes) {
    if (std::fwrite(data, 1, bytes, stream_) != bytes) fail("cannot be written");
}

void AtomicFile::commit() {
    if (nameless_ && !give_name()) fail("cannot be written");
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
    if (std::error_code none; std::filesystem::is_directory(path, none))
        throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(EISDIR));
    if (!is_special(path)) AtomicFile can_be_made(path);
}

void write_whole(const std::filesystem::path& path, std::string_view text) {
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace quadrig::display
