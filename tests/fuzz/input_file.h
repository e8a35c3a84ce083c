/// Inputs for readers that want a file.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "tests/fuzz/targets.h"

namespace quadrig::fuzz {

/// A file in memory, written anew for each input; no fuzzer that is killed leaves it behind.
class InputFile {
  public:
    InputFile() : file_(memfd_create("input", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(file_)) {
        if (file_ < 0) throw std::system_error(errno, std::generic_category(), "memfd_create");
    }
    ~InputFile() { close(file_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& holding(Input input) const {
        if (ftruncate(file_, 0) != 0 ||
            pwrite(file_, input.data(), input.size(), 0) != static_cast<ssize_t>(input.size()))
            throw std::system_error(errno, std::generic_category(), path_.string());
        return path_;
    }

  private:
    int file_;
    std::filesystem::path path_;
};

}  // namespace quadrig::fuzz
