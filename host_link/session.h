/// One link's conversation: datagrams go in with their arrival times, the newest HostState comes out. Pure: no sockets,
/// no clock.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "host_link/canaerospace_pose.h"
#include "host_link/cigi.h"
#include "host_link/cigi_query.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/frame_order.h"
#include "host_link/geodesy.h"
#include "host_link/host_state.h"
#include "host_link/inplace_vector.h"
#include "host_link/link_statistics.h"
#include "host_link/link_url.h"
#include "host_link/modbus_pose.h"
#include "host_link/source_clock.h"
#include "host_link/survey.h"

namespace quadrig::host {

inline constexpr std::uint8_t kDefaultCanNode = 32;

struct SessionOptions {
    Protocol protocol = Protocol::cigi;
    GeodeticPosition scene_origin;
    double altitude_offset = 0.0;               ///< m, added to the host's altitudes
    std::uint16_t ownship = 0;                  ///< entity id
    std::optional<std::uint16_t> view;          ///< view id; absent: the first one that the host names
    std::optional<cigi::Version> cigi_version;  ///< others are refused; absent: as each message says
    std::optional<std::int8_t> database;        ///< CIGI: the scene's number; absent: whichever the host asks for
    bool synchronous = false;                   ///< CIGI: messages are for the next frame, and not smoothed
    std::optional<ViewWindow> default_window;   ///< fills up what a View Definition leaves out
    canaerospace::PoseSettings canaerospace;    ///< which messages make a pose
    modbus::PoseSettings modbus;                ///< where the registers are
    std::uint8_t can_node = kDefaultCanNode;    ///< under which CANaerospace's services find us
    /// CIGI: types of entities that have a model; of others the host is warned.
    std::vector<int> entity_types;
    std::size_t cloud_decks = 0;  ///< that the scene has
    Time silence = kSilence;      ///< after which the host is taken for gone
    Surveyor surveyor;            ///< answers for the scene; without one such requests are only counted
    Time gap_threshold = std::chrono::milliseconds(50);
};

/// Options of a link's URL over a scene's origin.
SessionOptions session_options(const LinkUrl& url, const GeodeticPosition& scene_origin);

enum class Verdict : std::uint8_t {
    pose,       ///< a new pose of the ownship was taken
    no_pose,    ///< taken, but without a pose to take
    duplicate,  ///< not taken
    reordered,  ///< not taken: newer ones came first
    rejected    ///< not taken, for the reason counted
};

/// What a Start Of Frame needs to know of the host. A plain value.
struct ReplyContext {
    cigi::Format format;
    std::uint8_t minor_version = 3;
    bool separate_counters = true;  ///< 3.2 and later
    std::int8_t database = 0;
    Mode mode = Mode::standby;
    std::uint32_t host_frame = 0;
};

/// Start Of Frame in the host's own byte order and version; returns its size. `time` is the image generator's.
/// `overframing`: the last frame was not whole in time; 4.0 tells it.
std::size_t start_of_frame(const ReplyContext& host, std::uint32_t ig_frame, Time time, bool overframing,
                           std::span<std::byte, cigi::StartOfFrame::kSize> out);

/// Whether a pose is finite and in the ranges that host_link/README.md states.
bool in_range(const GeodeticPosition& position, const Attitude& attitude);

class Session {
  public:
    /// Answers to one message, and requests that are repeated.
    static constexpr std::size_t kMostResponses = 64;
    /// Connections whose unfinished writes are kept; of more, those that wrote last.
    static constexpr std::size_t kMostModbusHosts = 8;

    /// Collision segments, and sensors that track, that are told of every host frame.
    static constexpr std::size_t kMostSegments = 64, kMostSensors = 16;
    /// Metres from a parent to what still hangs on it, and to a segment's ends.
    static constexpr double kFarthestOffset = 1e6;

    explicit Session(const SessionOptions& options);

    /// Folds a datagram (of CAN: a frame, as its LINKTYPE_CAN_SOCKETCAN record) in. A datagram is taken whole or not at
    /// all, but for single packets whose values are out of range. Allocates nothing.
    /// `source` tells a Modbus host's connection from others.
    Verdict accept(std::span<const std::byte> datagram, Time arrival, std::uint32_t source = 0);
    /// Modbus: no more comes over this connection. The next host need not wait until it is taken for gone.
    void connection_closes(std::uint32_t source);
    /// Counts what a link refused before it was a datagram.
    void refuse(Reject reason) { reject(reason); }
    /// The next datagram is of another host than the last: nothing of the two is comparable.
    void host_changes();
    /// Counts an answer that a link had no place for.
    void drop_answer() { ++statistics_.answers_dropped; }

    /// What the protocol wants sent back at once for the datagram just given to accept: empty for most. A CAN frame is
    /// its LINKTYPE_CAN_SOCKETCAN record.
    [[nodiscard]] std::span<const std::byte> answer() const { return {answer_.data(), answer_size_}; }

    /// CIGI packets that answer the requests of the datagram just given to accept, and those that were to be repeated:
    /// to be sent behind the next Start Of Frame.
    struct Response {
        std::array<std::byte, cigi::kLargestResponse> bytes{};
        std::size_t size = 0;
        bool asked = true;  ///< false: a message for people, that nobody has asked for
    };
    [[nodiscard]] std::span<const Response> responses() const { return {responses_.begin(), responses_.size()}; }

    [[nodiscard]] const HostState& state() const { return state_; }
    [[nodiscard]] const LinkStatistics& statistics() const { return statistics_; }
    /// Present once a CIGI host has spoken.
    [[nodiscard]] const std::optional<ReplyContext>& reply_context() const { return reply_; }
    /// Of the newest Modbus pose; 0 before the first.
    [[nodiscard]] std::uint16_t modbus_sequence() const;

  private:
    struct Window {
        std::optional<Degrees> left, right, top, bottom;
    };

    Verdict reject(Reject reason);
    Verdict take(Time arrival, const std::optional<GeodeticPose>& pose, std::optional<Time> source_time);
    void restart();
    void commit_pose(const GeodeticPose& pose, Time arrival, std::optional<Time> source_time);
    void run_ephemeris(Time arrival);

    Verdict accept_fdm(std::span<const std::byte> datagram, Time arrival);
    Verdict accept_can(std::span<const std::byte> record, Time arrival);
    void apply(const canaerospace::Message& message);
    Verdict accept_modbus(std::span<const std::byte> frame, Time arrival, std::uint32_t source);
    modbus::PoseRegisters& registers_of(std::uint32_t source);
    Verdict accept_cigi(std::span<const std::byte> datagram, Time arrival);
    Arrival order(const cigi::Message& message, std::span<const std::byte> datagram, Time arrival);
    /// What an answer needs to know of the message that asks.
    struct Asking {
        cigi::Format format;
        std::uint8_t frame = 0;  ///< the lowest four bits of the host's number
        Time arrival{};
    };
    void apply(const cigi::IgControl& packet);
    void load_database(std::int8_t wanted);
    void reset_scene();
    void apply(const cigi::Packet& packet, const cigi::Message& message, Time arrival);
    Entity* entity_for(std::uint16_t id);
    void apply(const cigi::EntityControl& packet, const cigi::Message& message, const Asking& asking);
    void apply(const cigi::EntityPosition& packet, const Asking& asking);
    void attach(const cigi::EntityPosition& packet, const Asking& asking);
    void place_ownship(const PoseSample& sample);
    void apply(const cigi::RateControl& packet, Time arrival);
    void apply(const cigi::ViewControl& packet, const Asking& asking);
    void apply(const cigi::ViewDefinition& packet);
    void apply(const cigi::CelestialSphereControl& packet, Time arrival);
    void apply(const cigi::AtmosphereControl& packet);
    struct LineRequest {
        std::uint16_t id = 0;
        bool segment = false, extended = false, response_entity = false;
        std::uint16_t entity = 0;
    };
    /// What makes a question the same one again.
    struct Asked {
        std::uint16_t request = 0;
        std::uint8_t period = 0;
    };
    /// Message ids of the texts that a host gets.
    enum class Warning : std::uint16_t {
        far_from_scene = 1,
        unknown_type,
        unknown_view_entity,
        bad_attachment,
        no_such_deck,
        too_many_regions,
        count
    };
    [[gnu::format(printf, 4, 5)]] void warn(Warning warning, const Asking& asking, const char* form, ...);
    void look_around(const Asking& asking);
    void apply(const cigi::CollisionSegmentDefinition& packet);
    void tell_collisions(const Asking& asking);
    void apply(const cigi::SensorControl& packet, const Asking& asking);
    void tell_sensor(const cigi::SensorControl& sensor, const Asking& asking);
    void tell_sensors(const Asking& asking);
    WeatherRegion* region_for(std::uint16_t id, const Asking& asking);
    void apply(const cigi::EnvironmentalRegionControl& packet, const Asking& asking);
    void apply(const cigi::WeatherControl& packet, const Asking& asking);
    void apply(const cigi::ShortComponentControl& packet);
    std::optional<ScenePose> body_of(std::uint16_t id, Time at) const;
    std::optional<ScenePoint> point_of(const std::array<double, 3>& at, bool entity, std::uint16_t id, Time arrival);
    std::optional<SurveyHit> plumb(const GeodeticPosition& below);
    void answer(const cigi::HatHotRequest& request, const Asking& asking);
    void answer(const cigi::LosSegmentRequest& request, const Asking& asking);
    void answer(const cigi::LosVectorRequest& request, const Asking& asking);
    void answer_line(const LineRequest& request, const std::optional<SurveyLine>& line, const Asking& asking);
    std::optional<Asked> answer_packet(const cigi::Packet& packet, const Asking& asking);
    void answer_request(const cigi::Packet& packet, const cigi::Message& message, Time arrival);
    void answer_standing(const cigi::Message& message, Time arrival);
    static Asking asking_of(const cigi::Message& message, Time arrival);
    template <class P>
    void respond(const P& response, cigi::Format format, bool asked = true);
    bool is_our_view(std::uint16_t view);
    [[nodiscard]] Window default_window() const;

    SessionOptions options_;
    SceneFrame scene_frame_;
    HostState state_;
    LinkStatistics statistics_;
    std::optional<ReplyContext> reply_;
    /// As Start Of Frame tells it: n loaded, -n loading, kNoDatabase; 0 before the host asks.
    std::int8_t told_database_ = 0, loaded_database_ = 0;
    FrameOrder frame_order_;
    TickClock cigi_clock_{kCigiTick};
    FdmClock fdm_clock_;
    canaerospace::PoseAssembler can_pose_;
    std::optional<std::chrono::year_month_day> can_date_;
    struct ModbusHost {
        std::optional<std::uint32_t> source;
        std::uint64_t used = 0;  ///< when, counted in datagrams
        modbus::PoseRegisters registers;
    };
    struct ModbusDriving {
        std::uint32_t source = 0;
        std::uint16_t sequence = 0;
        Time commit{};
        bool closed = false;
    };
    std::array<ModbusHost, kMostModbusHosts> modbus_hosts_{};
    std::optional<ModbusDriving> modbus_driving_;
    TickClock modbus_clock_{kModbusTick};
    std::array<std::byte, kCanRecordSize> answer_{};
    std::size_t answer_size_ = 0;
    InplaceVector<Response, kMostResponses> responses_;
    /// A request that is answered again every so many host frames.
    struct Standing {
        std::array<std::byte, cigi::LosSegmentRequest::kSize4> packet{};
        std::size_t size = 0;
        cigi::Kind kind = 0;
        cigi::Format format;
        Asked asked;
        std::uint32_t since = 0;  ///< host frame
    };
    InplaceVector<Standing, kMostResponses> standing_;
    std::optional<std::uint16_t> view_;
    std::uint8_t view_group_ = 0;  ///< that our view is in; 0: none
    std::array<std::optional<Time>, static_cast<std::size_t>(Warning::count)> warned_{};
    InplaceVector<cigi::CollisionSegmentDefinition, kMostSegments> segments_;
    InplaceVector<cigi::SensorControl, kMostSensors> sensors_;
    Window window_;
    std::optional<GeodeticPose> ownship_pose_;  ///< of the message that is being taken
    struct Ephemeris {
        cigi::CelestialSphereControl packet;
        Time since{};
    };
    std::optional<Ephemeris> ephemeris_;
    bool comparable_ = false;  ///< the next pose follows the one before it on the same clock
};

template <class P>
void Session::respond(const P& response, cigi::Format format, bool asked) {
    if (responses_.full()) {
        ++statistics_.answers_dropped;
        return;
    }
    Response& place = responses_.push_back({});
    place.size = cigi::encode(response, format, place.bytes);
    place.asked = asked;
}

}  // namespace quadrig::host
