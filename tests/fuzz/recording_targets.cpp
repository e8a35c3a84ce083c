// Recordings and names of links: read, or refused with words.
#include <algorithm>
#include <string>

#include "host_link/can_frame.h"
#include "host_link/capture.h"
#include "host_link/link_url.h"
#include "host_link/recorded_frames.h"
#include "host_link/session.h"
#include "tests/fuzz/input_file.h"

namespace quadrig::fuzz {
namespace {

std::string_view text_of(Input input) { return {reinterpret_cast<const char*>(input.data()), input.size()}; }

/// An input under a name of our own choice, in a directory that is gone at the program's end.
class NamedInput {
  public:
    explicit NamedInput(const char* name) : directory_(std::filesystem::temp_directory_path() / "quadrig-fuzz-XXXXXX") {
        if (mkdtemp(directory_.data()) == nullptr) throw std::system_error(errno, std::generic_category(), directory_);
        std::filesystem::create_symlink(file_.holding({}), std::filesystem::path(directory_) / name);
    }
    ~NamedInput() {
        std::error_code ignored;
        std::filesystem::remove_all(directory_, ignored);
    }
    NamedInput(const NamedInput&) = delete;
    NamedInput& operator=(const NamedInput&) = delete;

    [[nodiscard]] std::filesystem::path directory_holding(Input input) const {
        file_.holding(input);
        return directory_;
    }

  private:
    InputFile file_;
    std::string directory_;
};

}  // namespace

void read_candump(Input input) {
    const auto line = host::read_candump_line(text_of(input));
    if (!line) return;
    law(line->frame.size <= host::kCanDataSize, "a classic frame has 8 bytes at most");
    const auto recorded = host::can_frame(host::can_record(line->frame));
    law(line->frame.fd ? !recorded : recorded == line->frame,
        "a classic frame survives its record, and no other is one");
    const std::string again = host::candump_line(*line);
    const auto second = host::read_candump_line(again);
    law(second.has_value() && second->frame == line->frame && second->interface == line->interface,
        "a frame survives its line");
}

void read_capture(Input input) {
    static const InputFile file;
    const auto read = [&](bool whole) {
        const host::Capture capture = host::read_capture(file.holding(input), std::nullopt, whole);
        law(!capture.datagrams.empty(), "a capture that is taken holds a host");
        law(capture.bytes.size() <= input.size(), "no more comes out than went in");
        for (const auto& datagram : capture.datagrams)
            law(datagram.offset <= capture.bytes.size() && datagram.size <= capture.bytes.size() - datagram.offset,
                "a datagram lies within the bytes");
        law(!text(capture.flow).empty(), "a flow has a name");
        return capture.datagrams.size();
    };
    try {
        law(read(false) <= read(true), "a flow is a part of all flows");
    } catch (const LawBroken&) {
        throw;
    } catch (const std::runtime_error&) {
    }
}

void read_recorded_frames(Input input) {
    // The reader looks for NAME.frames beside NAME.
    static const NamedInput file("input.frames");
    const auto recording = file.directory_holding(input) / "input";
    try {
        const auto frames = host::read_recorded_frames(recording);
        law(frames.has_value(), "a file that is there is read");
        law(std::ranges::is_sorted(frames->frames, {}, &host::RecordedFrame::number), "frames' numbers do not go back");
        law(std::ranges::is_sorted(frames->frames, {}, &host::RecordedFrame::heard), "nothing is unheard");
        law(std::ranges::is_sorted(frames->host_changes, {}, &host::HostChange::heard), "hosts come one after another");
    } catch (const LawBroken&) {
        throw;
    } catch (const std::runtime_error&) {
    }
}

void read_link_url(Input input) {
    try {
        const host::LinkUrl url = host::parse_link_url(text_of(input));
        law(url.text == text_of(input), "a link keeps its name");
        law(!url.live || !url.address.empty(), "a live link is somewhere");
        host::session_options(url, {});
    } catch (const host::LinkUrlError&) {
    }
}

}  // namespace quadrig::fuzz
