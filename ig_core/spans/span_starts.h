/// The columns in which a row's spans begin, from left to right.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace quadrig {

/// A list of spans for each column, and a bit that says whether there is any: nothing is sorted, and what is added on
/// the way need not be put between others.
class SpanStarts {
  public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// Forgets all; room for so many spans, numbered from 0.
    void clear(int columns, std::size_t spans) {
        taken_.assign(static_cast<std::size_t>(columns) / kBits + 1, 0);
        take(columns);  // where every search ends
        if (first_.size() < static_cast<std::size_t>(columns)) first_.resize(static_cast<std::size_t>(columns));
        next_.resize(spans);
    }
    /// Puts a span before all others of its column.
    void add_first(int column, std::uint32_t span) {
        std::uint32_t& of_column = first_[static_cast<std::size_t>(column)];
        next_[span] = is_taken(column) ? of_column : kNone;
        of_column = span;
        take(column);
    }
    /// Puts one more span, numbered after all there are, behind all others of its column.
    void add_last(int column) {
        const auto span = static_cast<std::uint32_t>(next_.size());
        std::uint32_t last = first(column);
        if (last == kNone) {
            first_[static_cast<std::size_t>(column)] = span;
            take(column);
        } else {
            while (next_[last] != kNone) last = next_[last];
            next_[last] = span;
        }
        next_.push_back(kNone);
    }

    /// The first span that begins in a column, and the one after another; kNone where there is none.
    [[nodiscard]] std::uint32_t first(int column) const {
        return is_taken(column) ? first_[static_cast<std::size_t>(column)] : kNone;
    }
    [[nodiscard]] std::uint32_t next(std::uint32_t span) const { return next_[span]; }
    /// The next column in which one begins; the number of columns where there is none.
    [[nodiscard]] int next_column(int column) const {
        const std::size_t from = static_cast<std::size_t>(column) + 1;
        std::size_t word = from / kBits;
        std::uint64_t bits = taken_[word] >> from % kBits << from % kBits;
        while (bits == 0) bits = taken_[++word];
        return static_cast<int>(word * kBits) + std::countr_zero(bits);
    }

  private:
    static constexpr std::size_t kBits = 64;
    [[nodiscard]] bool is_taken(int column) const {
        const auto at = static_cast<std::size_t>(column);
        return (taken_[at / kBits] >> at % kBits & 1U) != 0;
    }
    void take(int column) {
        const auto at = static_cast<std::size_t>(column);
        taken_[at / kBits] |= std::uint64_t{1} << at % kBits;
    }

    std::vector<std::uint64_t> taken_;  // a bit for each column and one more
    std::vector<std::uint32_t> first_;  // by column; valid where it is taken
    std::vector<std::uint32_t> next_;   // by span
};

}  // namespace quadrig
