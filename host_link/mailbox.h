/// The newest value from one thread to another, wait-free on both sides: a triple buffer.
///
/// Exactly one thread publishes, exactly one takes. The taker always gets a whole value, the newest one; values between
/// are skipped.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace quadrig::host {

template <class T>
class Mailbox {
    static_assert(std::is_trivially_copyable_v<T>, "a value that allocates would not be wait-free");

  public:
    /// Producer only.
    void publish(const T& value) {
        slots_[back_].value = value;
        back_ = static_cast<std::uint8_t>(
            middle_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel) & kIndex);
    }

    /// Consumer only. Whether something was published since the last take; `value` is written only then.
    bool take(T& value) {
        if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
        front_ = static_cast<std::uint8_t>(middle_.exchange(front_, std::memory_order_acq_rel) & kIndex);
        value = slots_[front_].value;
        return true;
    }

  private:
    static constexpr std::uint8_t kFresh = 4;
    static constexpr std::uint8_t kIndex = 3;
    // A cache line each, so that writing one slot does not slow reading another.
    struct alignas(64) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(64) std::atomic<std::uint8_t> middle_{1};
    alignas(64) std::uint8_t back_ = 0;   ///< the producer's
    alignas(64) std::uint8_t front_ = 2;  ///< the consumer's
};

}  // namespace quadrig::host
