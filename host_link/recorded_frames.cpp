#include "host_link/recorded_frames.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "host_link/read_number.h"

namespace quadrig::host {

namespace {
constexpr const char* kTitle = "quadrig-frames";
constexpr std::string_view kHostChange = "host,";
}  // namespace

std::filesystem::path recorded_frames_file(const std::filesystem::path& recording) {
    return recording.string() + ".frames";
}

std::filesystem::path recording_of_entity(const std::filesystem::path& recording, std::size_t number,
                                          Protocol protocol) {
    const bool log = recording.extension() == ".log" && protocol != Protocol::canaerospace;
    const std::string extension = log ? ".pcapng" : recording.extension().string();
    return recording.parent_path() / (recording.stem().string() + ".entity-" + std::to_string(number) + extension);
}

std::string first_line(const FrameNumbering& numbering) {
    return std::string(kTitle) + " 2 rate " + std::to_string(numbering.rate_numerator) + '/' +
           std::to_string(numbering.rate_denominator) + '\n';
}

std::string line_of(const RecordedFrame& frame) {
    return std::to_string(frame.number) + ',' + std::to_string(frame.due.count()) + ',' + std::to_string(frame.heard) +
           ',' + std::to_string(frame.step) + '\n';
}

std::string line_of(const HostChange& change) { return std::string(kHostChange) + std::to_string(change.heard) + '\n'; }

std::optional<RecordedFrames> read_recorded_frames(const std::filesystem::path& recording) {
    const auto file = recorded_frames_file(recording);
    std::ifstream stream(file);
    if (!stream) return std::nullopt;
    RecordedFrames result;
    std::string line, title, word;
    int version = 0, number = 1;
    char slash = ' ';
    const auto fail = [&](const std::string& expected) {
        throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": expected " + expected);
    };
    std::getline(stream, line);
    std::istringstream head(line);
    head >> title >> version >> word >> result.numbering.rate_numerator >> slash >> result.numbering.rate_denominator;
    if (!head || title != kTitle || version != 2 || slash != '/') fail("'quadrig-frames 2 rate N/D'");
    for (++number; std::getline(stream, line); ++number) {
        if (stream.eof()) break;  // cut in the middle: its process was
        if (line.starts_with(kHostChange)) {
            const auto heard = read_number<std::uint64_t>(std::string_view(line).substr(kHostChange.size()));
            if (!heard || (!result.host_changes.empty() && *heard < result.host_changes.back().heard))
                fail("'host,heard', the number not going back");
            result.host_changes.push_back({*heard});
            continue;
        }
        std::istringstream cells(line);
        RecordedFrame frame;
        std::int64_t due = 0;
        char first = ' ', second = ' ', third = ' ';
        cells >> frame.number >> first >> due >> second >> frame.heard >> third >> frame.step;
        const RecordedFrame* before = result.frames.empty() ? nullptr : &result.frames.back();
        const bool onwards = before == nullptr || (frame.number > before->number && frame.heard >= before->heard);
        if (!cells || first != ',' || second != ',' || third != ',' || !onwards)
            fail("'frame,due,heard,step', none of the first three going back");
        frame.due = Time(due);
        result.frames.push_back(frame);
    }
    return result;
}

}  // namespace quadrig::host
