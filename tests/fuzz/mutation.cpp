#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>

namespace quadrig::fuzz {
namespace {

class Mutation {
  public:
    Mutation(Bytes bytes, std::mt19937_64& random) : bytes_(std::move(bytes)), random_(random) {}

    void change(const Bytes& other) {
        switch (below(8)) {
            case 0:
                if (!bytes_.empty()) bytes_[below(bytes_.size())] ^= std::byte{1} << below(8);
                break;
            case 1:
                if (!bytes_.empty()) bytes_[below(bytes_.size())] = static_cast<std::byte>(random_());
                break;
            case 2:
                overwrite_with_border();
                break;
            case 3: {
                const auto [at, size] = piece(bytes_);
                bytes_.erase(at, at + size);
                break;
            }
            case 4: {
                const auto [at, size] = piece(bytes_);
                insert(Bytes(at, at + size));
                break;
            }
            case 5:
            case 6: {
                Bytes donor = other;
                const auto [at, size] = piece(donor);
                insert(Bytes(at, at + size));
                break;
            }
            default:
                bytes_.resize(below(bytes_.size() + 1));
                break;
        }
    }
    Bytes take(std::size_t most_bytes) {
        bytes_.resize(std::min(bytes_.size(), most_bytes));
        return std::move(bytes_);
    }

  private:
    // The library's distributions differ from one standard library to the next.
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }

    struct Piece {
        Bytes::iterator at;
        std::ptrdiff_t size;
    };
    /// Mostly short.
    Piece piece(Bytes& bytes) {
        const std::size_t from = below(bytes.size() + 1);
        const std::size_t most = std::min(bytes.size() - from, below(4) == 0 ? bytes.size() : std::size_t{16});
        return {bytes.begin() + static_cast<std::ptrdiff_t>(from), static_cast<std::ptrdiff_t>(below(most + 1))};
    }
    void insert(const Bytes& piece) {
        const auto at = bytes_.begin() + static_cast<std::ptrdiff_t>(below(bytes_.size() + 1));
        bytes_.insert(at, piece.begin(), piece.end());
    }
    void overwrite_with_border() {
        constexpr std::array<std::uint64_t, 12> kBorders{0,
                                                         1,
                                                         0x7F,
                                                         0x80,
                                                         0xFF,
                                                         0x7FFF,
                                                         0x8000,
                                                         0xFFFF,
                                                         0x7FFF'FFFF,
                                                         0xFFFF'FFFF,
                                                         0x7FF0'0000'0000'0000,   // infinity
                                                         0x7FF8'0000'0000'0000};  // not a number
        const std::uint64_t border = kBorders[below(kBorders.size())];
        const std::size_t width = std::size_t{1} << below(4), at = below(bytes_.size() + 1);
        const bool big_endian = below(2) == 0;
        for (std::size_t i = 0; i < width && at + i < bytes_.size(); ++i)
            bytes_[at + i] = static_cast<std::byte>(border >> 8U * (big_endian ? width - 1 - i : i));
    }

    Bytes bytes_;
    std::mt19937_64& random_;
};

}  // namespace

Bytes mutated(std::span<const Bytes> corpus, std::size_t most_bytes, std::mt19937_64& random) {
    Mutation mutation(corpus[random() % corpus.size()], random);
    for (auto changes = 1 + random() % 8; changes > 0; --changes) mutation.change(corpus[random() % corpus.size()]);
    return mutation.take(most_bytes);
}

}  // namespace quadrig::fuzz
