/// A vector with a fixed room of its own: a plain value that never allocates (as C++26's std::inplace_vector).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace quadrig::host {

template <class T, std::size_t kCapacity>
class InplaceVector {
  public:
    static constexpr std::size_t kMost = kCapacity;
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] bool full() const { return size_ == kCapacity; }

    [[nodiscard]] T* begin() { return items_.data(); }
    [[nodiscard]] T* end() { return begin() + size_; }
    [[nodiscard]] const T* begin() const { return items_.data(); }
    [[nodiscard]] const T* end() const { return begin() + size_; }
    [[nodiscard]] T& operator[](std::size_t i) { return items_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return items_[i]; }

    /// Precondition: not full.
    T& push_back(const T& item) { return items_[size_++] = item; }
    /// The others keep their order.
    void erase(T* item) {
        std::move(item + 1, end(), item);
        --size_;
    }
    void clear() { size_ = 0; }

  private:
    std::array<T, kCapacity> items_{};
    std::size_t size_ = 0;
};

}  // namespace quadrig::host
