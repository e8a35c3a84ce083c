#include "ig_core/shading/compositing.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ig_core/shading/compositing.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "ig_core/shading/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace quadrig {
namespace HWY_NAMESPACE {

/// Layers that each cover all of every pixel, laid over one another from a column on.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vec3<V> laid_over(D d, const ShadeBuffer& buffer, std::span<const CompositeLayer> layers,
                             std::size_t column) {
    const V one = hn::Set(d, 1.0F);
    Vec3<V> light{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    V through = one;
    for (const CompositeLayer& layer : layers) {
        const std::size_t at = layer.sample(column);
        const V opacity = hn::LoadU(d, buffer.opacity.data() + at);
        const V weight = hn::Mul(through, opacity);
        light.x = hn::MulAdd(weight, hn::LoadU(d, buffer.red.data() + at), light.x);
        light.y = hn::MulAdd(weight, hn::LoadU(d, buffer.green.data() + at), light.y);
        light.z = hn::MulAdd(weight, hn::LoadU(d, buffer.blue.data() + at), light.z);
        through = hn::Mul(through, hn::Sub(one, opacity));
    }
    return light;
}

void CompositeWhole(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, ShadeBuffer& row) {
    const hn::ScalableTag<float> d;
    for (const CompositeRun& run : runs) {
        const std::size_t total = static_cast<std::size_t>(run.to - run.from);
        for (std::size_t i = 0; i < total; i += hn::Lanes(d)) {
            const std::size_t column = static_cast<std::size_t>(run.from) + i;
            const auto light = laid_over(d, buffer, run.layers, column);
            hn::StoreU(light.x, d, row.red.data() + column);
            hn::StoreU(light.y, d, row.green.data() + column);
            hn::StoreU(light.z, d, row.blue.data() + column);
        }
    }
}

/// A sub-scan line of cells at a time, or two; less on targets without vectors.
using CellTag = hn::CappedTag<float, 2 * kCellsPerLine>;
using Cells = hn::Vec<CellTag>;
constexpr std::size_t kCellLanes = hn::MaxLanes(CellTag());

/// What the sub-scan lines of cells `first` and on have, in those cells. Cells that no line has are given the last's.
HWY_INLINE Cells of_lines(std::size_t first, std::size_t lines, const std::array<double, kMaxSubScanLines>& ends,
                          int column) {
    const CellTag d;
    const std::size_t line = std::min(first / kCellsPerLine, lines - 1);
    const auto in_cells = [&](std::size_t i) { return static_cast<float>(ends[i] - column) * kCellsPerLine; };
    const Cells next = hn::Set(d, in_cells(std::min(line + 1, lines - 1)));
    return hn::IfThenElse(hn::FirstN(d, kCellsPerLine), hn::Set(d, in_cells(line)), next);
}

/// Share of the cells from `first` on of a pixel that lies between a span's ends.
HWY_INLINE Cells cell_cover(std::size_t first, std::size_t lines, const RowSpan& span, int column) {
    const CellTag d;
    const Cells zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    alignas(32) static constexpr float kLeftEdges[2 * kCellsPerLine] = {0, 1, 2, 3, 0, 1, 2, 3};
    const Cells left_edge = hn::Load(d, kLeftEdges + first % kCellsPerLine);
    const Cells upper = hn::Clamp(hn::Sub(of_lines(first, lines, span.to, column), left_edge), zero, one);
    const Cells lower = hn::Clamp(hn::Sub(of_lines(first, lines, span.from, column), left_edge), zero, one);
    return hn::Max(zero, hn::Sub(upper, lower));
}

/// Columns of up to kCells / kCellsPerLine sub-scan lines; cells that no line has are in the dark from the start.
template <std::size_t kCells>
HWY_INLINE void composite_cells(const ShadeBuffer& buffer, const CompositeRun& run, std::size_t lines,
                                ShadeBuffer& row) {
    const CellTag d;
    const Cells zero = hn::Zero(d), one = hn::Set(d, 1.0F);
    const float cells = static_cast<float>(lines * kCellsPerLine), scale = 1.0F / cells;
    alignas(32) float through[kCells], at_group[kCells];
    for (int column = run.from; column < run.to; ++column) {
        for (std::size_t i = 0; i < kCells; i += kCellLanes)
            hn::Store(hn::IfThenElseZero(hn::Lt(hn::Iota(d, static_cast<float>(i)), hn::Set(d, cells)), one), d,
                      through + i);
        std::uint32_t group = ~0U;
        float red = 0, green = 0, blue = 0;
        for (const CompositeLayer& layer : run.layers) {
            // Layers of one group lie side by side: what one of them leaves uncovered the next may fill, so both start
            // from the light that reached the group. Otherwise the background would show along their common edge.
            if (layer.group != group) std::copy_n(through, kCells, at_group);
            group = layer.group;
            const RowSpan& span = *layer.span;
            const bool covers_all = (span.inner_from <= run.from) & (span.inner_to >= run.to);
            const std::size_t sample = layer.sample(static_cast<std::size_t>(column));
            const Cells alpha = hn::Set(d, buffer.opacity[sample]);
            Cells sum = zero, left = zero;
            for (std::size_t i = 0; i < kCells; i += kCellLanes) {
                const Cells cover = covers_all ? one : cell_cover(i, lines, span, column);
                const Cells weight = hn::Mul(hn::Mul(cover, alpha), hn::Load(d, at_group + i));
                const Cells rest = hn::Max(zero, hn::Sub(hn::Load(d, through + i), weight));
                hn::Store(rest, d, through + i);
                sum = hn::Add(sum, weight);
                left = hn::Max(left, rest);
            }
            const float weight = hn::GetLane(hn::SumOfLanes(d, sum)) * scale;
            red += weight * buffer.red[sample];
            green += weight * buffer.green[sample];
            blue += weight * buffer.blue[sample];
            if (hn::AllTrue(d, hn::Lt(left, hn::Set(d, 1.0F / 4096.0F)))) break;
        }
        const auto at = static_cast<std::size_t>(column);
        row.red[at] = red, row.green[at] = green, row.blue[at] = blue;
    }
}

void CompositePartial(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, int sub_lines, ShadeBuffer& row) {
    const auto lines = static_cast<std::size_t>(sub_lines);
    for (const CompositeRun& run : runs) {
        if (lines <= 2)
            composite_cells<2 * kCellsPerLine>(buffer, run, lines, row);
        else
            composite_cells<kMaxCells>(buffer, run, lines, row);
    }
}

/// Most runs of edge pixels are no longer.
using EdgeTag = hn::CappedTag<double, 4>;

/// Share of the pixels from column `left` on that lies between a span's ends, on the mean of the sub-scan lines.
HWY_INLINE hn::Vec<hn::Rebind<float, EdgeTag>> pixel_cover(const RowSpan& span, hn::Vec<EdgeTag> left,
                                                           std::size_t lines, double share) {
    const EdgeTag d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
    auto sum = zero;
    for (std::size_t i = 0; i < lines; ++i) {
        const auto to = hn::Clamp(hn::Sub(hn::Set(d, span.to[i]), left), zero, one);
        const auto from = hn::Clamp(hn::Sub(hn::Set(d, span.from[i]), left), zero, one);
        sum = hn::Add(sum, hn::Max(zero, hn::Sub(to, from)));
    }
    return hn::DemoteTo(hn::Rebind<float, EdgeTag>(), hn::Mul(sum, hn::Set(d, share)));
}

void CompositeBeforeWhole(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, int sub_lines,
                          ShadeBuffer& row) {
    const EdgeTag dd;
    const hn::Rebind<float, EdgeTag> d;
    const auto lines = static_cast<std::size_t>(sub_lines);
    const double share = 1.0 / sub_lines;
    for (const CompositeRun& run : runs) {
        const std::span<const CompositeLayer> in_front = run.layers.first(run.layers.size() - 1);
        const auto total = static_cast<std::size_t>(run.to - run.from);
        for (std::size_t i = 0; i < total; i += hn::Lanes(d)) {
            const std::size_t column = static_cast<std::size_t>(run.from) + i, whole = run.layers.back().sample(column);
            const auto left = hn::Iota(dd, static_cast<double>(column));
            const auto r = hn::LoadU(d, buffer.red.data() + whole), g = hn::LoadU(d, buffer.green.data() + whole),
                       b = hn::LoadU(d, buffer.blue.data() + whole);
            auto red = r, green = g, blue = b;
            for (const CompositeLayer& layer : in_front) {
                const std::size_t at = layer.sample(column);
                const auto weight =
                    hn::Mul(pixel_cover(*layer.span, left, lines, share), hn::LoadU(d, buffer.opacity.data() + at));
                red = hn::Add(red, hn::Mul(weight, hn::Sub(hn::LoadU(d, buffer.red.data() + at), r)));
                green = hn::Add(green, hn::Mul(weight, hn::Sub(hn::LoadU(d, buffer.green.data() + at), g)));
                blue = hn::Add(blue, hn::Mul(weight, hn::Sub(hn::LoadU(d, buffer.blue.data() + at), b)));
            }
            const auto within = hn::FirstN(d, total - i);
            hn::BlendedStore(red, within, d, row.red.data() + column);
            hn::BlendedStore(green, within, d, row.green.data() + column);
            hn::BlendedStore(blue, within, d, row.blue.data() + column);
        }
    }
}

void AverageSquares(const ShadeBuffer& upper, int count, ShadeBuffer& lower) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const auto average = [&](const std::vector<float>& above, std::vector<float>& below) HWY_ATTR {
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); i += hn::Lanes(d)) {
            V left, right, lower_left, lower_right;
            hn::LoadInterleaved2(d, above.data() + 2 * i, left, right);
            hn::LoadInterleaved2(d, below.data() + 2 * i, lower_left, lower_right);
            const V sum = hn::Add(hn::Add(left, right), hn::Add(lower_left, lower_right));
            hn::StoreU(hn::Mul(sum, hn::Set(d, 0.25F)), d, below.data() + i);
        }
    };
    average(upper.red, lower.red);
    average(upper.green, lower.green);
    average(upper.blue, lower.blue);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE Vec3<V> light_of(D d, const ShadeBuffer& row, std::size_t i) {
    return {hn::LoadU(d, row.red.data() + i), hn::LoadU(d, row.green.data() + i), hn::LoadU(d, row.blue.data() + i)};
}

/// Linear light as pixels R G B 255.
template <class D, class DI = hn::RebindToSigned<D>>
HWY_INLINE hn::Vec<DI> packed_pixels(D d, const Vec3<hn::Vec<D>>& light) {
    const DI di;
    // The upper bits, those of kToNearest, cancel in the sum.
    const auto rounded = [&](hn::Vec<D> linear) HWY_ATTR {
        return hn::BitCast(di, hn::Add(srgb_steps(d, linear), hn::Set(d, kToNearest)));
    };
    constexpr std::uint32_t kWhole = 0x4B400000U, kOpaque = 0xFF000000U;
    constexpr auto kRest = static_cast<std::int32_t>(kOpaque - kWhole - (kWhole << 8) - (kWhole << 16));
    const auto rg = hn::Add(rounded(light.x), hn::ShiftLeft<8>(rounded(light.y)));
    return hn::Add(hn::Add(rg, hn::Set(di, kRest)), hn::ShiftLeft<16>(rounded(light.z)));
}

void PackSrgb8(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, const ShadeBuffer& row, int count,
               std::uint8_t* HWY_RESTRICT rgba) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const std::size_t n = hn::Lanes(d), total = static_cast<std::size_t>(count);
    // What is written past the end of some columns the next overwrite.
    const auto pack = [&](std::size_t from, std::size_t to, auto&& light) HWY_ATTR {
        for (std::size_t i = from; i < to; i += n) {
            const auto packed = packed_pixels(d, light(i));
            if (i + n <= total) {
                hn::StoreU(packed, di, reinterpret_cast<std::int32_t*>(rgba + 4 * i));
            } else {
                alignas(64) std::int32_t pixels[64];
                hn::Store(packed, di, pixels);
                std::copy_n(reinterpret_cast<const std::uint8_t*>(pixels), 4 * (total - i), rgba + 4 * i);
            }
        }
    };
    const auto of_row = [&](std::size_t i) HWY_ATTR { return light_of(d, row, i); };
    std::size_t done = 0;
    for (const CompositeRun& run : runs) {
        const auto from = static_cast<std::size_t>(run.from), to = static_cast<std::size_t>(run.to);
        pack(done, from, of_row);
        if (run.layers.size() == 1)  // which is opaque
            pack(from, to, [&](std::size_t i) HWY_ATTR { return light_of(d, buffer, run.layers[0].sample(i)); });
        else
            pack(from, to, [&](std::size_t i) HWY_ATTR { return laid_over(d, buffer, run.layers, i); });
        done = to;
    }
    pack(done, total, of_row);
}

void PackSrgb8Doubled(const ShadeBuffer& row, int count, std::uint8_t* HWY_RESTRICT upper,
                      std::uint8_t* HWY_RESTRICT lower) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const std::size_t n = hn::Lanes(d), total = static_cast<std::size_t>(count);
    alignas(64) std::int32_t pixels[128];
    for (std::size_t i = 0; i < total; i += 2 * n) {
        const auto packed = packed_pixels(d, light_of(d, row, i / 2));
        if (i + 2 * n <= total) {
            hn::StoreInterleaved2(packed, packed, di, reinterpret_cast<std::int32_t*>(upper + 4 * i));
        } else {
            hn::StoreInterleaved2(packed, packed, di, pixels);
            std::copy_n(reinterpret_cast<const std::uint8_t*>(pixels), 4 * (total - i), upper + 4 * i);
        }
    }
    if (lower != nullptr) std::copy_n(upper, 4 * total, lower);
}

}  // namespace HWY_NAMESPACE
}  // namespace quadrig
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace quadrig {

HWY_EXPORT(CompositeWhole);
HWY_EXPORT(CompositePartial);
HWY_EXPORT(CompositeBeforeWhole);
HWY_EXPORT(AverageSquares);
HWY_EXPORT(PackSrgb8);
HWY_EXPORT(PackSrgb8Doubled);

void composite_whole(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, ShadeBuffer& row) {
    HWY_DYNAMIC_DISPATCH(CompositeWhole)(buffer, runs, row);
}
void composite_partial(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, int sub_lines, ShadeBuffer& row) {
    HWY_DYNAMIC_DISPATCH(CompositePartial)(buffer, runs, sub_lines, row);
}
void composite_before_whole(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, int sub_lines,
                            ShadeBuffer& row) {
    HWY_DYNAMIC_DISPATCH(CompositeBeforeWhole)(buffer, runs, sub_lines, row);
}
void average_squares(const ShadeBuffer& upper, int count, ShadeBuffer& lower) {
    HWY_DYNAMIC_DISPATCH(AverageSquares)(upper, count, lower);
}
void pack_srgb8(const ShadeBuffer& row, int count, std::uint8_t* rgba) { pack_srgb8(row, {}, row, count, rgba); }
void pack_srgb8(const ShadeBuffer& buffer, std::span<const CompositeRun> runs, const ShadeBuffer& row, int count,
                std::uint8_t* rgba) {
    HWY_DYNAMIC_DISPATCH(PackSrgb8)(buffer, runs, row, count, rgba);
}
void pack_srgb8_doubled(const ShadeBuffer& row, int count, std::uint8_t* upper, std::uint8_t* lower) {
    HWY_DYNAMIC_DISPATCH(PackSrgb8Doubled)(row, count, upper, lower);
}

}  // namespace quadrig
#endif
