/// Where pictures go: one small interchangeable writer per kind of sink, and the URLs that name them.
#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "ig_core/view.h"

namespace quadrig::display {

/// What a sink needs to know before its first frame. The rate is rate_numerator / rate_denominator frames a second.
struct VideoFormat {
    int width = 0;
    int height = 0;
    std::int64_t rate_numerator = 60;
    std::int64_t rate_denominator = 1;
};

/// Takes finished frames, in order, on one thread. Errors are thrown as std::runtime_error with the name of what
/// failed.
class FrameWriter {
  public:
    virtual ~FrameWriter() = default;
    /// `number` is the frame's number in the run. `closing` asks a writer that waits for somebody to stop waiting soon.
    virtual void write(const FrameImage& image, std::uint64_t number, const std::stop_token& closing) = 0;
    /// After the last frame: what cannot be told of errors before the end.
    virtual void finish() {}
    /// A writer whose frames depend on each other is of no use after the first error.
    [[nodiscard]] virtual bool usable_after_error() const = 0;
};

/// What a sink URL may look like, for help texts and errors.
inline constexpr std::string_view kSinkUrls = "png:DIRECTORY, y4m:FILE (y4m:- is standard output) or none:";

/// Whether a URL has one of these forms; nothing is opened.
bool is_sink_url(const std::string& url);

/// Opens the writer that a URL names; null for `none:`. Throws std::runtime_error: a URL of another form (the message
/// says which are accepted), a directory or file that cannot be made.
std::unique_ptr<FrameWriter> open_writer(const std::string& url, const VideoFormat& format);

}  // namespace quadrig::display
