#include "host_link/fdm_stream.h"

#include <algorithm>

#include "host_link/wire.h"

namespace quadrig::host::flightgear {

std::size_t PacketStream::size_at(std::size_t place) const {
    for (const ByteOrder order : {ByteOrder::big, ByteOrder::little}) {
        const auto version = load<std::uint32_t>(bytes_, place, order);
        if (version == 24) return kSize24;
        if (version == 25) return kSize25;
    }
    return 0;
}

void PacketStream::drop(std::size_t count) {
    std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(count), bytes_.begin() + static_cast<std::ptrdiff_t>(size_),
              bytes_.begin());
    size_ -= count;
}

std::optional<std::span<const std::byte>> PacketStream::next(std::span<const std::byte>& stream) {
    drop(given_);
    given_ = 0;
    while (true) {
        const auto taken = stream.first(std::min(stream.size(), bytes_.size() - size_));
        std::ranges::copy(taken, bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
        size_ += taken.size();
        stream = stream.subspan(taken.size());
        if (size_ < sizeof(std::uint32_t)) return std::nullopt;

        if (const std::size_t size = size_at(0); size != 0) {
            const std::size_t needed = in_step_ ? size : size + sizeof(std::uint32_t);
            if (size_ < needed) return std::nullopt;
            if (in_step_ || size_at(size) != 0) {
                in_step_ = true;
                given_ = size;
                return std::span<const std::byte>(bytes_).first(size);
            }
        } else if (in_step_) {
            in_step_ = false;
            ++breaks_;
        }
        std::size_t skipped = 1;
        while (skipped + sizeof(std::uint32_t) <= size_ && size_at(skipped) == 0) ++skipped;
        drop(skipped);
    }
}

}  // namespace quadrig::host::flightgear
