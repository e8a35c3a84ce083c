// Links: whatever hosts say, the state stays one that can be drawn, and every message is counted.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host_link/can_frame.h"
#include "host_link/entity_motion.h"
#include "host_link/fdm_stream.h"
#include "host_link/modbus.h"
#include "host_link/monitor.h"
#include "host_link/session.h"
#include "tests/fuzz/messages.h"

namespace quadrig::fuzz {
namespace {

using namespace quadrig::host;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(const ScenePose& pose) {
    return finite(pose.position.metres) && finite(pose.eye_from_scene[0]) && finite(pose.eye_from_scene[1]) &&
           finite(pose.eye_from_scene[2]);
}

void check(const HostState& state) {
    for (const auto& sample : {state.pose, state.earlier})
        if (sample) {
            law(in_range(sample->position, sample->attitude), "a pose is in range");
            law(finite(sample->pose), "a pose in the scene is finite");
        }
    if (state.pose && state.earlier)
        law(state.earlier->sequence < state.pose->sequence, "the earlier pose is the earlier one");
    if (state.velocity) law(finite(*state.velocity), "a velocity is finite");
    if (state.mount) law(finite(state.mount->offset), "the eye's place on the ownship is finite");
    if (const auto& w = state.window) {
        law(w->left.value < w->right.value && w->bottom.value < w->top.value, "a window has a left and a right side");
        for (const Degrees side : {w->left, w->right, w->bottom, w->top})
            law(std::abs(side.value) <= 89.0, "a window is within 89 degrees");
    }
    if (state.visibility) law(*state.visibility >= 1.0, "visibility is at least 1 m");
    if (state.utc)
        law(state.utc->month >= 1 && state.utc->month <= 12 && state.utc->day >= 1 && state.utc->day <= 31 &&
                state.utc->hour >= 0 && state.utc->hour < 24 && state.utc->minute >= 0 && state.utc->minute < 60 &&
                state.utc->second >= 0.0 && state.utc->second < 61.0,
            "date and time are of a calendar and a clock");
    const auto check_layers = [](const WeatherLayers& layers) {
        for (const auto& layer : layers)
            if (layer)
                law(finite({layer->base, layer->top, layer->visibility}) && layer->visibility >= 1.0 &&
                        layer->coverage >= 0.0 && layer->coverage <= 1.0,
                    "a layer of weather is somewhere");
    };
    check_layers(state.weather);
    law(state.regions.size() <= WeatherRegions::kMost, "at most so many regions are kept");
    for (const WeatherRegion& region : state.regions) {
        check_layers(region.layers);
        const double share = region.share_at({});
        law(share >= 0.0 && share <= 1.0, "a share of a region is a share");
    }
    law(state.entities.size() <= EntityList::kMost + 1, "at most so many entities are known");
    for (const Entity& entity : state.entities) {
        if (entity.placed) law(finite(entity.pose), "entities are somewhere");
        if (const auto pose = pose_of(state.entities, entity.id, entity.since + 1h, std::nullopt))
            law(finite(*pose), "entities stay somewhere");
    }
}

/// A session, what it has to count, and its clock.
class Conversation {
  public:
    explicit Conversation(Protocol protocol) : session_(options_for(protocol)) {}

    void hear(Input bytes, std::uint32_t source) {
        const Verdict verdict = session_.accept(bytes, now_, source);
        ++heard_;
        law(session_.statistics().datagrams == heard_, "every message is counted");
        if (verdict == Verdict::pose) law(session_.state().pose.has_value(), "a pose that is taken is there");
        check(session_.state());
        law(session_.answer().size() <= bytes.size() + kCanRecordSize, "an answer at once is a frame at most");
        std::size_t all = 0;
        for (const Session::Response& response : session_.responses()) all += response.size;
        law(all <= Session::kMostResponses * cigi::kLargestResponse, "answers are bounded");
        if (const auto& reply = session_.reply_context()) {
            std::array<std::byte, cigi::StartOfFrame::kSize> out{};
            law(start_of_frame(*reply, 7, now_, true, out) <= out.size(), "Start Of Frame has its size");
        }
    }
    void wait(Time pause) { now_ += pause; }

  private:
    static SessionOptions options_for(Protocol protocol) {
        SessionOptions options;
        options.protocol = protocol;
        options.scene_origin = {{47.26}, {11.34}, 581.0};
        // A plane at the scene's Z = 0 for all there is to see.
        options.surveyor = [](const SurveyLine& line) -> std::optional<SurveyHit> {
            law(finite(line.from.metres) && finite(line.direction), "questions are finite");
            law(line.least <= line.most, "a line has a length");
            const double distance = -line.from.metres.z / line.direction.z;
            if (!(distance >= line.least && distance <= line.most)) return std::nullopt;
            return SurveyHit{distance, {line.from.metres + distance * line.direction}, {0.0, 0.0, 1.0}, 1};
        };
        return options;
    }

    Session session_;
    Time now_{1h};
    std::uint64_t heard_ = 0;
};

void hear_all(Protocol protocol, Input input) {
    Conversation conversation(protocol);
    while (const auto message = next_message(input)) {
        conversation.wait(message->after);
        conversation.hear(message->bytes, message->source);
    }
}

}  // namespace

void read_cigi(Input input) { hear_all(Protocol::cigi, input); }
void read_fdm(Input input) { hear_all(Protocol::flightgear_fdm, input); }
void read_canaerospace(Input input) { hear_all(Protocol::canaerospace, input); }

void read_fdm_stream(Input input) {
    Conversation conversation(Protocol::flightgear_fdm);
    flightgear::PacketStream in_pieces, in_one_go;
    std::vector<Bytes> packets;
    Bytes whole;
    while (const auto message = next_message(input)) {
        conversation.wait(message->after);
        whole.insert(whole.end(), message->bytes.begin(), message->bytes.end());
        Input piece = message->bytes;
        while (const auto packet = in_pieces.next(piece)) {
            packets.emplace_back(packet->begin(), packet->end());
            conversation.hear(*packet, 0);
        }
        law(piece.empty(), "a stream is used up");
    }
    Input rest = whole;
    auto expected = packets.begin();
    while (const auto packet = in_one_go.next(rest))
        law(expected != packets.end() && std::ranges::equal(*packet, *expected++),
            "packets do not depend on the pieces that they come in");
    law(expected == packets.end() && in_one_go.breaks() == in_pieces.breaks(),
        "packets do not depend on the pieces that they come in");
}

void read_modbus(Input input) {
    Conversation conversation(Protocol::modbus);
    std::map<std::uint32_t, modbus::FrameBuffer> connections;
    while (const auto message = next_message(input)) {
        conversation.wait(message->after);
        modbus::FrameBuffer& frames = connections[message->source];
        Input piece = message->bytes;
        while (const auto frame = frames.next(piece)) {
            law(frame->size() > modbus::kHeaderSize && frame->size() <= modbus::kLargestFrame, "a frame has its size");
            const auto read = modbus::read_request(*frame);
            if (const auto* request = std::get_if<modbus::Request>(&read)) {
                law(request->read || request->write, "a request reads or writes");
                for (const auto& registers : {request->read, request->write})
                    if (registers) law(registers->address + registers->count <= 65536, "registers end where they end");
                if (request->write)
                    law(request->values.size() == 2U * request->write->count, "a value for each register");
                modbus::may_read(*request, {});
            }
            conversation.hear(*frame, message->source);
        }
        law(piece.empty() || frames.broken(), "a stream is used up");
    }
}

void read_monitor(Input input) {
    if (input.empty()) return;
    constexpr const char* kLinks[]{"cigi:", "fdm:", "can:", "modbus:"};
    Monitor monitor(parse_link_url(kLinks[std::to_integer<unsigned>(input[0]) % 4U]));
    input = input.subspan(1);
    Time now{1h};
    std::uint64_t heard = 0;
    while (const auto message = next_message(input)) {
        now += message->after;
        monitor.hear({now, message->bytes, message->source, {}, 0});
        ++heard;
    }
    law(monitor.statistics().datagrams == heard, "every message is counted");
    law(heard == 0 || !monitor.view(now).empty(), "something is told");
    law(monitor.take_oddities().size() <= Monitor::kMostLines + 1, "lines are bounded");
}

}  // namespace quadrig::fuzz
