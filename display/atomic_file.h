/// A file that is either there whole or not at all: written under another name, renamed when finished.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace quadrig::display {

/// Every failure throws std::runtime_error with the path and the system's reason. A file not committed leaves nothing
/// behind.
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
    [[noreturn]] void fail(const char* what) const;
    std::filesystem::path path_, part_;
    std::FILE* stream_ = nullptr;
};

/// A file of this text, or an exception as above.
void write_whole(const std::filesystem::path& path, std::string_view text);

}  // namespace quadrig::display
