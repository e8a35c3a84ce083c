/// The report at the end of a run, put together from its parts.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "appliance/outlets.h"
#include "appliance/painter.h"
#include "frame_scheduler/frame_report.h"
#include "host_link/link_statistics.h"
#include "host_link/live_link.h"
#include "host_link/recorder.h"

namespace quadrig::appliance {

/// What is known before the first frame: machine, picture, quality.
scheduler::FrameReport report_about(const Painter& painter);

/// A link as reports tell it.
nlohmann::ordered_json link_report(const std::string& url, const host::LinkStatistics& statistics);
/// A live one, with its port and replies.
nlohmann::ordered_json live_link_report(const host::LiveLink& link);

/// What a recorder has written so far.
nlohmann::ordered_json json_of(const host::Recorder& recorder);

/// Closes the outlets, says the report on standard error, and writes it to `file` unless that is empty.
/// Throws std::runtime_error where a sink has failed or the file cannot be written; the report has then been said.
void finish_report(scheduler::FrameReport& report, const scheduler::FrameRecord& record, const Painter& painter,
                   Outlets& outlets, const std::filesystem::path& file);

}  // namespace quadrig::appliance
