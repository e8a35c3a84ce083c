/// Values as a TOML file has them.
#pragma once

#include <iosfwd>
#include <string>

namespace quadrig::config {

/// A double in the fewest digits that read back the same, and in a form that TOML does not take for an integer.
struct Exact {
    double number;
};
std::ostream& operator<<(std::ostream& out, Exact exact);

/// A basic string, its quotes and unprintable bytes escaped.
struct Quoted {
    const std::string& text;
};
std::ostream& operator<<(std::ostream& out, const Quoted& quoted);

}  // namespace quadrig::config
