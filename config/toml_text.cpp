#include "config/toml_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <ostream>
#include <string_view>

namespace quadrig::config {

std::ostream& operator<<(std::ostream& out, Exact exact) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), exact.number).ptr;
    out.write(text.data(), end - text.data());
    const bool looks_like_integer =
        std::all_of(text.data(), end, [](char c) { return c == '-' || ('0' <= c && c <= '9'); });
    return looks_like_integer ? out << ".0" : out;
}

std::ostream& operator<<(std::ostream& out, const Quoted& quoted) {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    out << '"';
    for (const char c : quoted.text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F) {
            out << "\\u00" << kHex[byte >> 4] << kHex[byte & 15];
        } else {
            if (c == '"' || c == '\\') out << '\\';
            out << c;
        }
    }
    return out << '"';
}

}  // namespace quadrig::config
