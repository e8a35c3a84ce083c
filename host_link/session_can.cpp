// What each CANaerospace message does to the session's state.
#include <chrono>
#include <cmath>

#include "host_link/canaerospace.h"
#include "host_link/session.h"

namespace quadrig::host {

namespace {

using canaerospace::Message;
using canaerospace::Role;

int digits(std::byte b) { return std::to_integer<int>(b); }

}  // namespace

Verdict Session::accept_can(std::span<const std::byte> record, Time arrival) {
    const auto frame = can_frame(record);
    if (!frame) return reject(Reject::not_data_frame);
    const auto decoded = canaerospace::decode(*frame);
    if (const auto* reason = std::get_if<Reject>(&decoded)) return reject(*reason);
    const auto& message = std::get<Message>(decoded);
    ++statistics_.packets[canaerospace::parameter_index(message.id)];
    if (const auto reply = canaerospace::identification_reply(message, options_.can_node)) {
        answer_ = can_record(canaerospace::encode(*reply));
        answer_size_ = answer_.size();
    }
    const auto outcome = can_pose_.accept(message, arrival);
    statistics_.lost = can_pose_.lost();
    statistics_.restarts = can_pose_.restarts();
    using Place = canaerospace::PoseAssembler::Place;
    if (outcome.place == Place::duplicate) {
        ++statistics_.duplicate;
        return Verdict::duplicate;
    }
    if (outcome.place == Place::late) {
        ++statistics_.reordered;
        return Verdict::reordered;
    }
    if (outcome.reject) return reject(*outcome.reject);
    if (outcome.drives) apply(message);
    return take(arrival, outcome.pose, std::nullopt);
}

void Session::apply(const Message& message) {
    const Role role = canaerospace::parameter_at(canaerospace::parameter_index(message.id)).role;
    const auto velocity = [&](int axis) {
        const auto value = canaerospace::number_of(message);
        if (!value || !std::isfinite(*value)) {
            reject(value ? Reject::out_of_range : Reject::bad_data_type);
            return;
        }
        glm::dvec3 all = state_.velocity.value_or(glm::dvec3(0.0));
        all[axis] = *value;
        state_.velocity = all;
    };
    const auto& data = message.data;
    const bool four_digits =
        message.type == canaerospace::DataType::char4 || message.type == canaerospace::DataType::uchar4;
    switch (role) {
        case Role::velocity_east:
            return velocity(0);
        case Role::velocity_north:
            return velocity(1);
        case Role::velocity_up:
            return velocity(2);
        case Role::date: {
            using namespace std::chrono;
            const year_month_day date = year(digits(data[2]) * 100 + digits(data[3])) /
                                        month(static_cast<unsigned>(digits(data[1]))) /
                                        day(static_cast<unsigned>(digits(data[0])));
            const bool sound = date.ok() && digits(data[2]) < 100 && digits(data[3]) < 100;
            if (!four_digits || !sound) {
                reject(four_digits ? Reject::out_of_range : Reject::bad_data_type);
                return;
            }
            can_date_ = date;
            return;
        }
        case Role::utc: {
            const bool sound = digits(data[0]) < 24 && digits(data[1]) < 60 && digits(data[2]) < 60;
            if (!four_digits || !sound) {
                reject(four_digits ? Reject::out_of_range : Reject::bad_data_type);
                return;
            }
            // Without a date the sun has no place.
            if (!can_date_) return;
            state_.utc = CivilTime{int(can_date_->year()),
                                   static_cast<int>(unsigned(can_date_->month())),
                                   static_cast<int>(unsigned(can_date_->day())),
                                   digits(data[0]),
                                   digits(data[1]),
                                   static_cast<double>(digits(data[2]))};
            return;
        }
        default:
            return;
    }
}

}  // namespace quadrig::host
