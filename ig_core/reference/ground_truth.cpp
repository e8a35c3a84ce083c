#include <algorithm>
#include <cmath>

#include "ig_core/reference/entry_bounds.h"
#include "ig_core/reference/reference_renderer.h"
#include "ig_core/reference/seen_scene.h"

namespace quadrig::reference {
namespace {

constexpr long double kInfinity = std::numeric_limits<long double>::infinity();
/// A tie: the answer changes when the ray moves by so many pixels, or two depths agree within this share.
constexpr double kTieShift = 1e-6;
constexpr double kTieDepth = 1e-9;

struct Identity {
    std::int32_t object = kSkyId;
    std::int32_t surface = 0;
    friend bool operator==(Identity, Identity) = default;
};

/// What is seen at a pixel centre.
struct Answer {
    Identity identity;
    double depth = std::numeric_limits<double>::infinity();
    std::uint8_t tie = 0;
};

template <class Scalar>
struct Nearest {
    Identity identity;
    Scalar depth = kInfinity;
    Scalar next_depth = kInfinity;
};

template <class Scalar>
Nearest<Scalar> nearest(const SeenScene& seen, const std::vector<std::uint32_t>& objects, Scalar column, Scalar row) {
    const auto direction = ray_direction<Scalar>(seen.view, column, row);
    Nearest<Scalar> best;
    const auto consider = [&best](Identity identity, Scalar depth) {
        if (in_front(depth, best.depth))
            best = {identity, depth, best.depth};
        else
            best.next_depth = std::min(best.next_depth, depth);
    };
    for (const std::uint32_t object : objects)
        if (const auto hit = entry(seen.solid<Scalar>(object), direction))
            consider({static_cast<std::int32_t>(object), hit->surface}, hit->depth);
    if (seen.scene.ground)
        if (const auto depth = level_depth(seen.view, 0.0, direction)) consider({kGroundId, 0}, *depth);
    return best;
}

/// Long double finds the suspects, quad decides.
bool changes_nearby(const SeenScene& seen, const std::vector<std::uint32_t>& objects, Identity here, int column,
                    int row) {
    for (const int across : {-1, 0, 1}) {
        for (const int down : {-1, 0, 1}) {
            const long double x = column + 0.5L + across * static_cast<long double>(kTieShift);
            const long double y = row + 0.5L + down * static_cast<long double>(kTieShift);
            if (nearest<long double>(seen, objects, x, y).identity == here) continue;
            if (nearest<Quad>(seen, objects, x, y).identity != here) return true;
        }
    }
    return false;
}

Answer exact_answer(const SeenScene& seen, const std::vector<std::uint32_t>& objects, int column, int row,
                    bool find_ties) {
    const auto answer = nearest<Quad>(seen, objects, column + Quad(0.5), row + Quad(0.5));
    const bool depths_agree = answer.depth < kInfinity && answer.next_depth - answer.depth <= kTieDepth * answer.depth;
    std::uint8_t tie = 0;
    if (find_ties && changes_nearby(seen, objects, answer.identity, column, row))
        tie = kTie;
    else if (find_ties && depths_agree)
        tie = kTieInDepth;
    return {answer.identity, static_cast<double>(answer.depth), tie};
}

/// The pixels of one tile, one after the other.
class PixelJudge {
  public:
    PixelJudge(const SeenScene& seen, const Tile& tile)
        : seen_(seen),
          tile_(tile),
          reach_(1.01 * kTieShift * std::hypot(seen.view.image.column_step, seen.view.image.row_step)) {}

    [[nodiscard]] Answer answer(int column, int row, bool find_ties) {
        const Vector<double> direction = seen_.direction(column + 0.5, row + 0.5);
        const std::optional<Contender> front = triage(direction);
        if (!front) return {};
        if (const auto settled = settle(*front, column, row)) return *settled;
        objects_.clear();
        for (const Contender& contender : contenders_)
            if (contender.id >= 0 && !is_behind(contender, *front))
                objects_.push_back(static_cast<std::uint32_t>(contender.id));
        return exact_answer(seen_, objects_, column, row, find_ties);
    }

  private:
    /// What the rays about a pixel centre may meet.
    struct Contender {
        std::int32_t id;
        EntryBounds bounds;
    };

    /// Behind by more than a tie, on every ray.
    static bool is_behind(const Contender& a, const Contender& b) {
        return a.bounds.least_depth > b.bounds.greatest_depth * (1 + 2 * kTieDepth);
    }

    /// Gathers the contenders; the one that is certain to be met at the least depth, or else any, or nothing for sky.
    std::optional<Contender> triage(const Vector<double>& direction) {
        contenders_.clear();
        const auto gather = [this](std::int32_t id, const EntryBounds& bounds) {
            if (bounds.verdict != EntryBounds::Verdict::misses) contenders_.push_back({id, bounds});
        };
        for (const std::uint32_t object : tile_.candidates)
            if (may_meet(seen_.spheres[object], {direction[0], direction[1], direction[2]}))
                gather(static_cast<std::int32_t>(object), entry_bounds(seen_.triage[object], direction, reach_));
        if (seen_.scene.ground) gather(kGroundId, level_plane_bounds(-seen_.view.eye.metres.z, direction, reach_));
        const auto front = std::min_element(
            contenders_.begin(), contenders_.end(),
            [](const Contender& a, const Contender& b) { return a.bounds.greatest_depth < b.bounds.greatest_depth; });
        if (front == contenders_.end()) return std::nullopt;
        return *front;
    }

    /// The answer where it is beyond doubt: no other contender comes near `front`. Its depth is asked of long double.
    [[nodiscard]] std::optional<Answer> settle(const Contender& front, int column, int row) const {
        const EntryBounds& bounds = front.bounds;
        if (bounds.verdict != EntryBounds::Verdict::enters) return std::nullopt;
        if (bounds.greatest_depth - bounds.least_depth > 1e-5 * bounds.least_depth) return std::nullopt;
        for (const Contender& other : contenders_)
            if (other.id != front.id && !is_behind(other, front)) return std::nullopt;
        const auto direction = ray_direction<long double>(seen_.view, column + 0.5L, row + 0.5L);
        if (front.id == kGroundId) {
            const auto depth = level_depth(seen_.view, 0.0, direction);
            if (!depth) return std::nullopt;
            return Answer{{kGroundId, 0}, static_cast<double>(*depth)};
        }
        const auto hit = entry(seen_.values[static_cast<std::size_t>(front.id)], direction);
        if (!hit || hit->surface != bounds.surface) return std::nullopt;
        return Answer{{front.id, hit->surface}, static_cast<double>(hit->depth)};
    }

    const SeenScene& seen_;
    const Tile& tile_;
    double reach_;
    std::vector<Contender> contenders_;
    std::vector<std::uint32_t> objects_;
};

}  // namespace

GroundTruth ground_truth(const Scene& scene, const View& view, std::vector<std::uint8_t>* ties) {
    const SeenScene seen(scene, view);
    const auto width = static_cast<std::size_t>(view.image.width);
    const std::size_t pixels = width * static_cast<std::size_t>(view.image.height);
    GroundTruth truth;
    truth.resize(pixels);
    if (ties) ties->assign(pixels, 0);
    for_each_tile(view, seen.spheres, [&](const Tile& tile) {
        PixelJudge judge(seen, tile);
        for (int row = tile.first_row; row < tile.end_row; ++row) {
            for (int column = tile.first_column; column < tile.end_column; ++column) {
                const Answer answer = judge.answer(column, row, ties != nullptr);
                const std::size_t pixel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
                truth.object_ids[pixel] = answer.identity.object;
                truth.surface_ids[pixel] = answer.identity.surface;
                truth.depth[pixel] = answer.depth;
                if (ties) (*ties)[pixel] = answer.tie;
            }
        }
    });
    return truth;
}

}  // namespace quadrig::reference
