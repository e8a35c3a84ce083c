/// Samples of a surface, worked on together: each step of shading is done for all of them before the next. Within a
/// step, chains of dependent instructions are so short that a core sees the next samples' in time.
// Per-target include guard: this header is compiled once for every instruction set.
#if defined(QUADRIG_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef QUADRIG_SAMPLES_INL_H_
#undef QUADRIG_SAMPLES_INL_H_
#else
#define QUADRIG_SAMPLES_INL_H_
#endif

#include <hwy/highway.h>

#include "ig_core/shading/shade_job.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMostSamples = 192;

/// One value of each sample. Samples of several stretches stand one behind the other, so vectors begin anywhere.
struct Values {
    alignas(64) float at[kMostSamples + kShadePadding];
    template <class D>
    [[nodiscard]] HWY_INLINE hn::Vec<D> load(D d, std::size_t i) const {
        return hn::LoadU(d, at + i);
    }
    template <class D>
    HWY_INLINE void store(D d, hn::Vec<D> values, std::size_t i) {
        hn::StoreU(values, d, at + i);
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
