/// Blocks of columns of which only every sixteenth or fourth is computed, and the rest interpolated.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_INTERPOLATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_INTERPOLATION_INL_H_
#undef QUADRIG_INTERPOLATION_INL_H_
#else
#define QUADRIG_INTERPOLATION_INL_H_
#endif

#include <array>

#include "ig_core/shading/samples-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Strides of samples, columns.
constexpr std::size_t kFineStride = 4, kCoarseStride = 16;
/// What a cubic through four samples of a sine is wrong by at most, `step2` being the squared growth of its argument
/// from one to the next, rad^2 (the remainder of Lagrange's interpolation).
constexpr float cubic_error(float amplitude, float step2) { return 3.0F / 128.0F * amplitude * step2 * step2; }
/// So much of a factor of Eq 15 a term may be wrong by; one of half the frequency is wrong by a sixteenth of that.
constexpr float kLargestError = 0.006F;
constexpr std::size_t kBlockIntervals = kMostSamples / kCoarseStride;
/// Samples of the fine stride of a block and beside it.
constexpr std::size_t kFineCount = kCoarseStride / kFineStride * (kBlockIntervals + 1);

/// Weights of samples -1, 0, 1, 2 in the cubic through them (Lagrange), at `share` of the way from sample 0 to
/// sample 1.
constexpr std::array<float, 4> cubic_weights(float share) {
    const float s = share, r = 1.0F - share;
    return {-s * r * (1.0F + r) / 6.0F, r * (1.0F + s) * (1.0F + r) / 2.0F, s * (1.0F + s) * (1.0F + r) / 2.0F,
            -s * r * (1.0F + s) / 6.0F};
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V cubic(D d, float share, V before, V here, V next, V after) {
    const auto w = cubic_weights(share);
    const V sides = hn::MulAdd(hn::Set(d, w[0]), before, hn::Mul(hn::Set(d, w[3]), after));
    return hn::MulAdd(hn::Set(d, w[1]), here, hn::MulAdd(hn::Set(d, w[2]), next, sides));
}

/// Four values for every interval between samples; the first interval begins at samples[1].
HWY_INLINE void quarter_intervals(const float* samples, std::size_t intervals, float* values) {
    const hn::ScalableTag<float> d;
    for (std::size_t i = 0; i < intervals; i += hn::Lanes(d)) {
        const auto before = hn::LoadU(d, samples + i), here = hn::LoadU(d, samples + i + 1);
        const auto next = hn::LoadU(d, samples + i + 2), after = hn::LoadU(d, samples + i + 3);
        hn::StoreInterleaved4(here, cubic(d, 0.25F, before, here, next, after),
                              cubic(d, 0.5F, before, here, next, after), cubic(d, 0.75F, before, here, next, after), d,
                              values + 4 * i);
    }
}

/// Sixteen samples about a block.
struct BlockSamples {
    static constexpr std::size_t kCount = 16;
    std::size_t first_column;

    /// Columns of samples i and on. The first one stands more than an interval before the block: the fine samples
    /// between them have to begin before it too.
    template <class D>
    [[nodiscard]] HWY_INLINE hn::Vec<D> column(D d, std::size_t i) const {
        return hn::MulAdd(hn::Iota(d, static_cast<float>(i)), hn::Set(d, kCoarseStride), hn::Set(d, first()));
    }
    [[nodiscard]] float first() const {
        return static_cast<float>(first_column) - static_cast<float>(kCoarseStride + kFineStride);
    }
    [[nodiscard]] float last() const { return first() + static_cast<float>((kCount - 1) * kCoarseStride); }
    /// Columns of fine samples i and on: the first one stands before the block.
    template <class D>
    [[nodiscard]] HWY_INLINE hn::Vec<D> fine_column(D d, std::size_t i) const {
        return hn::MulAdd(hn::Iota(d, static_cast<float>(i)), hn::Set(d, kFineStride),
                          hn::Set(d, static_cast<float>(first_column) - static_cast<float>(kFineStride)));
    }
};

/// The two steps from samples to columns.
HWY_INLINE void to_fine(const Values& samples, Values& fine) {
    quarter_intervals(samples.at, kBlockIntervals + 1, fine.at);
}
HWY_INLINE void to_columns(const Values& fine, Values& block) {
    quarter_intervals(fine.at, 4 * kBlockIntervals, block.at);
}

/// Weights of five neighbouring samples in the values of the sixteen columns that stand by the middle ones.
struct CoarseWeights {
    alignas(64) float at[5][kCoarseStride] = {};
    constexpr CoarseWeights() {
        for (std::size_t c = 0; c < kCoarseStride; ++c) {
            const std::size_t past = c + kFineStride, interval = past / kCoarseStride;
            const auto w = cubic_weights(static_cast<float>(past % kCoarseStride) / kCoarseStride);
            for (std::size_t i = 0; i < w.size(); ++i) at[interval + i][c] = w[i];
        }
    }
};
inline constexpr CoarseWeights kCoarseWeights;

/// Columns c and on of a block in one step, which does without memory between two.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V between_coarse(D d, const Values& samples, std::size_t c) {
    const float* first = samples.at + c / kCoarseStride;
    V sum = hn::Zero(d);
    for (std::size_t i = 0; i < 5; ++i)
        sum = hn::MulAdd(hn::Set(d, first[i]), hn::Load(d, kCoarseWeights.at[i] + c % kCoarseStride), sum);
    return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
