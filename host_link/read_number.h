/// Numbers as text has them: in options, links and logs.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace quadrig::host {

/// The number that a text is, all of it; absent where it is none or does not fit. A whole one may have a base other
/// than ten.
template <class Number, class... Base>
std::optional<Number> read_number(std::string_view text, Base... base) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace quadrig::host
