// Heights and lines of sight asked of the running program, against rays of the reference renderer.
#include <GeographicLib/LocalCartesian.hpp>
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>

#include "config/scene_file.h"
#include "host_link/cigi_query.h"
#include "ig_core/reference/reference_renderer.h"
#include "tests/appliance/files.h"
#include "tests/appliance/host_socket.h"
#include "tests/appliance/program.h"
#include "tests/ig_core/randomness.h"

using namespace quadrig;
using namespace quadrig::tests;
using namespace std::chrono_literals;
namespace cigi = host::cigi;
using test::Randomness;

namespace {

constexpr GeodeticPosition kOrigin{{47.26}, {11.34}, 581.0};
constexpr double kHighest = 2000.0;   ///< m, above everything there is
constexpr std::uint32_t kAsked = 50;  ///< questions of a message

/// Hills, cut balls and boxes on a ground; each has a texture of its own, so that its material names it.
Scene landscape() {
    Randomness random(1);
    Scene scene;
    scene.origin = kOrigin;
    const auto own_paint = [&] {
        scene.textures.push_back({"texture-" + std::to_string(scene.textures.size()), {TextureTerm{}}});
        Paint paint;
        paint.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
        return paint;
    };
    scene.ground = Ground{own_paint()};
    for (int i = 0; i < 24; ++i) {
        Object object;
        object.name = "object-" + std::to_string(i);
        object.paint = own_paint();
        const glm::dvec3 at(random.between(-400, 400), random.between(-400, 400), random.between(0, 120));
        if (i % 4 == 0)
            object.shape = Hill{{at}, random.between(20, 100), random.between(0.3, 0.8)};
        else
            object.shape = Ellipsoid{
                {at}, {random.between(10, 80), random.between(10, 80), random.between(10, 80)}, random.attitude()};
        for (int plane = 0; plane < i % 3; ++plane) {
            const glm::dvec3 normal = random.direction();
            object.planes.push_back({{normal.x, normal.y, normal.z, 5.0 - glm::dot(normal, at)}});
        }
        scene.objects.push_back(object);
    }
    return scene;
}

/// What the exact renderer sees along a line: material code and distance; nothing where a hair's breadth decides.
struct Seen {
    std::uint32_t material = 0;
    double distance = 0.0;  ///< infinite: nothing is met
};
std::optional<Seen> seen(const Scene& scene, const glm::dvec3& from, const glm::dvec3& along) {
    const glm::dvec3 other = std::abs(along.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(along, other)), up = glm::cross(right, along);
    const View view{{from}, glm::transpose(glm::dmat3(right, along, up)), ImagePlane::symmetric(1, 1, {1.0})};
    std::vector<std::uint8_t> ties;
    const GroundTruth truth = reference::ground_truth(scene, view, &ties);
    if (ties[0] != 0) return std::nullopt;
    const int id = truth.object_ids[0];
    if (id == kSkyId) return Seen{0, truth.depth[0]};
    const Paint& paint = id == kGroundId ? scene.ground->paint : scene.objects[static_cast<std::size_t>(id)].paint;
    return Seen{*paint.texture + 1, truth.depth[0]};
}

/// The answers to a message, by request.
struct Answers {
    std::map<std::uint16_t, cigi::HatHotExtendedResponse> heights;
    std::map<std::uint16_t, cigi::LosExtendedResponse> lines;
};

/// Sends questions behind a pose and waits for an answer to each.
Answers ask(const HostSocket& host, std::uint32_t frame, const Bytes& questions, std::size_t count) {
    host.send(cigi_message(frame, {}, questions));
    Answers answers;
    while (answers.heights.size() + answers.lines.size() < count) {
        const Bytes bytes = host.receive(20s);
        REQUIRE_FALSE(bytes.empty());
        std::span<const std::byte> rest(bytes);
        while (!rest.empty()) {
            const auto id = std::to_integer<unsigned>(rest[0]);
            const auto packet = rest.first(std::to_integer<std::size_t>(rest[1]));
            rest = rest.subspan(packet.size());
            if (id == cigi::HatHotExtendedResponse::kId) {
                const auto answer = cigi::decode<cigi::HatHotExtendedResponse>(packet, host::ByteOrder::big);
                answers.heights[answer.request] = answer;
            } else if (id == cigi::LosExtendedResponse::kId) {
                const auto answer = cigi::decode<cigi::LosExtendedResponse>(packet, host::ByteOrder::big);
                answers.lines[answer.request] = answer;
            }
        }
    }
    return answers;
}

/// Places on the earth, and where in the scene they are: GeographicLib's arithmetic, not the program's.
class Earth {
  public:
    [[nodiscard]] glm::dvec3 scene(const std::array<double, 3>& place) const {
        glm::dvec3 p;
        local_.Forward(place[0], place[1], place[2], p.x, p.y, p.z);
        return p;
    }
    static std::array<double, 3> random_place(Randomness& random) {
        return {kOrigin.latitude.value + random.between(-4e-3, 4e-3),
                kOrigin.longitude.value + random.between(-5e-3, 5e-3), kOrigin.altitude + random.between(1, 300)};
    }

  private:
    GeographicLib::LocalCartesian local_{kOrigin.latitude.value, kOrigin.longitude.value, kOrigin.altitude};
};

double tolerance(double distance) { return std::max(1e-6, 1e-9 * distance); }

}  // namespace

// QUADRIG_TEST_SCALE=10 makes it 10,000 questions.
TEST_CASE("Heights and lines of sight asked of a live run are those that the reference renderer sees") {
    CAPTURE(test::seed());
    const auto file = scratch_directory() / "scene.toml";
    {
        std::ofstream stream(file);
        config::write_scene(landscape(), stream);
    }
    const Scene scene = config::read_scene(file);
    Program program(
        {"run", "--scene", file, "--link", "cigi://127.0.0.1:0", "--size", "16x12", "--threads", "1", "--rate", "250"});
    const auto port = program.number_after("listens on port ");
    REQUIRE(port);
    const HostSocket host(*port);
    const Earth earth;
    int heights = 0, lines = 0, met = 0;
    for (int message = 0; message < test::trials(20); ++message) {
        Randomness random(message);
        std::vector<cigi::HatHotRequest> height_questions;
        std::vector<cigi::LosSegmentRequest> line_questions;
        Bytes questions;
        for (std::uint16_t i = 0; i < kAsked; ++i) {
            if (i % 2 == 0) {
                height_questions.push_back({.request = i, .kind = cigi::HeightKind::extended});
                height_questions.back().point = Earth::random_place(random);
                host::test::append(questions, height_questions.back(), host::ByteOrder::big);
            } else {
                line_questions.push_back({.request = i, .extended = true});
                line_questions.back().source = Earth::random_place(random);
                line_questions.back().destination = Earth::random_place(random);
                host::test::append(questions, line_questions.back(), host::ByteOrder::big);
            }
        }
        Answers answers = ask(host, static_cast<std::uint32_t>(message), questions, kAsked);
        for (const auto& question : height_questions) {
            auto top = question.point;
            top[2] = kHighest;
            const glm::dvec3 from = earth.scene(top);
            const auto truth = seen(scene, from, glm::normalize(earth.scene(question.point) - from));
            if (!truth) continue;
            ++heights;
            const auto& answer = answers.heights.at(question.request);
            CAPTURE(message, question.request, question.point);
            REQUIRE(answer.valid);
            REQUIRE(answer.material == truth->material);
            REQUIRE(std::abs(answer.of_terrain - (kHighest - truth->distance)) <= tolerance(kHighest));
            REQUIRE(std::abs(answer.above_terrain - (question.point[2] - answer.of_terrain)) <= tolerance(0));
        }
        for (const auto& question : line_questions) {
            const glm::dvec3 from = earth.scene(question.source), to = earth.scene(question.destination);
            const double length = glm::distance(from, to);
            const auto truth = seen(scene, from, (to - from) / length);
            // What the picture leaves out before the eye a line of sight meets.
            if (!truth || std::abs(truth->distance - length) < 1e-3 || truth->distance < 10 * kNearDepth) continue;
            ++lines;
            const auto& answer = answers.lines.at(question.request);
            CAPTURE(message, question.request, question.source, question.destination);
            REQUIRE(answer.valid);
            REQUIRE(answer.visible == (truth->distance > length));
            if (answer.visible) continue;
            ++met;
            REQUIRE(answer.material == truth->material);
            REQUIRE(std::abs(answer.range - truth->distance) <= tolerance(truth->distance));
            REQUIRE(glm::distance(earth.scene(answer.point), from + truth->distance * (to - from) / length) <=
                    tolerance(truth->distance));
        }
    }
    program.signal(SIGTERM);
    CHECK(program.wait().status == 0);
    CHECK(heights > 24 * test::trials(20));
    CHECK(lines > 22 * test::trials(20));
    CHECK(met > lines / 20);
}
