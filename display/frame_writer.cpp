#include "display/frame_writer.h"

#include <stdexcept>

#include "display/png_sink.h"
#include "display/y4m_sink.h"

namespace quadrig::display {

std::unique_ptr<FrameWriter> open_writer(const std::string& url, const VideoFormat& format) {
    const std::size_t colon = url.find(':');
    const std::string scheme = url.substr(0, colon);
    const std::string target = colon == std::string::npos ? "" : url.substr(colon + 1);
    if (url == "none:") return nullptr;
    if (!target.empty() && scheme == "png") return std::make_unique<PngWriter>(target);
    if (!target.empty() && scheme == "y4m") return std::make_unique<Y4mWriter>(target, format);
    throw std::runtime_error("sink \"" + url + "\" is not one of " + std::string(kSinkUrls));
}

}  // namespace quadrig::display
