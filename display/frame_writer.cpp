#include "display/frame_writer.h"

#include <stdexcept>

#include "display/png_sink.h"
#include "display/y4m_sink.h"

namespace quadrig::display {

bool is_sink_url(const std::string& url) {
    const std::string_view form = std::string_view(url).substr(0, 4);
    return url == "none:" || (url.size() > form.size() && (form == "png:" || form == "y4m:"));
}

std::unique_ptr<FrameWriter> open_writer(const std::string& url, const VideoFormat& format) {
    if (!is_sink_url(url)) throw std::runtime_error("sink \"" + url + "\" is not one of " + std::string(kSinkUrls));
    if (url.starts_with("png:")) return std::make_unique<PngWriter>(url.substr(4));
    if (url.starts_with("y4m:")) return std::make_unique<Y4mWriter>(url.substr(4), format);
    return nullptr;
}

}  // namespace quadrig::display
