/// The machine that a report was made on.
#pragma once

#include <string>

namespace quadrig::scheduler {

struct Machine {
    std::string cpu;    ///< as the processor names itself; "unknown" where the system does not tell
    int cores = 1;      ///< that this process may run on
    std::string simd;   ///< instruction set of the shading
    int threads = 1;    ///< that draw
    std::string build;  ///< "Release", …
};

/// Fills in what the system knows (Linux); `simd` is left empty.
Machine this_machine();

}  // namespace quadrig::scheduler
