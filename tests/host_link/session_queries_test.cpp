// A CIGI host's questions about heights and lines of sight, over a scene that is a formula: flat ground with a ball on
// it.
#include <GeographicLib/LocalCartesian.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "host_link/cigi_query.h"
#include "host_link/session.h"
#include "support.h"

using namespace quadrig;
using namespace quadrig::host;
using namespace quadrig::host::test;
using namespace std::chrono_literals;

namespace {

const GeodeticPosition kOrigin{{47.26}, {11.34}, 600.0};
constexpr double kRadius = 50.0;
const glm::dvec3 kBall{0.0, 1000.0, 80.0};

/// Nearest of the plane Z = 0 and a ball, by the textbook.
std::optional<SurveyHit> formula(const SurveyLine& line) {
    std::optional<SurveyHit> best;
    const auto consider = [&](double distance, const glm::dvec3& normal, std::uint32_t material) {
        if (!(distance > line.least) || distance > line.most || (best && best->distance < distance)) return;
        best = SurveyHit{distance, {line.from.metres + distance * line.direction}, normal, material};
    };
    if (line.direction.z != 0.0) consider(-line.from.metres.z / line.direction.z, {0.0, 0.0, 1.0}, 7);
    const glm::dvec3 to = kBall - line.from.metres;
    const double along = glm::dot(to, line.direction), beside2 = glm::dot(to, to) - along * along;
    if (beside2 < kRadius * kRadius) {
        const double distance = along - std::sqrt(kRadius * kRadius - beside2);
        consider(distance, (line.from.metres + distance * line.direction - kBall) / kRadius, 9);
    }
    return best;
}

struct Asking {
    Session session{[] {
        SessionOptions options;
        options.scene_origin = kOrigin;
        options.surveyor = formula;
        return options;
    }()};
    GeographicLib::LocalCartesian earth{47.26, 11.34, 600.0};
    std::uint32_t frame = 0;
    std::span<const Session::Response> answers;

    std::array<double, 3> geodetic(double x, double y, double z) const {
        std::array<double, 3> g{};
        earth.Reverse(x, y, z, g[0], g[1], g[2]);
        return g;
    }
    template <class... P>
    std::span<const Session::Response> ask(const P&... packets) {
        ++frame;
        session.accept(message(ByteOrder::big, ig_control(frame), packets...), frame * 16ms);
        return answers = session.responses();
    }
    template <class P>
    P answer(std::size_t i = 0) {
        REQUIRE(answers.size() > i);
        REQUIRE(answers[i].size == P::kSize);
        REQUIRE(answers[i].bytes[0] == std::byte{P::kId});
        return cigi::decode<P>(answers[i].bytes, ByteOrder::big);
    }
};

}  // namespace

TEST_CASE("Height above terrain and height of terrain are those of the highest surface below or above the point") {
    Asking host;
    cigi::HatHotRequest request{.request = 12, .point = host.geodetic(30.0, 40.0, 250.0)};
    host.ask(request);
    // A plane through the origin: a millimetre below the ellipsoidal height 600 at 50 m.
    CHECK(host.answer<cigi::HatHotResponse>().height == Approx(250.0).margin(2e-3));
    CHECK(host.answer<cigi::HatHotResponse>().request == 12);
    CHECK(host.answer<cigi::HatHotResponse>().valid);
    CHECK_FALSE(host.answer<cigi::HatHotResponse>().of_terrain);
    CHECK(host.answer<cigi::HatHotResponse>().host_frame == 1);
    request.kind = cigi::HeightKind::of_terrain;
    host.ask(request);
    CHECK(host.answer<cigi::HatHotResponse>().height == Approx(600.0).margin(2e-3));
    CHECK(host.answer<cigi::HatHotResponse>().of_terrain);
    // Below the top of the ball.
    request = {.request = 13, .kind = cigi::HeightKind::extended, .point = host.geodetic(0.0, 1000.0, 30.0)};
    host.ask(request);
    const auto both = host.answer<cigi::HatHotExtendedResponse>();
    CHECK(both.of_terrain == Approx(730.0).margin(0.1));
    CHECK(both.above_terrain == Approx(-100.0).margin(0.01));
    CHECK(both.material == 9);
    CHECK(both.normal_elevation == Approx(90.0F).margin(0.02));
}

TEST_CASE("A segment is seen along, or stopped at the first surface, which is told in full where asked for") {
    Asking host;
    cigi::LosSegmentRequest request{
        .request = 5, .source = host.geodetic(0.0, 0.0, 80.0), .destination = host.geodetic(0.0, 900.0, 80.0)};
    host.ask(request);
    CHECK(host.answer<cigi::LosResponse>().visible);
    CHECK(host.answer<cigi::LosResponse>().valid);
    request.destination = host.geodetic(0.0, 2000.0, 80.0);
    request.extended = true;
    host.ask(request);
    const auto stopped = host.answer<cigi::LosExtendedResponse>();
    CHECK(stopped.valid);
    CHECK(stopped.range_valid);
    CHECK_FALSE(stopped.visible);
    CHECK(stopped.range == Approx(950.0));
    const auto there = host.geodetic(0.0, 950.0, 80.0);
    CHECK(stopped.point[0] == Approx(there[0]).epsilon(1e-12));
    CHECK(stopped.point[1] == Approx(there[1]).epsilon(1e-12));
    CHECK(stopped.point[2] == Approx(there[2]).margin(1e-6));
    CHECK(stopped.material == 9);
    // The ball faces south: 180 or -180.
    CHECK(std::abs(stopped.normal_azimuth) == Approx(180.0F).margin(0.01));
    CHECK(stopped.normal_elevation == Approx(0.0F).margin(0.02));
}

TEST_CASE("A vector is followed from the ownship, in its own axes or by the compass") {
    Asking host;
    const auto at = host.geodetic(0.0, 0.0, 80.0);
    auto own = ownship(at[0], at[1], at[2]);
    own.yaw = 90.0F;
    // Left of an aircraft that flies east is north.
    cigi::LosVectorRequest request{.request = 6, .extended = true, .source_entity = true, .response_entity = true};
    request.azimuth = -90.0F;
    request.most = 5000.0F;
    host.ask(own, request);
    auto hit = host.answer<cigi::LosExtendedResponse>();
    CHECK(hit.range == Approx(950.0));
    CHECK(hit.point[0] == Approx(0.0).margin(1e-6));
    CHECK(hit.point[1] == Approx(-950.0));
    CHECK(hit.point[2] == Approx(0.0).margin(1e-3));
    CHECK(hit.normal_azimuth == Approx(90.0F));
    request.source_entity = request.response_entity = false;
    request.source = at;
    request.azimuth = 0.0F;
    host.ask(own, request);
    CHECK(host.answer<cigi::LosExtendedResponse>().range == Approx(950.0));
    request.elevation = -30.0F;
    host.ask(request);
    CHECK(host.answer<cigi::LosExtendedResponse>().range == Approx(160.0).epsilon(1e-6));
    CHECK(host.answer<cigi::LosExtendedResponse>().material == 7);
    request.least = 200.0F;
    host.ask(request);
    CHECK_FALSE(host.answer<cigi::LosExtendedResponse>().valid);
}

TEST_CASE("A request with a period is answered every so many frames, until it is asked once more without") {
    Asking host;
    cigi::HatHotRequest request{.request = 300, .period = 3, .point = host.geodetic(0.0, 0.0, 10.0)};
    CHECK(host.ask(request).size() == 1);
    CHECK(host.ask(cigi::HatHotRequest{.request = 44, .point = request.point}).size() == 1);
    CHECK(host.ask().empty());
    for (int round = 0; round < 3; ++round) {
        CHECK(host.ask().size() == 1);
        CHECK(host.answer<cigi::HatHotResponse>().request == 300);
        CHECK(host.ask().empty());
        CHECK(host.ask().empty());
    }
    request.period = 0;
    CHECK(host.ask().size() == 1);
    CHECK(host.ask(request).size() == 1);
    for (int i = 0; i < 6; ++i) CHECK(host.ask().empty());
}

TEST_CASE("What cannot be asked is answered as invalid, and too much at once is dropped and counted") {
    Asking host;
    host.ask(cigi::HatHotRequest{.request = 1, .entity_coordinates = true, .point = {0.0, 0.0, 0.0}});
    CHECK_FALSE(host.answer<cigi::HatHotResponse>().valid);  // no ownship yet
    host.ask(cigi::HatHotRequest{.request = 1, .point = {91.0, 0.0, 0.0}});
    CHECK_FALSE(host.answer<cigi::HatHotResponse>().valid);
    host.ask(cigi::LosVectorRequest{.request = 1, .most = NAN});
    CHECK_FALSE(host.answer<cigi::LosResponse>().valid);
    host.ask(cigi::LosSegmentRequest{.request = 1});  // no length
    CHECK_FALSE(host.answer<cigi::LosResponse>().valid);
    const auto at = host.geodetic(0.0, 0.0, 80.0);
    for (const auto& [azimuth, elevation] : {std::pair{0.0F, -90.1F}, {0.0F, -450.0F}, {-361.0F, -90.0F}}) {
        cigi::LosVectorRequest request{.request = 1, .source = at};
        request.azimuth = azimuth, request.elevation = elevation, request.most = 500.0F;
        host.ask(request);
        CHECK_FALSE(host.answer<cigi::LosResponse>().valid);
    }
    host.ask(cigi::HatHotRequest{.request = 1, .kind = cigi::HeightKind{3}, .point = at});
    CHECK_FALSE(host.answer<cigi::HatHotResponse>().valid);
    CHECK(host.session.statistics().rejected_for(Reject::out_of_range) == 8);
    Bytes many = message(ByteOrder::little, ig_control(100));
    for (std::uint16_t i = 0; i < 100; ++i)
        many = std::move(many) + message(ByteOrder::little, cigi::HatHotRequest{.request = i, .period = 1});
    CHECK(host.session.accept(many, 5s) == Verdict::no_pose);
    CHECK(host.session.responses().size() == Session::kMostResponses);
    CHECK(host.session.statistics().answers_dropped > 0);
}

TEST_CASE("Damaged questions are refused, or answered with finite numbers") {
    const std::uint64_t seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    Asking host;
    const auto at = host.geodetic(0.0, 0.0, 80.0);
    for (int i = 0; i < 20000; ++i) {
        Bytes bytes = message(ByteOrder::big, ig_control(static_cast<std::uint32_t>(i)), ownship(at[0], at[1], at[2]),
                              cigi::HatHotRequest{.request = 1, .kind = cigi::HeightKind::extended, .point = at},
                              cigi::LosSegmentRequest{.request = 2, .extended = true, .source = at, .destination = at},
                              cigi::LosVectorRequest{.request = 3, .extended = true, .most = 1e4F, .source = at});
        for (std::size_t k = random() % 6; k > 0; --k)
            bytes[24 + random() % (bytes.size() - 24)] = static_cast<std::byte>(random());
        host.session.accept(bytes, i * 16ms);
        for (const Session::Response& response : host.session.responses()) {
            if (response.bytes[0] == std::byte{cigi::HatHotExtendedResponse::kId}) {
                const auto answer = cigi::decode<cigi::HatHotExtendedResponse>(response.bytes, ByteOrder::big);
                REQUIRE(std::isfinite(answer.of_terrain + answer.above_terrain));
                REQUIRE(std::isfinite(answer.normal_azimuth + answer.normal_elevation));
            }
            if (response.bytes[0] == std::byte{cigi::LosExtendedResponse::kId}) {
                const auto answer = cigi::decode<cigi::LosExtendedResponse>(response.bytes, ByteOrder::big);
                REQUIRE(std::isfinite(answer.range + answer.point[0] + answer.point[1] + answer.point[2]));
            }
        }
    }
    CHECK(host.session.statistics().frames > 1000);
}
