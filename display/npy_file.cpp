#include "display/npy_file.h"

#include <bit>
#include <stdexcept>
#include <string>

#include "display/atomic_file.h"

namespace quadrig::display {

namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie in memory");

/// Magic, version 1.0, header length (uint16), then a Python literal padded with spaces to a multiple of 64 bytes,
/// newline last.
std::string npy_header(const char* type, int rows, int columns) {
    std::string literal = std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (" +
                          std::to_string(rows) + ", " + std::to_string(columns) + "), }";
    constexpr std::size_t kPreamble = 10, kAlignment = 64;
    literal.append((kAlignment - (kPreamble + literal.size() + 1) % kAlignment) % kAlignment, ' ');
    literal += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(literal.size() & 0xFF);
    header += static_cast<char>(literal.size() >> 8);
    return header + literal;
}

template <class Number>
void write(const std::filesystem::path& path, std::span<const Number> values, int rows, int columns, const char* type) {
    if (rows < 0 || columns < 0 || values.size() != static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns))
        throw std::invalid_argument(path.string() + ": " + std::to_string(values.size()) + " values are not " +
                                    std::to_string(rows) + " rows of " + std::to_string(columns));
    AtomicFile file(path);
    const std::string header = npy_header(type, rows, columns);
    file.write(header.data(), header.size());
    file.write(values.data(), values.size_bytes());
    file.commit();
}

}  // namespace

void write_npy(const std::filesystem::path& path, std::span<const std::int32_t> values, int rows, int columns) {
    write(path, values, rows, columns, "<i4");
}

void write_npy(const std::filesystem::path& path, std::span<const double> values, int rows, int columns) {
    write(path, values, rows, columns, "<f8");
}

}  // namespace quadrig::display
