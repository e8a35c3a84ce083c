#include "ig_core/shading/shade.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/shading/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ig_core/shading/shade-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {

std::uint64_t Shade(std::span<const ShadeInput> jobs, ShadeBuffer& buffer) {
    StretchBatch<1> columns;
    StretchBatch<2> pairs;
    std::uint64_t terms = 0;
    for (const ShadeInput& in : jobs) {
        if (in.kind == ShadeInput::Kind::sky || in.kind == ShadeInput::Kind::light) {
            columns.shade(buffer), pairs.shade(buffer);
            in.kind == ShadeInput::Kind::sky ? shade_sky(in, buffer) : shade_light(in, buffer);
        } else if (in.row->pairs) {
            shade_pairs(in, pairs, buffer);
        } else {
            terms += shade_columns(in, columns, buffer);
        }
    }
    columns.shade(buffer), pairs.shade(buffer);
    return terms;
}

void TextureValues(const FrameTexture& texture, std::span<const float> x, std::span<const float> y,
                   std::span<const float> z, std::span<float> t) {
    const auto copy = [](std::span<const float> from, Values& to) { std::copy(from.begin(), from.end(), to.at); };
    for (std::size_t i = 0; i < t.size(); i += kMostSamples) {
        const std::size_t count = std::min(kMostSamples, t.size() - i);
        TexturePoints points{};
        copy(x.subspan(i, count), points.x), copy(y.subspan(i, count), points.y), copy(z.subspan(i, count), points.z);
        TextureSums sums;
        add_terms(texture, false, 0, texture.count, points, count, sums);
        for (std::size_t k = 0; k < count; ++k) t[i + k] = sums.x.at[k] * sums.y.at[k];
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(Shade);
HWY_EXPORT(TextureValues);

void ShadeBuffer::resize(std::size_t count) {
    if (red.size() >= count) return;
    for (auto* plane : {&red, &green, &blue, &opacity}) plane->resize(count);
}

std::uint64_t shade(std::span<const ShadeInput> jobs, ShadeBuffer& buffer) {
    return HWY_DYNAMIC_DISPATCH(Shade)(jobs, buffer);
}
void texture_values(const FrameTexture& texture, std::span<const float> x, std::span<const float> y,
                    std::span<const float> z, std::span<float> t) {
    HWY_DYNAMIC_DISPATCH(TextureValues)(texture, x, y, z, t);
}
std::string_view simd_target_name() {
    // The dispatcher takes the lowest set bit: better targets have smaller values.
    const std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    return hwy::TargetName(targets & -targets);
}

}  // namespace quadrig
#endif
