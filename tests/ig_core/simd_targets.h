/// Runs a test on every instruction set that both this machine and this build have.
#pragma once

#include <hwy/highway.h>

#include <vector>

namespace quadrig::test {

/// Holds dispatch to one instruction set while it lives.
class SimdTarget {
  public:
    explicit SimdTarget(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
    ~SimdTarget() {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
    SimdTarget(const SimdTarget&) = delete;
    SimdTarget& operator=(const SimdTarget&) = delete;
};

/// Best first.
inline std::vector<std::int64_t> simd_targets() {
    std::vector<std::int64_t> targets;
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1)
        targets.push_back(rest & -rest);
    return targets;
}

}  // namespace quadrig::test
