/// A file that is either there whole or not at all: written without a name, and named when finished.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace quadrig::display {

/// Every failure throws std::runtime_error with the path and the system's reason. A file not committed leaves nothing
/// behind. Behind a symbolic link it is the link's target that is written; a device, a pipe or a socket keeps its name
/// and takes the bytes as they come. Where the file system has no files without a name, it is NAME.part meanwhile.
class AtomicFile {
  public:
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* data, std::size_t bytes);
    [[nodiscard]] std::FILE* stream() const { return stream_; }
    /// Closes the file and gives it its name.
    void commit();

  private:
    bool give_name();
    void discard() const;
    [[noreturn]] void fail(const char* what) const;
    std::filesystem::path path_, target_, part_;  ///< as named, where its links lead, until it is finished
    std::FILE* stream_ = nullptr;
    bool nameless_ = false;
};

/// Where the bytes of a file of that name end up: without links, `.` and `..`. Two names are one file if these are
/// equal.
std::filesystem::path written_to(const std::filesystem::path& path);

/// Throws, as above, where such a file cannot be made, and makes none. A pipe is not tried: its reader would take that
/// for all there is.
void expect_writable(const std::filesystem::path& path);

/// A file of this text, or an exception as above.
void write_whole(const std::filesystem::path& path, std::string_view text);

}  // namespace quadrig::display
