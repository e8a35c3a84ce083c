// What a Modbus host's writes do to the session's state.
#include <algorithm>
#include <variant>

#include "host_link/session.h"

namespace quadrig::host {

namespace {

// A sequence number further ahead than this is a new count, not a loss.
constexpr std::uint16_t kFarthestAhead = 256;

}  // namespace

modbus::PoseRegisters& Session::registers_of(std::uint32_t source) {
    const auto known = std::ranges::find(modbus_hosts_, std::optional(source), &ModbusHost::source);
    const auto place =
        known != modbus_hosts_.end() ? known : std::ranges::min_element(modbus_hosts_, {}, &ModbusHost::used);
    if (place->source != source) *place = {source, 0, {}};
    place->used = statistics_.datagrams;
    return place->registers;
}

Verdict Session::accept_modbus(std::span<const std::byte> frame, Time arrival, std::uint32_t source) {
    const auto read = modbus::read_request(frame);
    if (std::holds_alternative<modbus::Exception>(read)) return reject(Reject::bad_request);
    const auto& request = std::get<modbus::Request>(read);
    if (!modbus::may_read(request, options_.modbus)) return reject(Reject::bad_address);
    if (request.write && !modbus::may_write(*request.write, options_.modbus)) return reject(Reject::bad_address);
    ++statistics_.packets[static_cast<std::size_t>(request.function)];
    if (!request.write) return Verdict::no_pose;
    const auto written = registers_of(source).write(request, options_.modbus);
    if (const auto* reason = std::get_if<Reject>(&written)) return reject(*reason);
    const auto* host = std::get_if<modbus::HostPose>(&written);
    if (host == nullptr) return Verdict::no_pose;

    if (const auto& driving = modbus_driving_) {
        const bool known = driving->source == source;
        // A host that has not committed for so long, or has hung up, has left the picture to another.
        const bool silent = arrival - driving->commit >= options_.silence;
        if (!known && !silent && !driving->closed) return reject(Reject::other_host);
        const auto ahead = static_cast<std::uint16_t>(host->sequence - driving->sequence);
        if (known && ahead == 0) {
            ++statistics_.duplicate;
            return Verdict::duplicate;
        }
        // A host may have a connection for each request: it goes on counting.
        const bool goes_on = (known || (driving->closed && !silent)) && ahead != 0 && ahead <= kFarthestAhead;
        if (goes_on)
            statistics_.lost += ahead - 1U;
        else
            restart();
    }
    modbus_driving_ = ModbusDriving{source, host->sequence, arrival, false};
    return take(arrival, host->pose, modbus_clock_.read(host->time));
}

void Session::connection_closes(std::uint32_t source) {
    if (modbus_driving_ && modbus_driving_->source == source) modbus_driving_->closed = true;
}

std::uint16_t Session::modbus_sequence() const {
    return modbus_driving_ ? modbus_driving_->sequence : std::uint16_t{0};
}

}  // namespace quadrig::host
