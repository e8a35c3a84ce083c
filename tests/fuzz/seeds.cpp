#include "tests/fuzz/seeds.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "host_link/canaerospace.h"
#include "host_link/capture.h"
#include "host_link/cigi_query.h"
#include "host_link/flightgear_fdm.h"
#include "host_link/modbus_pose.h"
#include "host_link/recorded_frames.h"
#include "host_link/recording.h"
#include "tests/config/example_scene.h"
#include "tests/host_link/support.h"

namespace quadrig::fuzz {
namespace {

using namespace quadrig::host;
using host::test::operator+;

const std::filesystem::path kConfig = std::filesystem::path(QUADRIG_SOURCE_DIR) / "config";

Bytes bytes_of(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}
Bytes file_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (text.empty()) throw std::runtime_error(path.string() + ": cannot be read");
    return bytes_of(text);
}

Bytes conversation(const std::vector<Bytes>& messages) {
    Bytes all;
    for (const Bytes& message : messages) append_message(all, message);
    return all;
}
/// The first messages of a recording that travels along.
std::vector<Bytes> recorded(const char* name, std::size_t count) {
    const Capture capture = host::read_capture(kConfig / "traces" / name);
    std::vector<Bytes> messages;
    for (std::size_t i = 0; i < std::min(count, capture.datagrams.size()); ++i) {
        const auto payload = capture.payload(capture.datagrams[i]);
        messages.emplace_back(payload.begin(), payload.end());
    }
    return messages;
}

/// Frames with a packet of every kind that is understood.
std::vector<Bytes> cigi_messages(host::cigi::Format format) {
    using namespace host::cigi;
    using host::test::ig_control, host::test::message, host::test::ownship;
    EntityControl other = ownship(47.27);
    other.entity = 3;
    other.type = 12;
    HatHotRequest height;
    height.point = {47.26, 11.34, 900.0};
    height.kind = HeightKind::extended;
    height.period = 2;
    LosSegmentRequest segment;
    segment.source = {47.26, 11.34, 900.0};
    segment.destination = {47.27, 11.34, 100.0};
    segment.extended = true;
    LosVectorRequest vector;
    vector.source = {47.26, 11.34, 900.0};
    vector.elevation = -30.0F;
    vector.most = 5000.0F;
    ViewDefinition window;
    window.left = window.bottom = -20.0F;
    window.right = window.top = 20.0F;
    RateControl rates;
    rates.entity = 3, rates.x = 50.0F, rates.yaw = 3.0F, rates.local = true;
    EntityControl hanging = ownship();
    hanging.entity = 4, hanging.attached = true, hanging.parent = 3, hanging.collision_detection = true;
    hanging.latitude = 5.0, hanging.longitude = 1.0, hanging.altitude = -2.0;
    WeatherControl layer;
    layer.layer = 1, layer.enable = true, layer.base = 1500.0F, layer.thickness = 200.0F, layer.coverage = 60.0F;
    layer.visibility = 300.0F;
    WeatherControl inside = layer;
    inside.scope = WeatherScope::regional, inside.region = 2, inside.layer = 4;
    EnvironmentalRegionControl region;
    region.region = 2, region.state = RegionState::active, region.latitude = 47.26, region.longitude = 11.34;
    region.size_x = region.size_y = 5000.0F, region.corner_radius = 500.0F, region.transition_perimeter = 800.0F;
    ShortComponentControl pattern;
    pattern.component_class = ShortComponentControl::kSystem, pattern.component = 1, pattern.state = 1;
    SensorControl sensor;
    sensor.on = true, sensor.track_mode = 1;
    CollisionSegmentDefinition feeler;
    feeler.entity = 4, feeler.enable = true, feeler.to = {100.0F, 0.0F, 900.0F};
    // 4.0 has an entity's position in a packet of its own; a 3.x message has nothing of that id.
    const auto with_positions = [&](Bytes bytes, std::initializer_list<EntityControl> entities) {
        if (format.version == Version::four)
            for (const EntityPosition position : entities) host::test::append(bytes, position, format);
        return bytes;
    };
    return {with_positions(message(format, ig_control(1, 1667), ownship(), ViewControl{}, window), {ownship()}),
            with_positions(message(format, ig_control(2, 3333), ownship(47.2601), other, CelestialSphereControl{},
                                   AtmosphereControl{}),
                           {ownship(47.2601), other}),
            message(format, ig_control(3, 5000), ownship(47.2602), height, segment, vector),
            with_positions(
                message(format, ig_control(4, 6667), hanging, rates, layer, region, inside, pattern, sensor, feeler),
                {hanging}),
            message(format, ig_control(5, 8333), height) +
                (format.version == Version::four ? Bytes{} : host::test::raw_packet(200, 16))};
}

Bytes fdm(std::uint32_t version, double latitude) {
    flightgear::NetFdm packet{.version = version, .longitude = 0.2, .latitude = latitude};
    Bytes bytes(flightgear::kSize25);
    bytes.resize(flightgear::encode(packet, bytes));
    return bytes;
}

std::vector<Bytes> can_records() {
    using namespace host::canaerospace;
    std::vector<Bytes> records;
    const auto add = [&](const host::canaerospace::Message& message) {
        const auto record = can_record(encode(message));
        records.emplace_back(record.begin(), record.end());
    };
    for (std::uint8_t code = 0; code < 2; ++code) {
        add(with_float(id_of(Role::pitch), code, 2.0F));
        add(with_float(id_of(Role::roll), code, -10.0F));
        add(with_float(id_of(Role::true_heading), code, 90.0F));
        for (const auto& half : with_double(id_of(Role::latitude), static_cast<std::uint8_t>(2 * code), 47.26))
            add(half);
        add(with_float(id_of(Role::longitude), code, 11.34F));
        add(with_float(id_of(Role::velocity_up), code, 1.0F));
        add({.id = id_of(Role::utc), .type = DataType::char4, .code = code, .size = 4});
        add({.id = id_of(Role::date), .type = DataType::char4, .code = code, .size = 4});
        add(with_float(id_of(Role::height), code, 900.0F));
    }
    add({.id = id_of(Role::service_request), .node = 32, .type = DataType::no_data});
    return records;
}

Bytes modbus_write(std::uint16_t address, Input values) {
    Bytes frame(modbus::kLargestFrame);
    frame.resize(modbus::write_request(1, address, values, frame));
    return frame;
}
Bytes modbus_pose(std::uint16_t sequence) {
    return modbus_write(
        0, modbus::float_block({sequence, sequence * 16U, {{{47.26}, {11.34}, 1200.0}, {{90.0}, {2.0}, {-10.0}}}}, {}));
}

/// A recording as the recorder writes it.
Bytes recording_of(Protocol protocol, RecordingFormat format, const std::vector<Bytes>& messages) {
    RecordingText text(protocol, format, "vcan0");
    std::string all = text.begin();
    Heard heard{};
    heard.from.ss_family = AF_INET;
    heard.to_port = 8004;
    for (const Bytes& message : messages) {
        heard.bytes = message;
        all += text.piece(heard, Time(1'700'000'000'000'000'000) + heard.arrival);
        heard.arrival += std::chrono::milliseconds(16);
    }
    return bytes_of(all);
}

void add_links(std::vector<Seed>& all) {
    const auto little = cigi_messages(ByteOrder::little), big = cigi_messages(ByteOrder::big);
    all.push_back({"cigi", "little_endian", conversation(little)});
    all.push_back({"cigi", "big_endian", conversation(big)});
    all.push_back({"cigi", "version_4", conversation(cigi_messages({ByteOrder::big, host::cigi::Version::four}))});
    all.push_back({"cigi", "recorded", conversation(recorded("cigi33-737-turn.pcapng", 3))});
    const std::vector<Bytes> flight{fdm(24, 0.8), fdm(24, 0.8001), fdm(25, 0.8002)};
    all.push_back({"fdm", "both_versions", conversation(flight)});
    all.push_back({"fdm", "recorded", conversation(recorded("netfdm-c172-takeoff.pcap", 3))});
    all.push_back({"fdm_stream", "whole", conversation(flight)});
    Bytes pieces;
    for (const Bytes& packet : flight) {
        append_message(pieces, Input(packet).first(100));
        append_message(pieces, Input(packet).subspan(100));
    }
    append_message(pieces, bytes_of("garbage"));
    for (const Bytes& packet : flight) append_message(pieces, packet);
    all.push_back({"fdm_stream", "in_pieces", pieces});
    all.push_back({"canaerospace", "every_role", conversation(can_records())});
    all.push_back({"canaerospace", "recorded", conversation(recorded("canaerospace-c172-takeoff.log", 30))});

    const Bytes one = modbus_pose(1), two = modbus_pose(2);
    Bytes clients;
    append_message(clients, one, 0, 1);
    append_message(clients, Input(two).first(20), 0, 2);
    append_message(clients,
                   host::test::from_hex("000100000006010300000018"
                                        "000200000006010400000020"
                                        "0003000000060106000a0001"),
                   0, 3);
    append_message(clients, Input(two).subspan(20), 0, 2);
    append_message(clients, host::test::from_hex("00040000000d011700000004000a0001020007"), 0, 1);
    append_message(clients, host::test::from_hex("000500000002012b"), 0, 4);
    all.push_back({"modbus", "four_clients", clients});
    const Bytes digits(std::size_t{2} * modbus::kScaledRegisters, std::byte{1});
    all.push_back({"modbus", "scaled_block", conversation({modbus_write(modbus::kScaledBlock, digits), one})});

    const std::vector<std::vector<Bytes>> hosts{big, flight, can_records(), {one, two}};
    for (std::size_t i = 0; i < hosts.size(); ++i)
        all.push_back(
            {"monitor", "protocol_" + std::to_string(i), Bytes{static_cast<std::byte>(i)} + conversation(hosts[i])});
}

void add_recordings(std::vector<Seed>& all) {
    const Bytes log = recording_of(Protocol::canaerospace, RecordingFormat::candump, can_records());
    const auto line_end = std::ranges::find(log, std::byte{'\n'});
    all.push_back({"candump", "line", Bytes(log.begin(), line_end)});
    all.push_back({"candump", "extended", bytes_of("(1700000000.000123) can0 0001040E#0102030405060708")});
    all.push_back({"candump", "remote", bytes_of("(0.0) vcan0 137#R4")});
    all.push_back({"candump", "flexible_data_rate", bytes_of("(0.0) vcan0 137##1112233")});
    all.push_back({"capture", "candump", log});
    all.push_back(
        {"capture", "cigi", recording_of(Protocol::cigi, RecordingFormat::pcapng, cigi_messages(ByteOrder::big))});
    all.push_back({"capture", "fdm", recording_of(Protocol::flightgear_fdm, RecordingFormat::pcapng, {fdm(24, 0.8)})});
    all.push_back({"capture", "modbus",
                   recording_of(Protocol::modbus, RecordingFormat::pcapng, {modbus_pose(1), modbus_pose(2)})});
    all.push_back({"capture", "can", recording_of(Protocol::canaerospace, RecordingFormat::pcapng, can_records())});
    const Bytes datagram = cigi_messages(ByteOrder::little)[0];
    constexpr std::uint32_t kEthernet = 1, kLinuxCooked = 113;
    host::test::PcapWriter ethernet(kEthernet), cooked(kLinuxCooked);
    ethernet.packet(host::test::ethernet(host::test::ipv4_udp(datagram), 0x0800), Time(0));
    ethernet.packet(host::test::ethernet(host::test::ipv6_udp(datagram), 0x86DD), Time(1000));
    cooked.packet(Bytes(14) + host::test::from_hex("0800") + host::test::ipv4_udp(datagram), Time(0));
    all.push_back({"capture", "ethernet", ethernet.bytes()});
    all.push_back({"capture", "linux_cooked", cooked.bytes()});
    std::string frames = first_line({60, 1});
    for (std::uint64_t k = 0; k < 5; ++k)
        frames += line_of({k, Time(16'666'667 * static_cast<std::int64_t>(k)), 2 * k, 1});
    all.push_back({"recorded_frames", "five", bytes_of(frames)});
}

void add_texts(std::vector<Seed>& all) {
    const char* const links[]{"cigi://127.0.0.1:8004?ownship=3&view=1&host=first&reply=127.0.0.1:8005&reply_rate=60",
                              "fdm://[::1]:5500?transport=tcp&allow=127.0.0.1,10.0.0.0/8,fe80::/10",
                              "can://vcan0?position=ins&commit=1038&timeout=100&channel=1&node=7",
                              "modbus://localhost:1502?base=100&word_order=cdab&altitude_offset=-12.5",
                              "cigi:?version=3.3",
                              "cigi://:8004?operation=synchronous&database=7&silence=2500"};
    for (std::size_t i = 0; i < std::size(links); ++i)
        all.push_back({"link_url", "link_" + std::to_string(i), bytes_of(links[i])});
    all.push_back({"scene", "every_key", bytes_of(tests::kExampleScene)});
    for (const char* name : {"06_texture_on_the_ground", "07_cloud_layer", "10_hills_and_trees", "12_x29_above_clouds",
                             "15_approach_in_mist"})
        all.push_back({"scene", name, file_of(kConfig / "scenes" / "gallery" / (std::string(name) + ".toml"))});
    all.push_back({"appliance", "every_key", bytes_of(R"(scene = "a.toml"
links = ["fdm://127.0.0.1:5500", "can://vcan0?channel=1"]
sinks = ["png:frames", "none:"]
size = [1280, 720]
fov = 60.5
rate = 59.94
threads = 2
quality = "auto"
[[entity]]
type = 12
model = "x-29"
)")});
    all.push_back({"camera_path", "takeoff", file_of(kConfig / "scenes" / "takeoff_cameras.json")});
    all.push_back({"quality_ladder", "shipped", file_of(kConfig / "quality.toml")});
}

}  // namespace

std::vector<Seed> seeds() {
    std::vector<Seed> all;
    add_links(all);
    add_recordings(all);
    add_texts(all);
    return all;
}

}  // namespace quadrig::fuzz
