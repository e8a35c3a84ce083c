/// The random numbers of generated scenes: exactly the same on every machine, compiler and standard library.
///
/// SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom number generators", OOPSLA 2014). Integers are exact;
/// fractions are the upper 53 bits over 2^53, which a double holds exactly.
#pragma once

#include <cstdint>

namespace quadrig::clusters {

class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    /// In 0..1, 1 excluded, a multiple of 2^-53.
    double fraction() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    /// In centre - spread .. centre + spread.
    double about(double centre, double spread) { return centre + spread * (2.0 * fraction() - 1.0); }

  private:
    std::uint64_t state_;
};

/// A seed for a part of what `seed` makes, such as row and column of a lattice.
inline std::uint64_t seed_of_part(std::uint64_t seed, std::int64_t part) {
    return Dice(Dice(seed).next() ^ static_cast<std::uint64_t>(part)).next();
}

}  // namespace quadrig::clusters
