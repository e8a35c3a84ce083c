#include "host_link/monitor.h"

#include <algorithm>
#include <chrono>
#include <cstdarg>
#include <cstdio>

#include "host_link/wire.h"

namespace quadrig::host {

namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* form, ...) {
    std::array<char, 256> text{};
    va_list values;
    va_start(values, form);
    const int size = std::vsnprintf(text.data(), text.size(), form, values);
    va_end(values);
    return {text.data(), std::min(static_cast<std::size_t>(std::max(size, 0)), text.size() - 1)};
}

double seconds(Time time) { return std::chrono::duration<double>(time).count(); }
double milliseconds(Time time) { return 1e3 * seconds(time); }

/// The first number of a message, as FlightGear's packets have their version there.
std::string first_number(std::span<const std::byte> message, ByteOrder order) {
    return message.size() < 4 ? "?" : std::to_string(load<std::uint32_t>(message, 0, order));
}

ToldPacket told_pose(const PoseSample& pose) {
    return {"pose",
            {{"latitude", pose.position.latitude.value, "deg"},
             {"longitude", pose.position.longitude.value, "deg"},
             {"altitude", pose.position.altitude, "m"},
             {"heading", pose.attitude.heading.value, "deg"},
             {"pitch", pose.attitude.pitch.value, "deg"},
             {"roll", pose.attitude.roll.value, "deg"}}};
}

std::uint64_t more(std::uint64_t after, std::uint64_t before) { return after > before ? after - before : 0; }

}  // namespace

std::string likely_cause(Protocol protocol, Reject reason, std::span<const std::byte> message) {
    const bool fdm = protocol == Protocol::flightgear_fdm;
    switch (reason) {
        case Reject::truncated:
            return "the message ends before its packets do: a buffer too small, or a length field counted wrong";
        case Reject::bad_size:
            return "a size that its packet cannot have: another version's layout, or a packet that was not filled in";
        case Reject::no_ig_control:
            return "does not start with IG Control: another protocol on this port, or a host that splits its message";
        case Reject::start_of_frame:
            return "an image generator's own message: ports crossed, or a reply that came back";
        case Reject::bad_byte_order:
            return "the byte swap field is neither 80 00 nor 00 80: the host swapped the rest of the message but not "
                   "it, "
                   "or left it empty";
        case Reject::unknown_version:
            if (fdm && message.empty()) return "something else where a packet should begin: other data in the stream?";
            if (fdm)
                return "version " + first_number(message, ByteOrder::big) +
                       ": neither 24 nor 25; another of FlightGear's protocols (native-ctrls, native-gui, generic), or "
                       "another program";
            return protocol == Protocol::modbus ? "the block's first register is not layout version 1"
                                                : "neither CIGI 3 nor 4.0, or not the one that ?version= "
                                                  "asks for";
        case Reject::byte_swapped_version:
            return "byte-swapped " + first_number(message, ByteOrder::little) +
                   ": a host of the other byte order; net_fdm is big-endian";
        case Reject::version_size_mismatch:
            return format(
                "version %s in %zu bytes: 24 has 408 and 25 has 552; compiled with another alignment, or "
                "between two versions",
                first_number(message, ByteOrder::big).c_str(), message.size());
        case Reject::out_of_range:
            if (protocol == Protocol::modbus) return "a value out of its range: another word order? See ?word_order=";
            return fdm ? "a value out of its range: degrees for radians?" : "a value out of its range, or not a number";
        case Reject::bad_attachment:
            return "an entity attached to itself, by way of others perhaps, or more than 8 deep";
        case Reject::view_of_unknown_entity:
            return "the view is on an entity that the host has not named before: see ?ownship=";
        case Reject::not_data_frame:
            return "a remote frame, an error report or CAN FD: the bus has trouble, or is not CANaerospace's";
        case Reject::unknown_channel:
            return "a redundancy channel above 255, or a ninth: 29-bit identifiers of another protocol?";
        case Reject::bad_data_type:
            return "a parameter in a type that it cannot have: the pose takes FLOAT, SHORT2, DOUBLEH with DOUBLEL";
        case Reject::lone_half:
            return "half of a float64: DOUBLEH comes first, DOUBLEL next with the next message code";
        case Reject::incomplete_pose:
            return "the completing message came while a part was missing or too old: see ?commit= and ?timeout=";
        case Reject::bad_request:
            return "a function that is not served, or bytes that are no Modbus";
        case Reject::bad_address:
            return "registers that are not there: off by one, or 40001-style addresses? See ?base=";
        case Reject::commit_mismatch:
            return "the commit register was not the sequence number: written too early, or byte-swapped; see "
                   "?word_order=";
        case Reject::other_host:
            return "a second host while the first one holds the link";
        case Reject::too_many_clients:
            return "every place is taken: connections that nobody closes?";
        case Reject::not_allowed:
            return "a peer that ?allow= does not name";
        case Reject::count:
            break;
    }
    return {};
}

Monitor::Monitor(const LinkUrl& url) : url_(url), session_(std::make_unique<Session>(session_options(url, {}))) {}

void Monitor::odd(const std::string& what) {
    ++oddities_;
    if (lines_.size() == kMostLines) {
        ++lines_left_out_;
        return;
    }
    lines_.push_back(format("%.3f s, message %llu: ", seconds(newest_ - first_.value_or(newest_)),
                            static_cast<unsigned long long>(statistics().datagrams)) +
                     what);
}

bool Monitor::tell(const ToldPacket& packet) {
    const auto known = rows_.find(packet.name);
    if (known == rows_.end() && rows_.size() == kMostRows) {
        ++rows_left_out_;
    } else {
        Row& row = known == rows_.end() ? rows_[packet.name] : known->second;
        ++row.count;
        row.fields = packet.fields;
    }
    bool field_told = false;
    for (const Field& field : packet.fields) {
        if (field.sound()) continue;
        odd(format("out_of_range: %s: %s is not within %g .. %g", packet.name.c_str(), text_of(field).c_str(),
                   field.least, field.most));
        field_told = true;
    }
    return field_told;
}

void Monitor::hear(const Heard& heard) {
    if (heard.closes) return session_->connection_closes(heard.source);
    newest_ = heard.arrival;
    if (!first_) first_ = viewed_ = heard.arrival;
    const LinkStatistics before = statistics();
    const auto frame_before = session_->state().host_frame;
    for (std::uint32_t change = 0; change < heard.changes; ++change) session_->host_changes();
    const Verdict verdict = session_->accept(heard.bytes, heard.arrival, heard.source);
    bool field_told = false;
    for (const ToldPacket& packet : told_packets(url_.protocol, heard.bytes)) field_told = tell(packet) || field_told;
    if (verdict == Verdict::pose) tell(told_pose(*session_->state().pose));
    compare(before, frame_before, heard, field_told);
}

void Monitor::compare(const LinkStatistics& before, std::optional<std::uint32_t> frame_before, const Heard& heard,
                      bool field_told) {
    const LinkStatistics& after = statistics();
    for (std::size_t i = 0; i < kRejectCount; ++i) {
        const auto reason = static_cast<Reject>(i);
        if (after.rejected[i] == before.rejected[i]) continue;
        causes_[i] = likely_cause(url_.protocol, reason, heard.bytes);
        // The field itself says more.
        if (field_told && reason == Reject::out_of_range) continue;
        odd(std::string(name_of(reason)) + ": " + causes_[i]);
    }
    std::string jump;
    const auto frame = session_->state().host_frame;
    if (frame_before && frame && *frame != *frame_before)
        jump = ": frame number " + std::to_string(*frame) + " after " + std::to_string(*frame_before);
    if (const auto lost = more(after.lost, before.lost)) odd("lost " + std::to_string(lost) + jump);
    if (after.duplicate > before.duplicate) odd("duplicate: the same message once more");
    if (after.reordered > before.reordered) odd("reordered: a newer one had come before it");
    if (after.restarts > before.restarts) odd("restart: the host counts anew, or a second host speaks" + jump);
    if (after.gaps.count > before.gaps.count && before.last_pose)
        odd(format("gap: no pose for %.1f ms", milliseconds(heard.arrival - before.last_pose->arrival)));
    if (after.entities_dropped > before.entities_dropped) odd("more entities than are followed");
    if (after.regions_dropped > before.regions_dropped) odd("more weather regions than are kept");
    if (url_.protocol == Protocol::cigi)
        for (std::size_t id = 0; id < after.packets.size(); ++id)
            if (before.packets[id] == 0 && after.packets[id] != 0 &&
                cigi::packet_name(static_cast<cigi::Kind>(id)) == "unknown")
                odd(id == cigi::kUnknown4
                        ? "a packet id that has no meaning in CIGI 4.0 (said once)"
                        : "packet id " + std::to_string(id) + " has no meaning in CIGI 3.3 (said once)");
}

void Monitor::hear_refusals(const LinkStatistics& link) {
    for (std::size_t i = 0; i < kRejectCount; ++i) {
        const auto refused = more(link.rejected[i], statistics().rejected[i]);
        if (refused <= refused_[i]) continue;
        const auto reason = static_cast<Reject>(i);
        causes_[i] = likely_cause(url_.protocol, reason);
        odd(std::string(name_of(reason)) + " (" + std::to_string(refused - refused_[i]) + "): " + causes_[i]);
        refused_[i] = refused;
    }
}

std::string Monitor::view(Time now) {
    const LinkStatistics& all = statistics();
    const double since = std::max(seconds(now - viewed_), 1e-9);
    const auto rate = [&](std::uint64_t count) { return first_ ? static_cast<double>(count) / since : 0.0; };
    const auto count = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
    std::string text = format("%.1f s  %.1f messages/s  %.1f poses/s", first_ ? seconds(now - *first_) : 0.0,
                              rate(all.datagrams - datagrams_viewed_), rate(all.frames - poses_viewed_));
    text += format("  lost %llu  duplicate %llu  reordered %llu  restarts %llu  gaps %llu (longest %.1f ms)\n",
                   count(all.lost), count(all.duplicate), count(all.reordered), count(all.restarts),
                   count(all.gaps.count), milliseconds(all.gaps.longest));
    if (!first_) text += "  nothing heard yet: is the host's address this machine's, and the port the same?\n";
    for (auto& [name, row] : rows_) {
        text += format("  %-28s %7.1f/s", name.c_str(), rate(row.count));
        row.count = 0;
        for (const Field& field : row.fields) text += "  " + text_of(field);
        text += '\n';
    }
    if (rows_left_out_ != 0) text += format("  and %llu packets of further kinds\n", count(rows_left_out_));
    if (url_.protocol == Protocol::flightgear_fdm && all.packets[25] != 0)
        text += "  version 25 packets: FlightGear 2020.4 or later\n";
    if (url_.protocol == Protocol::flightgear_fdm && all.packets[24] != 0)
        text += "  version 24 packets: JSBSim, or FlightGear up to 2020.3\n";
    for (std::size_t i = 0; i < kRejectCount; ++i) {
        if (const auto refused = all.rejected[i] + refused_[i])
            text += format("  rejected %llu %s: ", count(refused), kRejectNames[i].data()) + causes_[i] + '\n';
    }
    viewed_ = now;
    datagrams_viewed_ = all.datagrams;
    poses_viewed_ = all.frames;
    return text;
}

std::vector<std::string> Monitor::take_oddities() {
    std::vector<std::string> taken;
    taken.swap(lines_);
    if (lines_left_out_ != 0) taken.push_back("and " + std::to_string(lines_left_out_) + " more");
    lines_left_out_ = 0;
    return taken;
}

}  // namespace quadrig::host
