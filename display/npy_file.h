/// NumPy .npy files, version 1.0: two-dimensional, row-major, little-endian.
/// Source: NumPy Enhancement Proposal 1, "A Simple File Format for NumPy Arrays".
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace quadrig::display {

/// `values` holds rows * columns numbers, row 0 first. Throws std::invalid_argument where it does not,
/// std::runtime_error where the file cannot be written; the file is whole or absent.
void write_npy(const std::filesystem::path& path, std::span<const std::int32_t> values, int rows, int columns);
void write_npy(const std::filesystem::path& path, std::span<const double> values, int rows, int columns);

}  // namespace quadrig::display
