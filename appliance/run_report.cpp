#include "appliance/run_report.h"

#include <chrono>
#include <iostream>
#include <stdexcept>

#include "display/atomic_file.h"

namespace quadrig::appliance {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const host::NamedCounts& counts) {
    Json json = Json::object();
    for (const auto& [name, count] : counts) json[std::string(name)] = count;
    return json;
}

Json json_of(const host::PoseSample& pose) {
    return {{"latitude", pose.position.latitude.value}, {"longitude", pose.position.longitude.value},
            {"altitude", pose.position.altitude},       {"heading", pose.attitude.heading.value},
            {"pitch", pose.attitude.pitch.value},       {"roll", pose.attitude.roll.value}};
}

}  // namespace

scheduler::FrameReport report_about(const Painter& painter) {
    const PictureSettings& settings = painter.settings();
    scheduler::FrameReport report;
    report.version = QUADRIG_VERSION;
    report.machine = scheduler::this_machine();
    report.machine.simd = ImageGenerator::simd_target();
    report.machine.threads = settings.threads;
    report.width = settings.size.width;
    report.height = settings.size.height;
    report.rate_hz = settings.rate.hertz();
    return report;
}

Json link_report(const std::string& url, const host::LinkStatistics& statistics) {
    Json json{{"url", url},
              {"datagrams", statistics.datagrams},
              {"bytes", statistics.bytes},
              {"frames", statistics.frames},
              {"packets", json_of(packets_by_name(statistics))},
              {"rejected", json_of(rejected_by_reason(statistics))},
              {"lost", statistics.lost},
              {"duplicate", statistics.duplicate},
              {"reordered", statistics.reordered},
              {"restarts", statistics.restarts},
              {"gaps",
               {{"count", statistics.gaps.count},
                {"longest_ms", std::chrono::duration<double, std::milli>(statistics.gaps.longest).count()}}},
              {"other_entities", statistics.other_entities},
              {"entities_dropped", statistics.entities_dropped},
              {"regions_dropped", statistics.regions_dropped},
              {"answers_dropped", statistics.answers_dropped}};
    if (statistics.first_pose) json["first_pose"] = json_of(*statistics.first_pose);
    if (statistics.last_pose) json["last_pose"] = json_of(*statistics.last_pose);
    return json;
}

Json json_of(const host::Recorder& recorder) {
    return {{"datagrams", recorder.recorded()}, {"left_out", recorder.left_out()}};
}

Json live_link_report(const host::LiveLink& link) {
    Json told = link_report(link.url().text, link.statistics());
    if (link.port() != 0) told["port"] = link.port();
    told["replies"] = link.replies_sent();
    told["replies_failed"] = link.replies_failed();
    told["replies_held_back"] = link.replies_held_back();
    if (link.url().synchronous) told["unanswered"] = link.unanswered();
    return told;
}

void finish_report(scheduler::FrameReport& report, const scheduler::FrameRecord& record, const Painter& painter,
                   Outlets& outlets, const std::filesystem::path& file) {
    add_record(report, record);
    const PictureSettings& settings = painter.settings();
    for (std::size_t step = 0; step < settings.ladder.size(); ++step)
        if (const std::uint64_t frames = painter.frames_at_step()[step]; frames > 0 || step == settings.step)
            report.quality[settings.ladder[step].name] = frames;
    outlets.finish(report);
    std::cerr << summary(report);
    if (!file.empty()) display::write_whole(file, json_text(report));
    for (const scheduler::SinkReport& sink : report.sinks)
        if (!sink.error.empty()) throw std::runtime_error("sink " + sink.url + " failed: " + sink.error);
}

}  // namespace quadrig::appliance
