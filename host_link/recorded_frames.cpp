#include "host_link/recorded_frames.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace quadrig::host {

namespace {
constexpr const char* kTitle = "quadrig-frames";
}  // namespace

std::filesystem::path recorded_frames_file(const std::filesystem::path& recording) {
    return recording.string() + ".frames";
}

std::string first_line(const FrameNumbering& numbering) {
    return std::string(kTitle) + " 1 rate " + std::to_string(numbering.rate_numerator) + '/' +
           std::to_string(numbering.rate_denominator) + '\n';
}

std::string line_of(const RecordedFrame& frame) {
    return std::to_string(frame.number) + ',' + std::to_string(frame.due.count()) + ',' + std::to_string(frame.heard) +
           '\n';
}

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
    if (!head || title != kTitle || version != 1 || slash != '/') fail("'quadrig-frames 1 rate N/D'");
    for (++number; std::getline(stream, line); ++number) {
        if (stream.eof()) break;  // cut in the middle: its process was
        std::istringstream cells(line);
        RecordedFrame frame;
        std::int64_t due = 0;
        char first = ' ', second = ' ';
        cells >> frame.number >> first >> due >> second >> frame.heard;
        const RecordedFrame* before = result.frames.empty() ? nullptr : &result.frames.back();
        const bool onwards = before == nullptr || (frame.number > before->number && frame.heard >= before->heard);
        if (!cells || first != ',' || second != ',' || !onwards) fail("'frame,due,heard', none of them going back");
        frame.due = Time(due);
        result.frames.push_back(frame);
    }
    return result;
}

}  // namespace quadrig::host
