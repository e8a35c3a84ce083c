#include "host_link/modbus.h"

#include <algorithm>

#include "host_link/wire.h"

namespace quadrig::host::modbus {

namespace {

constexpr std::size_t kFunctionAt = kHeaderSize, kLengthAt = 4, kBodyAt = 6;
constexpr std::uint16_t kMostRead = 125, kMostWritten = 123, kMostWrittenWhileRead = 121;

using Bytes = std::span<const std::byte>;
std::uint16_t u16(Bytes b, std::size_t at) { return load<std::uint16_t>(b, at, ByteOrder::big); }
std::uint8_t u8(Bytes b, std::size_t at) { return std::to_integer<std::uint8_t>(b[at]); }

/// Address and count, where the count is allowed.
std::variant<Registers, Exception> registers(Bytes data, std::size_t at, std::uint16_t most) {
    const Registers r{u16(data, at), u16(data, at + 2)};
    if (r.count < 1 || r.count > most) return Exception::illegal_value;
    if (r.address + r.count > 65536) return Exception::illegal_address;
    return r;
}

std::variant<Request, Exception> read(Function function, Bytes data) {
    if (data.size() != 4) return Exception::illegal_value;
    const auto read = registers(data, 0, kMostRead);
    if (const auto* wrong = std::get_if<Exception>(&read)) return *wrong;
    return Request{function, std::get<Registers>(read), std::nullopt, {}};
}

/// Address, count, count of bytes, values, from `at` on to the end.
std::variant<Request, Exception> write(Function function, Bytes data, std::size_t at, std::uint16_t most) {
    if (data.size() < at + 5) return Exception::illegal_value;
    const auto written = registers(data, at, most);
    if (const auto* wrong = std::get_if<Exception>(&written)) return *wrong;
    const auto& r = std::get<Registers>(written);
    const Bytes values = data.subspan(at + 5);
    if (u8(data, at + 4) != 2 * r.count || values.size() != 2U * r.count) return Exception::illegal_value;
    return Request{function, std::nullopt, r, values};
}

std::variant<Request, Exception> write_and_read(Function function, Bytes data) {
    auto request = write(function, data, 4, kMostWrittenWhileRead);
    if (auto* sound = std::get_if<Request>(&request)) {
        const auto read = registers(data, 0, kMostRead);
        if (const auto* wrong = std::get_if<Exception>(&read)) return *wrong;
        sound->read = std::get<Registers>(read);
    }
    return request;
}

}  // namespace

std::string_view name_of(Function function) {
    switch (function) {
        case Function::read_holding_registers:
            return "read_holding_registers";
        case Function::read_input_registers:
            return "read_input_registers";
        case Function::write_single_register:
            return "write_single_register";
        case Function::write_multiple_registers:
            return "write_multiple_registers";
        case Function::read_write_multiple_registers:
            return "read_write_multiple_registers";
    }
    return "unknown";
}

std::variant<Request, Exception> read_request(Bytes frame) {
    if (frame.size() <= kHeaderSize) return Exception::illegal_function;
    const auto function = Function{u8(frame, kFunctionAt)};
    const Bytes data = frame.subspan(kFunctionAt + 1);
    switch (function) {
        case Function::read_holding_registers:
        case Function::read_input_registers:
            return read(function, data);
        case Function::write_single_register:
            if (data.size() != 4) return Exception::illegal_value;
            return Request{function, std::nullopt, Registers{u16(data, 0), 1}, data.subspan(2)};
        case Function::write_multiple_registers:
            return write(function, data, 0, kMostWritten);
        case Function::read_write_multiple_registers:
            return write_and_read(function, data);
    }
    return Exception::illegal_function;
}

std::size_t write_request(std::uint16_t transaction, std::uint16_t address, Bytes values, std::span<std::byte> out) {
    const bool single = values.size() == 2;
    const std::size_t head = kFunctionAt + (single ? 3 : 6);
    store(out, 0, ByteOrder::big, transaction);
    store(out, 2, ByteOrder::big, std::uint16_t{0});
    store(out, kLengthAt, ByteOrder::big, static_cast<std::uint16_t>(head + values.size() - kBodyAt));
    out[kBodyAt] = std::byte{0xFF};  // the unit of a server without a bus behind it
    out[kFunctionAt] =
        static_cast<std::byte>(single ? Function::write_single_register : Function::write_multiple_registers);
    store(out, kFunctionAt + 1, ByteOrder::big, address);
    if (!single) {
        store(out, kFunctionAt + 3, ByteOrder::big, static_cast<std::uint16_t>(values.size() / 2));
        out[kFunctionAt + 5] = static_cast<std::byte>(values.size());
    }
    std::ranges::copy(values, out.begin() + static_cast<std::ptrdiff_t>(head));
    return head + values.size();
}

std::optional<Bytes> FrameBuffer::next(Bytes& stream) {
    if (whole_) size_ = 0;
    whole_ = false;
    while (!stream.empty() && !broken_) {
        // Only the header tells how much more belongs to the frame.
        const std::size_t length = size_ < kBodyAt ? 0 : u16(bytes_, kLengthAt);
        const std::size_t wanted = kBodyAt + length;
        const std::size_t taken = std::min(wanted - size_, stream.size());
        std::ranges::copy(stream.first(taken), bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
        size_ += taken;
        stream = stream.subspan(taken);
        if (size_ < kBodyAt) continue;
        const std::size_t told = u16(bytes_, kLengthAt);
        broken_ = u16(bytes_, 2) != 0 || told < 2 || told > kLargestFrame - kBodyAt;
        if (broken_ || size_ < kBodyAt + told) continue;
        whole_ = true;
        return Bytes(bytes_).first(size_);
    }
    return std::nullopt;
}

}  // namespace quadrig::host::modbus
