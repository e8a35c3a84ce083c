#include "frame_scheduler/frame_report.h"

#include <algorithm>
#include <cstdio>

namespace quadrig::scheduler {

namespace {

using Json = nlohmann::ordered_json;

double milliseconds(std::chrono::nanoseconds t) { return std::chrono::duration<double, std::milli>(t).count(); }

Json json_of(const Percentiles& p) {
    return {{"min", milliseconds(p.min)}, {"p50", milliseconds(p.p50)},   {"p90", milliseconds(p.p90)},
            {"p99", milliseconds(p.p99)}, {"p999", milliseconds(p.p999)}, {"max", milliseconds(p.max)}};
}

template <class... Values>
std::string format(const char* pattern, Values... values) {
    char line[256];
    std::snprintf(line, sizeof line, pattern, values...);
    return line;
}

std::string row(const char* name, const Percentiles& p) {
    return format("  %-12s %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f\n", name, milliseconds(p.min), milliseconds(p.p50),
                  milliseconds(p.p90), milliseconds(p.p99), milliseconds(p.p999), milliseconds(p.max));
}

/// A counter of a link's JSON; 0 where it has none.
std::uint64_t count(const Json& link, const char* key) {
    const auto found = link.find(key);
    return found != link.end() && found->is_number() ? found->get<std::uint64_t>() : 0;
}

/// " ig_control 60, entity_control 60" out of an object of counters.
std::string counters(const Json& link, const char* key) {
    std::string text;
    const auto found = link.find(key);
    if (found == link.end() || !found->is_object()) return text;
    for (const auto& [name, value] : found->items())
        if (value.is_number() && value != 0) text += (text.empty() ? " " : ", ") + name + " " + value.dump();
    return text;
}

std::string link_summary(const Json& link) {
    const std::string url = link.contains("url") && link["url"].is_string() ? link["url"].get<std::string>() : "?";
    const auto number = [&](const char* key) { return static_cast<unsigned long long>(count(link, key)); };
    std::string text =
        "link " + url + "\n" +
        format("  %llu datagrams, %llu poses, lost %llu, duplicate %llu, reordered %llu\n", number("datagrams"),
               number("frames"), number("lost"), number("duplicate"), number("reordered"));
    for (const char* key : {"packets", "rejected"})
        if (const std::string list = counters(link, key); !list.empty())
            text += std::string("  ") + key + ":" + list + "\n";
    return text;
}

std::string sink_summary(const SinkReport& sink) {
    std::string text = "sink " + sink.url + format(": %llu frames", static_cast<unsigned long long>(sink.frames));
    if (sink.dropped) text += format(", %llu dropped", static_cast<unsigned long long>(sink.dropped));
    if (sink.failed) text += format(", %llu failed", static_cast<unsigned long long>(sink.failed));
    return text + (sink.error.empty() ? "\n" : "\n  " + sink.error + "\n");
}

}  // namespace

void add_record(FrameReport& report, const FrameRecord& record) {
    report.frames = record.frames;
    report.deadline_misses = record.deadline_misses;
    report.repeated_frames = record.repeated_frames;
    report.frame = record.frame.percentiles();
    report.hand_over = record.hand_over.percentiles();
    report.latency = record.latency.percentiles();
    report.wake_late = record.wake_late.percentiles();
    std::transform(record.stages.begin(), record.stages.end(), report.stages.begin(),
                   [](const Distribution& stage) { return stage.percentiles(); });
}

nlohmann::ordered_json to_json(const FrameReport& report) {
    Json json;
    json["quadrig"] = report.version;
    json["schema"] = 1;
    json["machine"] = {{"cpu", report.machine.cpu},
                       {"cores", report.machine.cores},
                       {"simd", report.machine.simd},
                       {"threads", report.machine.threads},
                       {"build", report.machine.build}};
    json["image"] = {{"width", report.width}, {"height", report.height}};
    json["rate_hz"] = report.rate_hz;
    json["real_time"] = report.real_time;
    if (report.grants)
        json["granted"] = {{"timer_slack", report.grants->timer_slack},
                           {"memory_locked", report.grants->memory_locked},
                           {"fifo", report.grants->fifo}};
    json["frames"] = report.frames;
    json["deadline_misses"] = report.deadline_misses;
    json["repeated_frames"] = report.repeated_frames;
    json["frame_ms"] = json_of(report.frame);
    for (std::size_t s = 0; s < kStageCount; ++s)
        json["stage_ms"][std::string(kStageNames[s])] = json_of(report.stages[s]);
    json["hand_over_ms"] = json_of(report.hand_over);
    json["latency_ms"] = json_of(report.latency);
    json["wake_late_ms"] = json_of(report.wake_late);
    json["timer_late_ms"] = json_of(report.timer_late);
    json["quality"] = Json::object();
    for (const auto& [name, frames] : report.quality) json["quality"][name] = frames;
    json["links"] = report.links;
    json["sinks"] = Json::array();
    for (const SinkReport& sink : report.sinks) {
        Json entry{{"url", sink.url}, {"frames", sink.frames}, {"dropped", sink.dropped}, {"failed", sink.failed}};
        if (!sink.error.empty()) entry["error"] = sink.error;
        json["sinks"].push_back(std::move(entry));
    }
    json["hash"] = report.hash;
    json["frame_hashes"] = report.frame_hashes;
    return json;
}

std::string json_text(const FrameReport& report) {
    return to_json(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const FrameReport& report) {
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::string text =
        format("%llu frames of %dx%d at %.6g Hz%s: %llu deadline misses, %llu repeated\n", number(report.frames),
               report.width, report.height, report.rate_hz, report.real_time ? "" : " (as fast as it could)",
               number(report.deadline_misses), number(report.repeated_frames));
    text += report.machine.cpu + format(", %d cores, %d threads, ", report.machine.cores, report.machine.threads) +
            report.machine.simd + ", " + report.machine.build + "\n";
    for (const auto& [name, frames] : report.quality)
        text += "quality " + name + format(": %llu frames\n", number(frames));
    text += format("  %-12s %9s %9s %9s %9s %9s %9s\n", "ms", "min", "p50", "p90", "p99", "p99.9", "max");
    text += row("frame", report.frame);
    for (std::size_t s = 0; s < kStageCount; ++s)
        text += row(("- " + std::string(kStageNames[s])).c_str(), report.stages[s]);
    text += row("hand over", report.hand_over);
    if (!report.links.empty()) text += row("latency", report.latency);
    if (report.real_time) text += row("wake late", report.wake_late) + row("timer late", report.timer_late);
    for (const Json& link : report.links) text += link_summary(link);
    for (const SinkReport& sink : report.sinks) text += sink_summary(sink);
    if (!report.hash.empty()) text += "hash " + report.hash + "\n";
    return text;
}

}  // namespace quadrig::scheduler
